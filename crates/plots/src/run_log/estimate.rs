//! The robot as the controller estimates it, where nobody recorded what it truly was: a real robot, or a simulation of
//! one's own.

use dynamics::{Kinematics, Tree};
use interface::{Fault, Mode, Report};
use model::{Joint, Mechanism, Side};
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};
use wire::MeasurementMessage;

use super::PlantRow;

/// Estimates the state of the robot from reports and measurements.
pub(super) struct Estimator<'m> {
    mechanism: &'m Mechanism,
    tree: Tree,
}

impl<'m> Estimator<'m> {
    /// An estimator for a robot.
    pub(super) fn new(mechanism: &'m Mechanism) -> Self {
        Self { mechanism, tree: Tree::new(mechanism) }
    }

    /// The state at a time (s), in the walk frame: the support sole lies flat where odometry has it, and the joints are
    /// as measured.
    pub(super) fn row(&self, time: f64, tick: u64, report: &Report, measured: &MeasurementMessage) -> PlantRow {
        let mut sample = measured.measurement();
        // The sole lies flat: its pose has the tilt that these hold.
        (sample.angles[Joint::FootRoll], sample.angles[Joint::FootPitch]) = (0.0, 0.0);
        let support = report.half_step.support;
        let sole = report.odometry.support_sole;
        let support_to_world = Isometry3::new(Vector3::new(sole.x, sole.y, 0.0), Vector3::new(0.0, 0.0, sole.heading));
        let mut kinematics = Kinematics::default();
        kinematics.compute_floating_base(&self.tree, &Isometry3::identity(), &sample.angles);
        let to_support = kinematics.sole_to_world(self.mechanism, support).inverse();
        let right_sole_to_world = support_to_world * to_support * kinematics.sole_to_world(self.mechanism, Side::Right);
        let com = report.com_measured.map_or_else(
            || support_to_world * to_support * Point3::from(kinematics.com(&self.tree)),
            |com| support_to_world * Point3::from(com.position),
        );
        let zmp = report.zmp_in_support.map(|zmp| support_to_world * Point3::new(zmp.x, zmp.y, 0.0));
        let trunk_to_level = UnitQuaternion::new_normalize(sample.orientation);
        PlantRow {
            time,
            tick,
            right_sole_to_world,
            angles: sample.angles,
            loads: sample.feet.map(|foot| foot.force.z),
            com_in_world: com.coords,
            com_velocity: report.com_measured.map(|com| support_to_world * com.velocity),
            zmp_in_world: zmp.map(|zmp| zmp.coords.xy()),
            trunk_tilt: (trunk_to_level * Vector3::z()).z.clamp(-1.0, 1.0).acos(),
            fallen: report.mode == Mode::Fallen || report.faults.contains(Fault::Fallen),
        }
    }
}
