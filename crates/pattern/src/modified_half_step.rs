//! The modified half-step: where turn, step extension and sidestep put pelvis and swing sole.
//!
//! The paper adds offsets to hip and ankle joints (eqs. 1 and 2). What they do to its robot holds for any leg, seen as
//! a line from hip to ankle.
//!
//! * A **turn** rotates each leg about itself as seen from ahead: the pelvis about the support leg, the swing foot
//!   about the swing leg.
//! * An **extension** swings each leg about its ankle (support) or its hip (swing), in the plane of the leg; pelvis
//!   and foot keep their orientation.
//! * A **sidestep** swings them likewise, seen from ahead: the feet are further apart.
//!
//! The legs follow by inverse kinematics. For the paper's robot that gives the paper's offsets, to rounding.

use dynamics::{Kinematics, Tree, sin_cos};
use gait::{LegOffsets, NominalTable, Walk};
use model::{LegReach, Mechanism, Side};
use nalgebra::{Matrix3, Vector3};

use crate::footprint::SolePose;

/// Pelvis and swing sole of the modified half-step, in support coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ModifiedHalfStep {
    /// Maps pelvis to support coordinates.
    pub pelvis: Matrix3<f64>,
    /// Height of the pelvis link's origin in the nominal half-step (m).
    pub nominal_pelvis_height: f64,
    /// How far ahead of the support sole the swing sole is in the nominal half-step (m).
    pub nominal_swing_ahead: f64,
    /// The swing sole.
    pub swing_sole: SolePose,
}

/// The nominal half-step at a progress, with its legs as lines from hip to ankle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NominalLegs {
    /// The pelvis.
    pub pelvis: Placed,
    /// The swing foot.
    pub foot: Placed,
    /// The hips of support and swing leg in the pelvis link (m).
    pub hips_in_pelvis: [Vector3<f64>; 2],
    /// The ankles of support and swing leg in the foot links (m).
    pub ankles_in_foot: [Vector3<f64>; 2],
    /// The swing sole in its foot link (m).
    pub sole_in_foot: Vector3<f64>,
}

/// A link: rotation to support coordinates, and origin (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placed {
    rotation: Matrix3<f64>,
    origin: Vector3<f64>,
}

/// Axes of a leg, seen from ahead as a line.
#[derive(Clone, Copy, Debug)]
struct LegAxes {
    /// Along the line, upward.
    along: Vector3<f64>,
    /// Across it, to the left.
    across: Vector3<f64>,
}

impl ModifiedHalfStep {
    /// The half-step of a robot's walk at a progress.
    pub(crate) fn new(mechanism: &Mechanism, tree: &Tree, reach: &LegReach, walk: &Walk, progress: f64) -> Self {
        let turn = walk.turn().per_hip(progress).value;
        let ahead = walk.extension().per_hip(progress).value;
        let spread = walk.sidestep().per_hip(progress).value;
        let legs = NominalLegs::new(mechanism, tree, reach, walk.table(), progress);
        legs.modified(&LegOffsets { turn, reach: ahead, spread })
    }
}

impl NominalLegs {
    /// The legs of a nominal half-step at a progress.
    pub(crate) fn new(
        mechanism: &Mechanism,
        tree: &Tree,
        reach: &LegReach,
        table: &NominalTable,
        progress: f64,
    ) -> Self {
        let kinematics = Kinematics::fixed_base_up_to_left_foot(tree, &table.angles_at(progress));
        let [pelvis, foot] = [tree.pelvis(), tree.foot(Side::Left)]
            .map(|link| Placed { rotation: kinematics.rotation[link], origin: kinematics.origin[link] });
        Self {
            pelvis,
            foot,
            hips_in_pelvis: reach.hips_in_pelvis,
            ankles_in_foot: reach.ankles_in_foot,
            sole_in_foot: mechanism.sole_in_foot(Side::Left),
        }
    }

    /// What offsets of the legs make of it.
    pub(crate) fn modified(&self, &LegOffsets { turn, reach, spread }: &LegOffsets) -> ModifiedHalfStep {
        let Self { pelvis, foot, .. } = self;
        let [support_hip, swing_hip] = self.hips_in_pelvis;
        let [support_ankle, swing_ankle] = self.ankles_in_foot;

        // The support leg, from the ground up.
        let up = rotation(&Vector3::x(), -spread) * (pelvis.at(&support_hip) - support_ankle);
        let axes = LegAxes::of(&up);
        let hip = support_ankle + rotation(&axes.across, reach) * up;
        let rotated = rotation(&axes.along, turn) * pelvis.rotation;
        let moved = Placed { rotation: rotated, origin: hip - rotated * support_hip };

        // The swing leg, from the pelvis down.
        let to_pelvis = pelvis.rotation.transpose();
        let down = to_pelvis * (foot.at(&swing_ankle) - pelvis.origin) - swing_hip;
        let down = rotation(&Vector3::x(), spread) * down;
        let axes = LegAxes::of(&-down);
        let turned = rotation(&axes.along, turn);
        let ankle = moved.at(&(swing_hip + turned * (rotation(&axes.across, -reach) * down)));
        let sole = moved.rotation * turned * to_pelvis * foot.rotation;
        let origin = ankle + sole * (self.sole_in_foot - swing_ankle);

        ModifiedHalfStep {
            pelvis: moved.rotation,
            nominal_pelvis_height: pelvis.origin.z,
            nominal_swing_ahead: foot.at(&self.sole_in_foot).x,
            swing_sole: SolePose::new(origin, &sole.column(0).into_owned()),
        }
    }
}

impl Placed {
    /// A point of the link, in support coordinates (m).
    pub(crate) fn at(&self, in_link: &Vector3<f64>) -> Vector3<f64> {
        self.origin + self.rotation * in_link
    }
}

