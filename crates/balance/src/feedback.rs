//! Feedback through the ankles: the error of the divergent component of motion moves the wanted ZMP, and small angles of
//! the bearing ankle move the ZMP (the paper's own joints; the law is DESIGN §5.3's). The swinging ankle keeps its sole
//! level while the body tilts, so that it does not land on an edge.

use model::{GRAVITY, Joint, Mechanism, Mirror, Motion};
use nalgebra::{Vector2, Vector3};

use crate::{CentreOfMass, FeedbackParameters};

/// The ankles that lean, the bearing one first.
const ANKLES: [[Joint; 2]; 2] =
    [[Joint::RightAnkleRoll, Joint::RightAnklePitch], [Joint::LeftAnkleRoll, Joint::LeftAnklePitch]];

/// Farthest that the ZMP is moved between both feet [m].
const SHIFT_ON_BOTH_FEET: f64 = 0.03;

/// Error of the divergent component at touchdown that is not stepped after, ahead and aside: the next ankle takes it out
/// [m].
const LEFT_TO_NEXT_ANKLE: Vector2<f64> = Vector2::new(0.05, 0.03);

/// Farthest that the ankle gives back [m]: 5° of the sole.
const UNEVENNESS_MAX: f64 = 0.6;

/// Error of the divergent component that is beyond what uneven ground does [m].
const TROUBLE: f64 = 0.03;

/// A step is no answer to a sensor's glitch: errors count over this time [s], and up to a length [m].
const ERROR_TIME_CONSTANT: f64 = 0.015;
const ERROR_MAX: f64 = 0.3;

/// Rotation of the body over the bearing ankle, about x and y [rad].
pub type AnkleLean = Vector2<f64>;

/// How the robot balances, as planned or as sensed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balance {
    /// Against the bearing sole.
    pub centre_of_mass: CentreOfMass,
    /// How it is turned beyond the plan, about x and y [rad].
    pub tilt: Vector2<f64>,
    /// Where the ground pushes [m]; as sensed only if the bearing foot bears alone.
    pub zmp: Option<Vector2<f64>>,
}

/// Turns the error of the divergent component into ankle angles. The bearing ankle follows the wanted lean, the other one
/// levels its sole; what it still has from its own turn fades out. Both do so as critically damped second-order lags, so
/// that angles and rates stay continuous whatever happens.
#[derive(Clone, Debug)]
pub struct Feedback {
    parameters: FeedbackParameters,
    /// Moment that moves the ZMP by a metre, over the ankle's stiffness: lean per ZMP shift [rad/m].
    lean_per_shift: f64,
    sole_half_size: Vector2<f64>,
    sole_centre: Vector2<f64>,
    /// Of the bearing ankle's joints.
    axes: [Vector3<f64>; 2],
    /// Of the swinging ankle's.
    swinging_axes: [Vector3<f64>; 2],
    /// Of the divergent component, over some time [m].
    error: Vector2<f64>,
    /// Shift of the ZMP that an uneven sole takes away and the ankle gives back [m].
    unevenness: Vector2<f64>,
    /// Angles and rates of the offsets, in support coordinates.
    offsets: Motion,
    /// What the bearing ankle is asked for now.
    pub lean: AnkleLean,
}

impl Feedback {
    /// No lean.
    pub fn new(mechanism: &Mechanism, parameters: FeedbackParameters) -> Self {
        let sole = &mechanism.sole;
        Self {
            lean_per_shift: mechanism.mass() * GRAVITY / parameters.ankle_stiffness,
            sole_half_size: Vector2::new((sole.ahead + sole.behind) / 2.0, sole.half_width),
            sole_centre: Vector2::new((sole.ahead - sole.behind) / 2.0, 0.0),
            axes: ANKLES[0].map(|joint| mechanism.links[joint].axis.into_inner()),
            swinging_axes: ANKLES[1].map(|joint| mechanism.links[joint].axis.into_inner()),
            error: Vector2::zeros(),
            unevenness: Vector2::zeros(),
            offsets: Motion::default(),
            lean: Vector2::zeros(),
            parameters,
        }
    }

