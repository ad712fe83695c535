//! The posture that has the centre of mass and the feet where they are wanted, by leg inverse kinematics.

use dynamics::{Kinematics, Leg, Unreachable, UpperBody};
use model::{Joint, JointVector, Side};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector2, Vector3};

use crate::preview::footprint::turned_about_z;
use crate::preview::{Biped, SolePose};

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
    /// Waist and arms; the legs' angles are not used.
    pub upper: JointVector,
    /// The same as what the pelvis carries.
    pub carried: UpperBody,
}

/// Finds postures, each from the one before.
#[derive(Clone, Debug)]
pub struct WholeBody {
    angles: JointVector,
    kinematics: Kinematics,
    /// How the angles changed from the posture before: the next change is likely the same.
    change: JointVector,
    /// The pelvis' origin (the bearing leg's hip) less the centre of mass, in the last posture [m].
    hip_from_com: Vector2<f64>,
    /// How that changed from posture to posture, the last two times.
    hip_changes: [Vector2<f64>; 2],
}

/// Share of a leg's length that is used at most: the knee keeps a bend of 15°.
const LEG_SHARE_MAX: f64 = 0.994;
const PELVIS: Joint = Leg(Side::Right).end();
const ROUNDS: usize = 6;
/// How near the centre of mass must be to where it is wanted for one more correction to be enough [m]. A correction leaves
/// about 3 % of a miss, and 1 µm in a knot is a millimetre of ZMP.
const NEAR: f64 = 1e-5;

impl WholeBody {
    /// Begins from a posture.
    pub fn new(biped: &Biped, angles: &JointVector) -> Self {
        let kinematics = Kinematics::standing(&biped.tree, angles);
        let hip_from_com = kinematics.origin[PELVIS].xy() - kinematics.com(&biped.tree).xy();
        Self {
            angles: *angles,
            kinematics,
            change: JointVector::ZERO,
            hip_from_com,
            hip_changes: [Vector2::zeros(); 2],
        }
    }

    /// Tells how the angles will likely change.
    pub fn expect(&mut self, change: &JointVector) {
        self.change = *change;
    }

    /// The posture that fulfils `wanted`.
    ///
    /// # Errors
    /// [`Unreachable`] when a leg is too short; the posture stays.
    pub fn reach(&mut self, biped: &Biped, wanted: &Wanted) -> Result<JointVector, Unreachable> {
        let Biped { tree, mechanism, legs, .. } = biped;
        let mut angles = self.angles + self.change;
        for joint in Joint::ALL.into_iter().filter(|joint| !joint.is_in_leg()) {
            angles[joint] = wanted.upper[joint];
        }
        let ankle = Translation3::from(-mechanism.sole_in_foot(Side::Left));
        let foot = wanted.swinging.to_support() * ankle;
        let heading = turned_about_z(wanted.pelvis_yaw);

        let [change, before] = self.hip_changes;
        let mut hip = wanted.com + self.hip_from_com + change * 2.0 - before;
        let hip_height = self.within_reach(biped, wanted.hip_height, hip, &heading, &foot.translation.vector);
        let mut is_near = false;
        for _ in 0..ROUNDS {
            let pelvis = Isometry3::from_parts(Translation3::new(hip.x, hip.y, hip_height), heading);
            legs.solve(tree, Leg(Side::Right), &pelvis, &Isometry3::identity(), &mut angles)?;
            legs.solve(tree, Leg(Side::Left), &pelvis, &foot, &mut angles)?;
            if is_near {
                break;
            }
            self.kinematics.stand_on_legs(tree, &angles);
            let miss = wanted.com - self.kinematics.com_under(tree, &wanted.carried).xy();
            hip += miss / biped.com_per_pelvis;
            is_near = miss.amax() < NEAR;
        }
        self.change = angles - self.angles;
        let hip_from_com = hip - wanted.com;
        self.hip_changes = [hip_from_com - self.hip_from_com, change];
        self.hip_from_com = hip_from_com;
        self.angles = angles;
        Ok(angles)
    }

    /// The hips' height, lowered where a leg would be too short.
    fn within_reach(
        &self,
        biped: &Biped,
        height: f64,
        hip: Vector2<f64>,
        heading: &UnitQuaternion<f64>,
        other_ankle: &Vector3<f64>,
    ) -> f64 {
        let links = &biped.mechanism.links;
        let leg_max =
            LEG_SHARE_MAX * (links[Joint::RightKnee].origin.norm() + links[Joint::RightHipPitch].origin.norm());
        let reach = |hip: Vector2<f64>, ankle: &Vector3<f64>| {
            ankle.z + (leg_max * leg_max - (hip - ankle.xy()).norm_squared()).max(0.0).sqrt()
        };
        let bearing_ankle = Vector3::z() * biped.mechanism.sole.ankle_height;
        let other_hip = hip + (heading * links[Joint::LeftHipRoll].origin).xy();
        soft_min(soft_min(height, reach(hip, &bearing_ankle)), reach(other_hip, other_ankle))
    }

    /// The other foot bears: the same posture told from there.
    pub fn swap(&mut self, biped: &Biped) {
        let change = biped.mirror.apply(&self.change);
        *self = Self { change, ..Self::new(biped, &biped.mirror.apply(&self.angles)) };
    }
}

/// The smaller of two lengths [m], rounded where they are about the same; twice continuously differentiable.
fn soft_min(a: f64, b: f64) -> f64 {
    const ROUNDING: f64 = 0.015;
    let near = (1.0 - (a - b).abs() / ROUNDING).max(0.0);
    a.min(b) - near * near * near * ROUNDING / 6.0
}