impl LegAxes {
    /// * `up` – from ankle to hip (m)
    fn of(up: &Vector3<f64>) -> Self {
        let along = Vector3::new(0.0, up.y, up.z).try_normalize(f64::EPSILON).unwrap_or_else(Vector3::z);
        Self { along, across: Vector3::new(0.0, along.z, -along.y) }
    }
}

/// The rotation by an angle (rad) about a unit vector. It calls no mathematical library of the system, which would
/// round differently elsewhere.
fn rotation(axis: &Vector3<f64>, angle: f64) -> Matrix3<f64> {
    let (sine, cosine) = sin_cos(angle);
    Matrix3::from_diagonal_element(cosine) + axis.cross_matrix() * sine + axis * axis.transpose() * (1.0 - cosine)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::Duration;

    use config::Config;
    use gait::{GaitParameters, Limits, RampKind, Start};
    use interface::Command;
    use nalgebra::{Isometry3, Translation3};

    use super::*;
    use crate::pattern_model::PatternModel;

    fn walk(mechanism: &Mechanism, command: Command) -> Walk {
        let table = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/nominal_half_step.csv");
        let table = NominalTable::read_csv(table.as_ref()).unwrap();
        let limits = Limits {
            turn_max: 0.6,
            speed_min: 0.5,
            speed_max: 1.5,
            extension_min: -0.2,
            extension_max: 0.2,
            sidestep_max: 0.3,
        };
        let gait = GaitParameters { ramp: RampKind::Quintic, speed_ramp: Duration::from_millis(600), limits };
        Walk::new(Arc::new(table), mechanism, &gait, Start { command, ..Start::default() }).unwrap()
    }

    /// The oracle: the paper's offsets of the joints, by forward kinematics; and inverse kinematics gives them back.
    /// The nominal is rounded to 1e-11 rad, so that its pelvis is not quite level.
    #[test]
    fn the_papers_robot_turns_and_reaches_by_the_papers_joint_offsets() {
        let mechanism = Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap();
        for (turn, extension, sidestep) in [
            (0.3, 0.0, 0.0),
            (0.0, 0.15, 0.0),
            (0.0, 0.0, 0.2),
            (0.5, -0.1, -0.1),
            (0.4, 0.2, 0.0),
            (-0.3, 0.1, 0.25),
            (0.2, 0.1, 0.25),
        ] {
            let mut walk = walk(&mechanism, Command { turn, speed: 1.0, extension, sidestep });
            let model = PatternModel::new(&mechanism, walk.mirror(), walk.table());
            for _ in 0..4 {
                for progress in [0.0, 0.2, 0.5, 0.77, 1.0] {
                    let angles = walk.angles_at(progress);
                    let kinematics = Kinematics::fixed_base_up_to_left_foot(&model.tree, &angles);
                    let found = model.modified(&walk, progress);
                    let sole = kinematics.sole_to_world(&mechanism, Side::Left);
                    let expected = SolePose::new(sole.translation.vector, &(sole.rotation * Vector3::x()));
                    let pelvis = kinematics.link_to_world(mechanism.pelvis());
                    let at = format!("{turn} {extension} {sidestep} at {progress}");
                    assert!((found.swing_sole.position - expected.position).norm() < 1e-11, "{at}");
                    assert!((found.swing_sole.yaw - expected.yaw).abs() < 1e-11, "{at}");
                    assert!((found.pelvis - kinematics.rotation[mechanism.pelvis()]).norm() < 1e-11, "{at}");

                    let foot = kinematics.link_to_world(mechanism.foot(Side::Left));
                    let mut solved = walk.table().angles_at(progress);
                    model.legs.solve(Side::Right, &pelvis, &Isometry3::identity(), &mut solved).unwrap();
                    model.legs.solve(Side::Left, &pelvis, &foot, &mut solved).unwrap();
                    assert!((solved - angles).max_abs() < 1e-9, "{at}: {}", (solved - angles).max_abs());
                }
                walk.advance(walk.table().duration);
            }
        }
    }

    #[test]
    fn without_modifications_the_half_step_is_the_nominal() {
        let mechanism = Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap();
        let walk = walk(&mechanism, Command::NOMINAL);
        let model = PatternModel::new(&mechanism, walk.mirror(), walk.table());
        for progress in [0.0, 0.3, 0.9] {
            let kinematics = Kinematics::fixed_base_up_to_left_foot(&model.tree, &walk.table().angles_at(progress));
            let sole = kinematics.link_to_world(mechanism.foot(Side::Left))
                * Translation3::from(mechanism.sole_in_foot(Side::Left));
            let found = model.modified(&walk, progress);
            assert!((found.swing_sole.position - sole.translation.vector).norm() < 1e-14);
        }
    }

    #[test]
    fn legs_that_are_aimed_land_where_they_are_to() {
        let mechanism = Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap();
        let mut walk = walk(&mechanism, Command::NOMINAL);
        let model = PatternModel::new(&mechanism, walk.mirror(), walk.table());
        let width = mechanism.foot_distance();
        for (x, y, yaw) in [(0.3, width, 0.0), (-0.2, width + 0.1, 0.0), (0.1, width + 0.05, 0.4), (0.0, width, 0.3)] {
            let asked = SolePose { position: Vector3::new(x, y, 0.0), yaw };
            walk.aim(&model.velocity.geometry().legs(&asked));
            let lands = model.modified(&walk, 1.0).swing_sole;
            let off = (lands.position - asked.position).xy().norm();
            assert!(off < 1e-6 && (lands.yaw - yaw).abs() < 1e-6, "{asked:?}: {lands:?}");
            walk.advance(walk.table().duration);
        }
    }
}
