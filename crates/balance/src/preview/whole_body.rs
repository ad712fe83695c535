//! The posture that has the centre of mass and the feet where they are wanted, by leg inverse kinematics.

use dynamics::{Kinematics, Leg, Tree, Unreachable, solve_leg};
use model::{Joint, JointVector, Mechanism, Mirror, Side};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector2, Vector3};

use crate::preview::SolePose;

/// What is wanted of a posture, in support coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    /// Projection of the centre of mass [m].
    pub com: Vector2<f64>,
    /// Of the hip joints [m].
    pub hip_height: f64,
    /// Heading of the pelvis, which is level [rad].
    pub pelvis_yaw: f64,
    /// The other foot.
    pub swinging: SolePose,
}

/// Finds postures, each from the one before.
#[derive(Clone, Debug)]
pub struct WholeBody {
    angles: JointVector,
    /// How the angles changed from the posture before: the next change is likely the same.
    change: JointVector,
    /// The pelvis' origin (the bearing leg's hip) less the centre of mass, in the last posture [m].
    hip_from_com: Vector2<f64>,
    /// How that changed.
    hip_change: Vector2<f64>,
}

const PELVIS: Joint = Leg(Side::Right).end();
const ROUNDS: usize = 6;
/// How near the centre of mass must be to where it is wanted [m]: 1 µm in a knot is a millimetre of ZMP.
const NEAR: f64 = 3e-7;
/// Shifting the pelvis shifts this share of the centre of mass: the feet stay.
const COM_PER_PELVIS: f64 = 0.88;

impl WholeBody {
    /// Begins from a posture.
    pub fn new(tree: &Tree, angles: &JointVector) -> Self {
        let kinematics = Kinematics::standing(tree, angles);
        let hip_from_com = kinematics.origin[PELVIS].xy() - kinematics.com(tree).xy();
        Self { angles: *angles, change: JointVector::ZERO, hip_from_com, hip_change: Vector2::zeros() }
    }

    /// The posture that fulfils `wanted`; waist and arms are `upper`'s.
    ///
    /// # Errors
    /// [`Unreachable`] when a leg is too short; the posture stays.
    pub fn reach(
        &mut self,
        tree: &Tree,
        mechanism: &Mechanism,
        upper: &JointVector,
        wanted: &Wanted,
    ) -> Result<JointVector, Unreachable> {
        let mut angles = self.angles + self.change;
        for joint in Joint::ALL.into_iter().filter(|joint| !joint.is_in_leg()) {
            angles[joint] = upper[joint];
        }
        let ankle = Translation3::from(-mechanism.sole_in_foot(Side::Left));
        let foot = wanted.swinging.to_support() * ankle;
        let heading = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), wanted.pelvis_yaw);

        let mut hip = wanted.com + self.hip_from_com + self.hip_change;
        let mut com = wanted.com;
        for _ in 0..ROUNDS {
            let pelvis = Isometry3::from_parts(Translation3::new(hip.x, hip.y, wanted.hip_height), heading);
            solve_leg(tree, Leg(Side::Right), &pelvis, &mut angles)?;
            solve_leg(tree, Leg(Side::Left), &foot, &mut angles)?;
            com = Kinematics::standing(tree, &angles).com(tree).xy();
            let miss = wanted.com - com;
            if miss.amax() < NEAR {
                break;
            }
            hip += miss / COM_PER_PELVIS;
        }
        self.change = angles - self.angles;
        self.hip_change = hip - com - self.hip_from_com;
        self.hip_from_com = hip - com;
        self.angles = angles;
        Ok(angles)
    }

    /// The other foot bears: the same posture told from there.
    pub fn swap(&mut self, tree: &Tree, mirror: &Mirror) {
        let change = mirror.apply(&self.change);
        *self = Self { change, ..Self::new(tree, &mirror.apply(&self.angles)) };
    }
}