    /// Absorbs how the robot balances against how it should, and moves the offsets on.
    ///
    /// * `sensed` – `None` if nothing good is known
    /// * `on_both_feet` – whether the other foot bears, too, so that the point may leave the bearing sole
    /// * `dt` – time since the last update [s]
    pub fn update(&mut self, planned: &Balance, sensed: Option<&Balance>, on_both_feet: bool, dt: f64) {
        let zmp_planned = planned.zmp.unwrap_or_default();
        let mut level = Vector3::zeros();
        let mut stepped_after = Vector2::zeros();
        if let Some(sensed) = sensed {
            let error = sensed.centre_of_mass.divergent_component() - planned.centre_of_mass.divergent_component();
            let shift = if on_both_feet {
                (error * self.parameters.gain).map(|shift| shift.clamp(-SHIFT_ON_BOTH_FEET, SHIFT_ON_BOTH_FEET))
            } else {
                level = -Vector3::new(sensed.tilt.x, sensed.tilt.y, 0.0);
                stepped_after = error.cap_magnitude(ERROR_MAX);
                self.zmp_shift(error, zmp_planned)
            };
            self.even_out(sensed.zmp.map(|zmp| self.inside(zmp_planned + shift) - zmp), dt);
            let shift = shift + self.unevenness;
            // To push the ground further ahead (+x) the body leans back (−y); further left (+y) it leans right (+x).
            self.lean = Vector2::new(shift.y, -shift.x) * self.lean_per_shift;
        }
        self.error += (stepped_after - self.error) * (dt / (dt + ERROR_TIME_CONSTANT));
        let lean = Vector3::new(self.lean.x, self.lean.y, 0.0);
        for (joint, axis) in ANKLES[0].into_iter().zip(self.axes) {
            self.follow(joint, axis.dot(&lean), self.parameters.lag, dt);
        }
        // The left leg is walked down: its ankle turns the foot, the bearing one the body.
        for (joint, axis) in ANKLES[1].into_iter().zip(self.swinging_axes) {
            self.follow(joint, axis.dot(&level), self.parameters.fade, dt);
        }
    }

    /// A sole on uneven ground tilts the ankle, whose drive then pushes elsewhere: what the ZMP misses is taken out by and by
    /// (foot damping control, Kajita et al. 2010).
    fn even_out(&mut self, missed: Option<Vector2<f64>>, dt: f64) {
        // To hold the ZMP alone is to let the centre of mass run away from it.
        let Some(missed) = missed.filter(|_| self.parameters.gain > 0.0) else { return };
        let evened = self.unevenness + missed * (dt / self.parameters.zmp_lag);
        self.unevenness = evened.map(|shift| shift.clamp(-UNEVENNESS_MAX, UNEVENNESS_MAX));
    }

    /// The other foot bears: what was the bearing ankle's is now the swinging one's.
    pub fn swap(&mut self, mirror: &Mirror) {
        self.offsets = self.offsets.mirrored(mirror);
        self.lean = Vector2::zeros();
        self.unevenness = Vector2::zeros();
        self.error.y = -self.error.y;
    }

    /// Lets everything fade: nothing bears, or nothing is known.
    pub fn release(&mut self) {
        self.lean = Vector2::zeros();
    }

    /// How far the ZMP is to be moved: proportional to the error, and never to where the sole ends.
    fn zmp_shift(&self, error: Vector2<f64>, zmp_planned: Vector2<f64>) -> Vector2<f64> {
        // A plan outside the sole is not dragged inside by feedback alone: only errors move the point.
        let shift = self.inside(zmp_planned + error * self.parameters.gain) - zmp_planned;
        shift.zip_map(&error, |shift, error| {
            let allowed = error * self.parameters.gain;
            shift.min(allowed.max(0.0)).max(allowed.min(0.0))
        })
    }

    /// The nearest point of the sole that is not too near its edge, where alone the ground can push.
    fn inside(&self, zmp: Vector2<f64>) -> Vector2<f64> {
        let room = (self.sole_half_size - Vector2::repeat(self.parameters.edge)).map(|size| size.max(0.0));
        (zmp - self.sole_centre).zip_map(&room, |zmp, room| zmp.min(room).max(-room)) + self.sole_centre
    }

    /// How far the ZMP can be moved from under the ankle, where a walk has it, in the direction of an error [m]. Not from
    /// where it is planned just now: a step that is planned anew moves that, and would take back itself.
    fn room_towards(&self, error: Vector2<f64>) -> Vector2<f64> {
        let edge = self.sole_half_size - Vector2::repeat(self.parameters.edge);
        (edge + self.sole_centre.component_mul(&error.map(f64::signum))).map(|room| room.max(0.0))
    }

    /// How far off its place the divergent component will be at touchdown, beyond what the ankles can do now and then, in
    /// support coordinates [m]. With the ZMP at the edge an error e becomes `room + (e − room)·growth`.
    ///
    /// * `growth` – `e^(ωt)` over the time until then
    pub fn excess(&self, growth: f64) -> Vector2<f64> {
        let room = self.room_towards(self.error);
        Vector2::from_fn(|axis, _| {
            let (error, room) = (self.error[axis], room[axis]);
            let left = room + (error.abs() - room) * growth - LEFT_TO_NEXT_ANKLE[axis];
            left.max(0.0) * error.signum()
        })
    }

