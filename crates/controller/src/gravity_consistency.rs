//! The measured vertical against the one by which the robot moves, while it stands on both feet.
//!
//! A point mass at height `z` accelerates by `g (c - p) / z`, with the centre of mass `c` and the zero-moment point `p`
//! (Kajita et al. 2001). `c` depends on the measured orientation, `p` does not: an inertial measurement unit that is
//! askew by an angle shows as an acceleration of `g` times that angle that never becomes a velocity. Joints, forces and
//! orientation can each be plausible and consistent by themselves and still contradict each other like this.
//!
//! In a fast walk soles slip and legs swing, which looks like up to 1.7° for seconds; in a stand nothing does.

use model::{GRAVITY, Side};
use nalgebra::Vector2;
use stabilizer::BalanceState;

/// Time over which accelerations are compared with the change of velocity (s).
const WINDOW: f64 = 0.25;
/// Number of such times in a row that must show a tilt in the same direction: a push spoils one or two.
const WINDOWS: usize = 3;
/// Tilt that each of them must show (rad).
const TILT_MAX: f64 = 0.0227;

/// Finds an orientation that is askew for good.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct GravityConsistency {
    window: Option<Window>,
    /// Tilt over each of the last windows, the newest first: ahead and to the left (rad).
    tilts: [Vector2<f64>; WINDOWS],
    /// The tilt that was found, ahead and to the left (rad).
    askew: Option<Vector2<f64>>,
}

/// Accelerations since the window began, in support coordinates, beyond those of the plan.
#[derive(Clone, Copy, Debug)]
struct Window {
    /// Velocity of the centre of mass beyond the plan at its beginning (m/s).
    began: Vector2<f64>,
    /// What the accelerations add up to (m/s).
    gained: Vector2<f64>,
    /// How long ago it began (s).
    duration: f64,
}

impl GravityConsistency {
    /// Absorbs a state of a robot that is to stand on both feet, and tells whether the orientation is askew.
    ///
    /// * `planned` – the state that the plan has now
    /// * `support` – the foot in whose coordinates both are
    /// * `dt` – time since the state before (s)
    pub(crate) fn update(&mut self, measured: &BalanceState, planned: &BalanceState, support: Side, dt: f64) -> bool {
        if self.askew.is_some() {
            return true;
        }
        let (Some(measured_acceleration), Some(planned_acceleration)) = (acceleration(measured), acceleration(planned))
        else {
            self.interrupt();
            return false;
        };
        let velocity = (measured.com.velocity - planned.com.velocity).xy();
        let window = self.window.get_or_insert(Window { began: velocity, gained: Vector2::zeros(), duration: 0.0 });
        window.gained += (measured_acceleration - planned_acceleration) * dt;
        window.duration += dt;
        let Window { began, gained, duration } = *window;
        if duration >= WINDOW {
            self.window = None;
            self.tilts.rotate_right(1);
            self.tilts[0] = ahead_and_left((gained - (velocity - began)) / (GRAVITY * duration), support);
            if self.common_tilt() > TILT_MAX {
                self.askew = Some(self.tilts.iter().sum::<Vector2<f64>>() / WINDOWS as f64);
            }
        }
        self.askew.is_some()
    }

    /// The tilt of the orientation that was found, in support coordinates (rad).
    pub(crate) fn askew(&self, support: Side) -> Option<Vector2<f64>> {
        self.askew.map(|tilt| ahead_and_left(tilt, support))
    }

    /// Nothing is measured, or the robot steps: forgets the past, but not what was found.
    pub(crate) fn interrupt(&mut self) {
        *self = Self { askew: self.askew, ..Self::default() };
    }

    /// Forgets everything.
    pub(crate) fn reset(&mut self) {
        *self = Self::default();
    }

