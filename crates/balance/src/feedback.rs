//! Feedback through the ankles: the error of the divergent component of motion moves the wanted ZMP, and small angles of
//! the bearing ankle move the ZMP (the paper's own joints; the law is DESIGN §5.3's).

use model::{GRAVITY, Joint, Mechanism, Mirror, Motion};
use nalgebra::{Vector2, Vector3};

use crate::{CentreOfMass, FeedbackParameters};

/// The ankles that lean, the bearing one first.
const ANKLES: [[Joint; 2]; 2] =
    [[Joint::RightAnkleRoll, Joint::RightAnklePitch], [Joint::LeftAnkleRoll, Joint::LeftAnklePitch]];

/// Farthest that the ZMP is moved between both feet [m].
const SHIFT_ON_BOTH_FEET: f64 = 0.03;

/// Rotation of the body over the bearing ankle, about x and y [rad].
pub type AnkleLean = Vector2<f64>;

/// Turns the error of the divergent component into ankle angles. The bearing ankle follows the wanted lean; what the
/// other one still has from its own turn fades out. Both do so as critically damped second-order lags, so that angles and
/// rates stay continuous whatever happens.
#[derive(Clone, Debug)]
pub struct Feedback {
    parameters: FeedbackParameters,
    /// Moment that moves the ZMP by a metre, over the ankle's stiffness: lean per ZMP shift [rad/m].
    lean_per_shift: f64,
    sole_half_size: Vector2<f64>,
    sole_centre: Vector2<f64>,
    /// Of the bearing ankle's joints.
    axes: [Vector3<f64>; 2],
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
            offsets: Motion::default(),
            lean: Vector2::zeros(),
            parameters,
        }
    }

    /// Absorbs where the centre of mass is against where it should be, and moves the offsets on.
    ///
    /// * `zmp_planned` – where the ground should push if all went as planned [m]
    /// * `on_both_feet` – whether the other foot bears, too, so that the point may leave the bearing sole
    /// * `dt` – time since the last update [s]
    pub fn update(
        &mut self,
        planned: &CentreOfMass,
        sensed: Option<&CentreOfMass>,
        zmp_planned: Vector2<f64>,
        on_both_feet: bool,
        dt: f64,
    ) {
        if let Some(sensed) = sensed {
            let error = sensed.divergent_component() - planned.divergent_component();
            let shift = if on_both_feet {
                (error * self.parameters.gain).map(|shift| shift.clamp(-SHIFT_ON_BOTH_FEET, SHIFT_ON_BOTH_FEET))
            } else {
                self.zmp_shift(error, zmp_planned)
            };
            // To push the ground further ahead (+x) the body leans back (−y); further left (+y) it leans right (+x).
            self.lean = Vector2::new(shift.y, -shift.x) * self.lean_per_shift;
        }
        let lean = Vector3::new(self.lean.x, self.lean.y, 0.0);
        for (joint, axis) in ANKLES[0].into_iter().zip(self.axes) {
            self.follow(joint, axis.dot(&lean), self.parameters.lag, dt);
        }
        for joint in ANKLES[1] {
            self.follow(joint, 0.0, self.parameters.fade, dt);
        }
    }

    /// The other foot bears: what was the bearing ankle's is now the swinging one's.
    pub fn swap(&mut self, mirror: &Mirror) {
        self.offsets = self.offsets.mirrored(mirror);
        self.lean = Vector2::zeros();
    }

    /// Lets everything fade: nothing bears, or nothing is known.
    pub fn release(&mut self) {
        self.lean = Vector2::zeros();
    }

    /// How far the ZMP is to be moved: proportional to the error, and never to where the sole ends.
    fn zmp_shift(&self, error: Vector2<f64>, zmp_planned: Vector2<f64>) -> Vector2<f64> {
        let room = (self.sole_half_size - Vector2::repeat(self.parameters.edge)).map(|size| size.max(0.0));
        let wanted = zmp_planned + error * self.parameters.gain - self.sole_centre;
        let inside = wanted.zip_map(&room, |wanted, room| wanted.min(room).max(-room));
        // A plan outside the sole is not dragged inside by feedback alone: only errors move the point.
        let shift = inside + self.sole_centre - zmp_planned;
        shift.zip_map(&error, |shift, error| {
            let allowed = error * self.parameters.gain;
            shift.min(allowed.max(0.0)).max(allowed.min(0.0))
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

    /// What is added at present: angles with their rates, in support coordinates.
    pub fn offsets(&self) -> &Motion {
        &self.offsets
    }
}
