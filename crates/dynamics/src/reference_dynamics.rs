//! The dynamics of the commanded motion, by inverse dynamics: joint torques, zero-moment point (ZMP), centre of mass.

use model::{ComState, Joint, JointVector, Mechanism, Mirror, Mirrored, Motion, Side};
use nalgebra::{Vector2, Vector3};

use crate::{Kinematics, NewtonEuler, SupportPolygon, Tree, zmp};

/// What a motion needs of drives and ground if the support sole stays flat.
#[derive(Clone, Debug)]
pub struct ReferenceDynamics {
    inverse: NewtonEuler,
    sole: SupportPolygon,
    /// Reflected inertias of the rotors (kg·m²).
    rotors: JointVector,
    /// Lean of the vertical over the support sole: x and y of the unit vector (-).
    vertical: Vector2<f64>,
    /// Torques of the drives, rotors included (N·m).
    pub torques: JointVector,
    /// ZMP of the motion, relative to O (m); outside the sole it is fictitious.
    pub zmp: Vector2<f64>,
    /// Signed distance of the ZMP to the edge of the support sole (m).
    pub margin: f64,
    /// Centre of mass of the motion.
    pub com: ComState,
}

impl ReferenceDynamics {
    /// The dynamics of the robot standing straight.
    pub fn new(mechanism: &Mechanism, tree: &Tree, mirror: &Mirror) -> Self {
        let rotors = model::PerJoint::from_fn(|joint| {
            mechanism.links[joint].motor.map_or(0.0, |motor| motor.reflected_inertia())
        });
        let kinematics = Kinematics::fixed_base(tree, &JointVector::ZERO);
        let mut dynamics = Self {
            inverse: NewtonEuler::default(),
            sole: SupportPolygon::hull(mechanism.sole.corners().map(|corner| corner.xy())),
            rotors,
            vertical: Vector2::zeros(),
            torques: JointVector::ZERO,
            zmp: Vector2::zeros(),
            margin: 0.0,
            com: kinematics.com_state(tree, &JointVector::ZERO),
        };
        dynamics.update(tree, mirror, &Motion::default(), false);
        dynamics
    }

    /// The tilt of the robot beyond this motion, about x and y of support coordinates (rad): by a sole that tips, or by
    /// joints that yield.
    ///
    /// * `up_in_trunk` – the measured vertical, in the axes of the trunk
    /// * `vertical` – lean of the vertical over the floor as sensed by the soles (-)
    pub fn tilt(&self, up_in_trunk: &Vector3<f64>, vertical: Vector2<f64>) -> Vector2<f64> {
        let up = self.inverse.kinematics.rotation[Mechanism::TRUNK] * up_in_trunk;
        let up = up.xy() + self.vertical - vertical;
        Vector2::new(up.y, -up.x)
    }

    /// The kinematics of the motion.
    pub fn kinematics(&self) -> &Kinematics {
        &self.inverse.kinematics
    }

    /// Computes the dynamics of a motion.
    ///
    /// In single support the support foot carries all. In double support both feet share the ground reaction as the ZMP
    /// lies between them. Torques are linear in that share: they are a mixture of those of standing on either foot.
    ///
    /// * `motion` – in support coordinates; on a slope `FootRoll` and `FootPitch` are the pose of the sole in level
    ///   axes
    pub fn update(&mut self, tree: &Tree, mirror: &Mirror, motion: &Motion, in_double_support: bool) {
        self.vertical = Vector2::new(-motion.angles[Joint::FootPitch], motion.angles[Joint::FootRoll]);
        let on_swing = in_double_support.then(|| {
            self.inverse.compute_fixed_base(tree, &motion.mirrored(mirror));
            self.inverse.torques.mirrored(mirror)
        });
        self.inverse.compute_fixed_base(tree, motion);
        // A motion that needs no ground has its ZMP infinitely far away; the last one stands for it.
        if let Some(point) = zmp(&self.inverse.ground) {
            self.zmp = point;
        }
        let on_support = self.inverse.torques;
        let carried = on_swing.map_or(on_support, |on_swing| {
            let to_swing = self.inverse.kinematics.origin[Mechanism::foot(Side::Left)].xy();
            let share = (self.zmp.dot(&to_swing) / to_swing.norm_squared()).clamp(0.0, 1.0);
            on_support * (1.0 - share) + on_swing * share
        });
        let rotors = motion.accelerations.zip_with(&self.rotors, |acceleration, rotor| acceleration * rotor);
        self.torques = carried + rotors;
        self.margin = self.sole.margin(self.zmp);
        self.com = self.inverse.kinematics.com_state(tree, &motion.rates);
    }
}