    /// The least tilt ahead, back, left or right that each window has (rad).
    fn common_tilt(&self) -> f64 {
        let least = |along: fn(&Vector2<f64>) -> f64| self.tilts.iter().map(along).fold(f64::INFINITY, f64::min);
        let directions: [fn(&Vector2<f64>) -> f64; 4] = [|tilt| tilt.x, |tilt| -tilt.x, |tilt| tilt.y, |tilt| -tilt.y];
        directions.map(least).into_iter().fold(0.0, f64::max)
    }
}

/// From support coordinates to ahead and left, and back: with the left foot supporting, left and right are exchanged.
fn ahead_and_left(tilt: Vector2<f64>, support: Side) -> Vector2<f64> {
    if support == Side::Right { tilt } else { Vector2::new(tilt.x, -tilt.y) }
}

/// Horizontal acceleration of the centre of mass by the law of the module (m/s²); `None` without a zero-moment point.
fn acceleration(state: &BalanceState) -> Option<Vector2<f64>> {
    const HEIGHT_MIN: f64 = 0.1;
    Some((state.com.position.xy() - state.zmp?) * (GRAVITY / state.com.position.z.max(HEIGHT_MIN)))
}

#[cfg(test)]
mod tests {
    use model::ComState;
    use nalgebra::Vector3;

    use super::*;

    const PERIOD: f64 = 1e-3;
    const HEIGHT: f64 = 0.9;

    /// What is found of a point mass that sways to and fro for four seconds, and after how long. It obeys the law of
    /// the module; its measured place is off by that of an orientation askew by `tilt` (rad).
    ///
    /// * `push` – a change of velocity at 1.5 s (m/s)
    fn found(tilt: Vector2<f64>, push: f64, support: Side) -> Option<(f64, Vector2<f64>)> {
        let mut gravity = GravityConsistency::default();
        for tick in 0..4000 {
            let time = f64::from(tick) * PERIOD;
            let (sway, omega) = (0.02, 3.0_f64);
            let place = Vector2::new(0.1, 0.09) + Vector2::new(sway, sway) * (omega * time).sin();
            let velocity = Vector2::new(sway, sway) * omega * (omega * time).cos();
            let zmp = place + Vector2::new(sway, sway) * (omega * time).sin() * omega.powi(2) * HEIGHT / GRAVITY;
            let pushed = if time > 1.5 { push } else { 0.0 };
            let measured = BalanceState {
                com: ComState {
                    position: (place + ahead_and_left(tilt, support) * HEIGHT).push(HEIGHT),
                    velocity: velocity.push(0.0) + Vector3::new(pushed, 0.0, 0.0),
                },
                tilt: Vector2::zeros(),
                zmp: Some(zmp),
                foot: None,
            };
            let com = ComState { position: Vector3::new(0.1, 0.09, HEIGHT), velocity: Vector3::zeros() };
            let planned = BalanceState { com, tilt: Vector2::zeros(), zmp: Some(com.position.xy()), foot: None };
            if gravity.update(&measured, &planned, support, PERIOD) {
                return gravity.askew(support).map(|tilt| (time, ahead_and_left(tilt, support)));
            }
        }
        None
    }

    #[test]
    fn an_orientation_askew_by_two_degrees_is_found_within_a_second() {
        for tilt in [Vector2::new(0.035, 0.0), Vector2::new(0.0, 0.035), Vector2::new(-0.02, -0.03)] {
            for support in Side::BOTH {
                let (after, found) = found(tilt, 0.0, support).expect("it is found");
                assert!(after < 0.8, "after {after} s");
                assert!((found - tilt).norm() < 1e-3, "{found}");
            }
        }
    }

    #[test]
    fn a_mass_that_sways_as_measured_and_a_push_are_no_tilt() {
        assert_eq!(found(Vector2::zeros(), 0.0, Side::Right), None);
        assert_eq!(found(Vector2::zeros(), 0.3, Side::Right), None);
        assert_eq!(found(Vector2::new(0.017, 0.017), 0.0, Side::Left), None);
    }
}
