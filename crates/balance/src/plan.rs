//! What the asked motion needs, by inverse dynamics: joint torques, ZMP, centre of mass.

use dynamics::{NewtonEuler, SupportPolygon, Tree, zmp};
use model::{Joint, JointVector, Mechanism, Mirror, Motion, Side};
use nalgebra::Vector2;

use crate::CentreOfMass;

/// What a motion needs of drives and ground if the bearing sole stays flat.
#[derive(Clone, Debug)]
pub struct Plan {
    inverse: NewtonEuler,
    sole: SupportPolygon,
    /// Reflected rotor inertias [kg·m²].
    rotors: JointVector,
    /// Torques of the drives, rotors included [N·m].
    pub torques: JointVector,
    /// Where the ground must push, relative to O [m]; outside the sole it is fictitious.
    pub zmp: Vector2<f64>,
    /// Signed distance of that point to the sole's edge [m].
    pub margin: f64,
    /// Of the asked motion.
    pub centre_of_mass: CentreOfMass,
}

impl Plan {
    /// Nothing planned yet: the robot standing straight.
    pub fn new(mechanism: &Mechanism, tree: &Tree, mirror: &Mirror) -> Self {
        let rotors = model::PerJoint::from_fn(|joint| {
            mechanism.links[joint].motor.map_or(0.0, |motor| motor.reflected_inertia())
        });
        let kinematics = dynamics::Kinematics::standing(tree, &JointVector::ZERO);
        let mut plan = Self {
            inverse: NewtonEuler::default(),
            sole: SupportPolygon::hull(mechanism.sole.corners().map(|corner| corner.xy())),
            rotors,
            torques: JointVector::ZERO,
            zmp: Vector2::zeros(),
            margin: 0.0,
            centre_of_mass: CentreOfMass::of_motion(tree, &kinematics, &JointVector::ZERO),
        };
        plan.update(tree, mirror, &Motion::default(), Vector2::zeros(), false);
        plan
    }

    /// Where every link is.
    pub fn kinematics(&self) -> &dynamics::Kinematics {
        &self.inverse.kinematics
    }

    /// What `motion`, told in support coordinates, needs.
    ///
    /// The floor may be a slope: `vertical` is how the vertical leans in axes of the sole (x and y of the unit vector).
    /// Level coordinates then see the sole turned about the ankle's foot, which is what joints 1 and 2 are for.
    ///
    /// On one foot that foot carries all. On both, they share what the ground gives as the ZMP lies between them; torques
    /// are linear in the share: they are those of standing on the one foot and on the other, mixed.
    pub fn update(
        &mut self,
        tree: &Tree,
        mirror: &Mirror,
        motion: &Motion,
        vertical: Vector2<f64>,
        on_both_feet: bool,
    ) {
        let mut motion = *motion;
        motion.angles[Joint::FootRoll] = vertical.y;
        motion.angles[Joint::FootPitch] = -vertical.x;
        let on_other = on_both_feet.then(|| {
            self.inverse.stand(tree, &motion.mirrored(mirror));
            mirror.apply(&self.inverse.torques)
        });
        self.inverse.stand(tree, &motion);
        // A motion that needs no ground has its point infinitely far away; the last one stands for it.
        if let Some(point) = zmp(&self.inverse.ground) {
            self.zmp = point;
        }
        let on_bearing = self.inverse.torques;
        let carried = on_other.map_or(on_bearing, |on_other| {
            let to_other = self.inverse.kinematics.origin[Mechanism::foot(Side::Left)].xy();
            let share = (self.zmp.dot(&to_other) / to_other.norm_squared()).clamp(0.0, 1.0);
            on_bearing * (1.0 - share) + on_other * share
        });
        let rotors = motion.accelerations.zip_with(&self.rotors, |acceleration, rotor| acceleration * rotor);
        self.torques = carried + rotors;
        self.margin = self.sole.margin(self.zmp);
        self.centre_of_mass = CentreOfMass::of_motion(tree, &self.inverse.kinematics, &motion.rates);
    }
}
