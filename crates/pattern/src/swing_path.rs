//! The path of the swing sole: as in the modified half-step, but from where the foot really stands to a landing on the
//! ground, level and at rest at both ends.
//!
//! The plain sum of joint offsets leaves the sole millimetres above or below the ground when a longer step ends, and
//! lets it land with the heading's share of the robot's speed when a turn ends; either would be a blow.

use nalgebra::Vector4;
use signal::smooth_step;

use crate::footprint::SolePose;

/// The corrections of one half-step's swing sole, over its progress from 0 to 1. Each is position (m) and yaw (rad).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SwingPath {
    /// Offset of the real lift-off from that of the modified half-step.
    lift_off: Vector4<f64>,
    /// Offset of the planned landing from that of the modified half-step.
    landing: Vector4<f64>,
    /// Rate of the modified half-step at its start, per progress.
    start_rate: Vector4<f64>,
    /// Rate of the modified half-step at its end, per progress.
    end_rate: Vector4<f64>,
    redirection: Option<Redirection>,
}

/// What another landing adds to the corrections.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Redirection {
    /// Progress from which on.
    from: f64,
    /// More offset of the landing.
    landing: Vector4<f64>,
    /// More rate at the end, per progress.
    end_rate: Vector4<f64>,
}

/// Step of progress over which rates are differenced.
const RATE_STEP: f64 = 1e-4;

impl SwingPath {
    /// The path of a half-step.
    ///
    /// * `lift_off` – where the foot stands
    /// * `landing` – where it shall land
    /// * `modified` – the swing sole of the modified half-step at a progress
    pub(crate) fn new(lift_off: &SolePose, landing: &SolePose, modified: impl Fn(f64) -> SolePose) -> Self {
        let (first, last) = (vector(&modified(0.0)), vector(&modified(1.0)));
        let start_rate = (vector(&modified(RATE_STEP)) - first) / RATE_STEP;
        let end_rate = (last - vector(&modified(1.0 - RATE_STEP))) / RATE_STEP;
        let (lift_off, landing) = (vector(lift_off) - first, vector(landing) - last);
        Self { lift_off, landing, start_rate, end_rate, redirection: None }
    }

    /// Whether the landing was changed on the way; it is once at most.
    pub(crate) fn is_redirected(&self) -> bool {
        self.redirection.is_some()
    }

    /// Lands elsewhere, from a progress on, at which the modified half-step changes smoothly.
    ///
    /// * `landing` – where the foot shall land
    /// * `modified` – the swing sole of the modified half-step at a progress, as changed
    pub(crate) fn redirect(&mut self, from: f64, landing: &SolePose, modified: impl Fn(f64) -> SolePose) {
        let last = vector(&modified(1.0));
        let end_rate = (last - vector(&modified(1.0 - RATE_STEP))) / RATE_STEP;
        self.redirection = Some(Redirection {
            from,
            landing: vector(landing) - last - self.landing,
            end_rate: end_rate - self.end_rate,
        });
    }

    /// The swing sole at `progress`.
    ///
    /// * `modified` – the swing sole of the modified half-step there
    pub(crate) fn at(&self, progress: f64, modified: &SolePose) -> SolePose {
        let s = progress;
        let blend = smooth_step(s);
        let leaving = s * (1.0 - s) * (1.0 - s);
        let arriving = -s * s * (1.0 - s);
        let redirected = self.redirection.map_or_else(Vector4::zeros, |redirection| redirection.at(s));
        pose(
            vector(modified) + redirected + self.lift_off * (1.0 - blend) + self.landing * blend
                - self.start_rate * leaving
                - self.end_rate * arriving,
        )
    }
}

impl Redirection {
    /// What it adds at a progress: nothing but at the end, and smooth from where it begins.
    fn at(&self, progress: f64) -> Vector4<f64> {
        let span = 1.0 - self.from;
        let u = ((progress - self.from) / span).max(0.0);
        self.landing * smooth_step(u) - self.end_rate * (u * u * u * (u - 1.0) * span)
    }
}

fn vector(pose: &SolePose) -> Vector4<f64> {
    pose.position.push(pose.yaw)
}

fn pose(vector: Vector4<f64>) -> SolePose {
    SolePose { position: vector.xyz(), yaw: vector.w }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn swing_sole_leaves_and_lands_at_rest_where_planned() {
        // A modified half-step that starts and ends elsewhere, and moves at both ends.
        let modified = |s: f64| SolePose { position: Vector3::new(0.4 * s - 0.2, 0.19, 0.05 * s), yaw: 0.3 * s };
        let lift_off = SolePose { position: Vector3::new(-0.21, 0.18, 0.0), yaw: 0.0 };
        let landing = SolePose { position: Vector3::new(0.25, 0.2, 0.0), yaw: 0.25 };
        let path = SwingPath::new(&lift_off, &landing, modified);
        let at = |s: f64| vector(&path.at(s, &modified(s)));
        assert!((at(0.0) - vector(&lift_off)).norm() < 1e-12);
        assert!((at(1.0) - vector(&landing)).norm() < 1e-12);
        let h = 1e-6;
        assert!(((at(h) - at(0.0)) / h).norm() < 1e-4);
        assert!(((at(1.0) - at(1.0 - h)) / h).norm() < 1e-4);
    }

    /// The modified half-step changes at 0.4, smoothly, by what lands elsewhere and at another rate.
    #[test]
    fn a_redirected_swing_sole_goes_on_smoothly_and_lands_at_rest_where_planned() {
        let from = 0.4;
        let before = |s: f64| SolePose { position: Vector3::new(0.4 * s - 0.2, 0.19, 0.05 * s), yaw: 0.3 * s };
        let after = |s: f64| {
            let more = (s - from).max(0.0).powi(3);
            SolePose { position: before(s).position + Vector3::new(0.5, -0.2, 0.1) * more, yaw: 0.3 * s + 0.4 * more }
        };
        let lift_off = SolePose { position: Vector3::new(-0.21, 0.18, 0.0), yaw: 0.0 };
        let planned = SolePose { position: Vector3::new(0.21, 0.2, 0.0), yaw: 0.25 };
        let elsewhere = SolePose { position: Vector3::new(0.33, 0.14, 0.0), yaw: 0.4 };
        let first = SwingPath::new(&lift_off, &planned, before);
        let mut path = first;
        path.redirect(from, &elsewhere, after);
        let at = |s: f64| vector(&path.at(s, &after(s)));
        assert!((at(1.0) - vector(&elsewhere)).norm() < 1e-12);
        let h = 1e-5;
        assert!(((at(1.0) - at(1.0 - h)) / h).norm() < 1e-2, "{}", (at(1.0) - at(1.0 - h)) / h);
        // Rate and acceleration where it begins are those of the path before.
        let old = |s: f64| vector(&first.at(s, &before(s)));
        assert_eq!(at(from), old(from));
        let rates = |at: &dyn Fn(f64) -> Vector4<f64>| [(at(from + h) - at(from)) / h, (at(from) - at(from - h)) / h];
        let ([new_after, _], [old_after, _]) = (rates(&at), rates(&old));
        assert!((new_after - old_after).norm() < 1e-6, "{}", new_after - old_after);
    }
}
