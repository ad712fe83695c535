//! The dynamics of the commanded motion, by inverse dynamics: joint torques, zero-moment point (ZMP), centre of mass.

use model::{ComState, Joint, JointVector, Mechanism, Mirror, Mirrored, Motion, Side, Sole, Wrench};
use nalgebra::{Vector2, Vector3};

use crate::{Kinematics, NewtonEuler, SupportPolygon, Tree, ground_torques, zmp};

/// Which feet are on the ground as planned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlannedContact {
    /// The support foot alone.
    SupportFoot,
    /// Both, around a support change: the weight moves from foot to foot within a few hundredths of a second.
    SupportChange,
    /// Both, in a stand.
    BothFeet,
}

/// What a motion needs of drives and ground if the support sole stays flat.
#[derive(Clone, Debug)]
pub struct ReferenceDynamics {
    inverse: NewtonEuler,
    /// The same motion on the swing foot; used where it carries a share.
    other: NewtonEuler,
    sole: SupportPolygon,
    /// The soles, alike on both feet.
    soles: Sole,
    /// Reflected inertias of the rotors (kg·m²).
    rotors: JointVector,
    /// Lean of the vertical over the support sole: x and y of the unit vector (-).
    vertical: Vector2<f64>,
    /// The swing foot's share of the ground reaction (-).
    swing_share: f64,
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
            other: NewtonEuler::default(),
            sole: SupportPolygon::hull(mechanism.sole.corners(Side::Right).map(|corner| corner.xy())),
            soles: mechanism.sole,
            rotors,
            vertical: Vector2::zeros(),
            swing_share: 0.0,
            torques: JointVector::ZERO,
            zmp: Vector2::zeros(),
            margin: 0.0,
            com: kinematics.com_state(tree, &JointVector::ZERO),
        };
        dynamics.update(tree, mirror, &Motion::default(), PlannedContact::SupportFoot);
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

    /// Lean of the vertical over the support sole as planned: x and y of the unit vector (-).
    pub fn vertical(&self) -> Vector2<f64> {
        self.vertical
    }

    /// The kinematics of the motion.
    pub fn kinematics(&self) -> &Kinematics {
        &self.inverse.kinematics
    }

    /// Acceleration of the trunk's origin less gravity, in support axes (m/s²): what an accelerometer there would tell.
    pub fn specific_force_of_trunk(&self) -> Vector3<f64> {
        self.inverse.links[Mechanism::TRUNK].acceleration
    }

    /// Wrench of the ground about the origin of the support sole, in its axes, if it alone carries the robot.
    pub fn ground_on_sole(&self) -> Wrench {
        let axes = self.inverse.kinematics.rotation[Mechanism::RIGHT_FOOT];
        let Wrench { force, moment } = self.inverse.ground;
        Wrench { force: axes.tr_mul(&force), moment: axes.tr_mul(&moment) }
    }

    /// Torques of the leg joints beyond the planned ones, because the ground pushes otherwise than planned (N·m).
    ///
    /// * `feet` – wrenches of the ground on the support and on the swing foot, each about the origin of its sole in its
    ///   axes
    pub fn torques_beyond(&self, tree: &Tree, mechanism: &Mechanism, feet: [Wrench; 2]) -> JointVector {
        let (kinematics, ground) = (self.kinematics(), self.inverse.ground);
        let [support, swing] = std::array::from_fn(|foot| {
            let sole = kinematics.sole_to_world(mechanism, Side::BOTH[foot]);
            let Wrench { force, moment } = feet[foot];
            let wrench = Wrench { force: sole.rotation * force, moment: sole.rotation * moment };
            wrench.about(-sole.translation.vector)
        });
        let planned = [ground * (1.0 - self.swing_share), ground * self.swing_share];
        ground_torques(tree, kinematics, &[support - planned[0], swing - planned[1]])
    }

    /// Computes the dynamics of a motion.
    ///
    /// The support foot carries all. In a stand both feet share the ground reaction as the ZMP lies between them, and
    /// around a support change as it lies between their edges. Torques are linear in that share: they are a mixture of
    /// those of standing on either foot.
    ///
    /// * `motion` – in support coordinates; on a slope `FootRoll` and `FootPitch` are the pose of the sole in level
    ///   axes
    pub fn update(&mut self, tree: &Tree, mirror: &Mirror, motion: &Motion, contact: PlannedContact) {
        self.vertical = Vector2::new(-motion.angles[Joint::FootPitch], motion.angles[Joint::FootRoll]);
        self.inverse.compute_fixed_base(tree, motion);
        // A motion that needs no ground has its ZMP infinitely far away; the last one stands for it.
        if let Some(point) = zmp(&self.inverse.ground) {
            self.zmp = point;
        }
        let share = self.share_of_swing_foot(tree, contact);
        self.swing_share = share;
        let on_support = self.inverse.torques;
        let carried = if share > 0.0 {
            let on_swing = self.on_swing_foot(tree, mirror, motion);
            on_support * (1.0 - share) + on_swing * share
        } else {
            on_support
        };
        let rotors = motion.accelerations.zip_with(&self.rotors, |acceleration, rotor| acceleration * rotor);
        self.torques = carried + rotors;
        self.margin = self.sole.margin(self.zmp);
        self.com = self.inverse.kinematics.com_state(tree, &motion.rates);
    }

    /// Torques of the motion if the swing foot carries all (N·m).
    fn on_swing_foot(&mut self, tree: &Tree, mirror: &Mirror, motion: &Motion) -> JointVector {
        self.other.compute_fixed_base(tree, &motion.mirrored(mirror));
        self.other.torques.mirrored(mirror)
    }

    /// The swing foot's share of the ground reaction.
    fn share_of_swing_foot(&self, tree: &Tree, contact: PlannedContact) -> f64 {
        let to_swing = self.inverse.kinematics.origin[tree.foot(Side::Left)].xy();
        let along = self.zmp.dot(&to_swing) / to_swing.norm_squared();
        let (leaves, enters) = match contact {
            PlannedContact::SupportFoot => return 0.0,
            PlannedContact::SupportChange => self.gap(to_swing),
            PlannedContact::BothFeet => (0.0, 1.0),
        };
        if enters > leaves { ((along - leaves) / (enters - leaves)).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// Where the way from ankle to ankle leaves the support sole and enters the other one, taken to be parallel (-).
    fn gap(&self, way: Vector2<f64>) -> (f64, f64) {
        let Sole { ahead, behind, inside, outside, .. } = self.soles;
        let share = |room: f64, length: f64| if length.abs() > room { room / length.abs() } else { 1.0 };
        // Both soles have the same side towards each other.
        let aside = share(if way.y >= 0.0 { inside } else { outside }, way.y);
        let [before, beyond] = if way.x >= 0.0 { [ahead, behind] } else { [behind, ahead] };
        (share(before, way.x).min(aside), 1.0 - share(beyond, way.x).min(aside))
    }
}