    /// One implicit step of a critically damped lag: stable for any `lag` and `dt`.
    fn follow(&mut self, joint: Joint, target: f64, lag: f64, dt: f64) {
        let (angle, rate) = (self.offsets.angles[joint], self.offsets.rates[joint]);
        let next = (rate + (target - angle) * dt / (lag * lag)) / (1.0 + dt / lag).powi(2);
        self.offsets.accelerations[joint] = (next - rate) / dt;
        self.offsets.rates[joint] = next;
        self.offsets.angles[joint] = angle + next * dt;
    }

    /// Whether the robot is so far off balance that legs had better not give way: a foot that lands early props it up.
    pub fn is_in_trouble(&self) -> bool {
        self.error.amax() > TROUBLE
    }

    /// What is added at present: angles with their rates, in support coordinates.
    pub fn offsets(&self) -> &Motion {
        &self.offsets
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn feedback() -> Feedback {
        let mechanism = Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap();
        let parameters = FeedbackParameters {
            gain: 3.0,
            ankle_stiffness: 5000.0,
            edge: 0.005,
            zmp_lag: 0.03,
            lag: 0.01,
            fade: 0.05,
        };
        Feedback::new(&mechanism, parameters)
    }

    /// A resting centre of mass at `x`, `y`, 0.9 m high.
    fn at(x: f64, y: f64) -> Balance {
        let centre_of_mass = CentreOfMass { position: Vector3::new(x, y, 0.9), velocity: Vector3::zeros() };
        Balance { centre_of_mass, tilt: Vector2::zeros(), zmp: None }
    }

    /// The oracle: ξ̇ = ω(ξ − p) of both the plan and the robot, integrated, with the ZMP at the edge of the sole.
    #[test]
    fn the_excess_is_what_a_pendulum_does() {
        let mut feedback = feedback();
        for _ in 0..1000 {
            feedback.update(&at(0.0, 0.0), Some(&at(-0.09, 0.05)), false, 1e-3);
        }
        let omega = at(0.0, 0.0).centre_of_mass.pendulum_rate();
        // The heel is 7 cm behind, the edge 4 cm aside.
        let zmp_shift = Vector2::new(-0.065, 0.035);
        let mut error = Vector2::new(-0.09, 0.05);
        for _ in 0..300_000 {
            error += (error - zmp_shift) * (omega * 1e-6);
        }
        let excess = feedback.excess((omega * 0.3).exp());
        let expected = error - error.map(f64::signum).component_mul(&LEFT_TO_NEXT_ANKLE);
        assert!((excess - expected).norm() < 1e-5, "{excess} instead of {expected}");
    }

    #[test]
    fn what_the_ankle_can_do_needs_no_step() {
        let mut feedback = feedback();
        for _ in 0..1000 {
            feedback.update(&at(0.0, 0.0), Some(&at(0.15, -0.03)), false, 1e-3);
        }
        assert_eq!(feedback.excess(3.0), Vector2::zeros());
    }

    /// The body turned by a small angle about x: the swinging ankle turns the foot back.
    #[test]
    fn the_swinging_sole_stays_level() {
        let mut feedback = feedback();
        for _ in 0..1000 {
            let tilted = Balance { tilt: Vector2::new(0.02, 0.03), ..at(0.0, 0.0) };
            feedback.update(&at(0.0, 0.0), Some(&tilted), false, 1e-3);
        }
        let mechanism = Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap();
        let tree = dynamics::Tree::new(&mechanism);
        let mut angles = feedback.offsets().angles;
        [angles[Joint::FootRoll], angles[Joint::FootPitch]] = [0.02, 0.03];
        let sole = dynamics::Kinematics::standing(&tree, &angles).sole_to_world(&mechanism, model::Side::Left);
        let up = sole.rotation * Vector3::z();
        assert!(up.xy().norm() < 1e-3, "{up}");
    }

    /// The oracle: an ankle drive as stiff as the feedback believes on a sole that a step under its edge tilts. The ground
    /// pushes where it is wanted again, however far the tilt took the point.
    #[test]
    fn what_an_uneven_sole_takes_the_ankle_gives_back() {
        let mut feedback = feedback();
        let taken = Vector2::new(0.2, -0.1);
        let mut zmp = taken;
        for _ in 0..300 {
            feedback.update(&at(0.0, 0.0), Some(&Balance { zmp: Some(zmp), ..at(0.0, 0.0) }), false, 1e-3);
            let offsets = feedback.offsets().angles;
            let lean = Vector2::new(offsets[Joint::RightAnkleRoll], offsets[Joint::RightAnklePitch]);
            let lean = Vector2::new(feedback.axes[0].x * lean.x, feedback.axes[1].y * lean.y);
            zmp = taken + Vector2::new(-lean.y, lean.x) / feedback.lean_per_shift;
        }
        assert!(zmp.norm() < 1e-3, "{zmp}");
    }
}
