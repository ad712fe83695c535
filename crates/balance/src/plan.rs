//! What the asked motion needs, by inverse dynamics: joint torques, ZMP, centre of mass.

use dynamics::{NewtonEuler, SupportPolygon, Tree, zmp};
use model::{Joint, JointVector, Mechanism, Mirror, Motion, Side};
use nalgebra::{Vector2, Vector3};

use crate::sensed::TRUNK;
use crate::{Balance, CentreOfMass};

/// What a motion needs of drives and ground if the bearing sole stays flat.
#[derive(Clone, Debug)]
pub struct Plan {
    inverse: NewtonEuler,
    sole: SupportPolygon,
    /// Reflected rotor inertias [kg·m²].
    rotors: JointVector,
    /// How the vertical was taken to lean over the sole.
    vertical: Vector2<f64>,
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
            vertical: Vector2::zeros(),
            torques: JointVector::ZERO,
            zmp: Vector2::zeros(),
            margin: 0.0,
            centre_of_mass: CentreOfMass::of_motion(tree, &kinematics, &JointVector::ZERO),
        };
        plan.update(tree, mirror, &Motion::default(), false);
        plan
    }

    /// How the robot is turned beyond the plan, about x and y of support coordinates [rad]: by a sole that tips, by joints
    /// that give way.
    ///
    /// * `up_in_trunk` – the vertical as sensed, in the trunk's axes
    /// * `vertical` – how it leans in axes of the floor, as soles now tell
    pub fn tilt(&self, up_in_trunk: &Vector3<f64>, vertical: Vector2<f64>) -> Vector2<f64> {
        let up = self.inverse.kinematics.rotation[TRUNK] * up_in_trunk;
        let up = up.xy() + self.vertical - vertical;
        Vector2::new(up.y, -up.x)
    }

    /// How the robot balances if all goes as planned.
    pub fn balance(&self) -> Balance {
        Balance { centre_of_mass: self.centre_of_mass, tilt: Vector2::zeros(), zmp: Some(self.zmp) }
    }

    /// Where every link is.
    pub fn kinematics(&self) -> &dynamics::Kinematics {
        &self.inverse.kinematics
    }

    /// What `motion`, told in support coordinates, needs.
    ///
    /// On a slope joints 1 and 2 say how the sole lies in level coordinates.
    ///
    /// On one foot that foot carries all. On both, they share what the ground gives as the ZMP lies between them; torques
    /// are linear in the share: they are those of standing on the one foot and on the other, mixed.
    pub fn update(&mut self, tree: &Tree, mirror: &Mirror, motion: &Motion, on_both_feet: bool) {
        self.vertical = Vector2::new(-motion.angles[Joint::FootPitch], motion.angles[Joint::FootRoll]);
        let on_other = on_both_feet.then(|| {
            self.inverse.stand(tree, &motion.mirrored(mirror));
            mirror.apply(&self.inverse.torques)
        });
        self.inverse.stand(tree, motion);
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
