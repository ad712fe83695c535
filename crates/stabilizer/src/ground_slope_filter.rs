//! The slope of the ground, from where and how the soles stand on it.
//!
//! One sole says little about a slope: it may stand on a stone or on the edge of a tile. How much higher the next sole
//! stands says more, and several say it for sure. A Kalman filter takes once what each footprint says: the lean of the
//! vertical over the sole, and its height over the footprint before. The noise is the unevenness of the ground, not
//! that of the sensors, and from footprint to footprint the slope may change.

use dynamics::Kinematics;
use model::{Mechanism, Side};
use nalgebra::{Matrix2, Rotation3, Vector2, Vector3};

use crate::proportions::StabilizerProportions;
use crate::support_frame_measurement::SupportFrameMeasurement;

/// Standard deviation of the slope before anything is known (-).
const UNKNOWN: f64 = 0.1;
/// Standard deviation of the change of the slope from footprint to footprint (-): a ramp is believed after two steps.
const CHANGE_PER_FOOTPRINT: f64 = 0.035;

/// Lean of the vertical over a sole by the yielding of soles and drives (-).
const LEAN_OF_YIELDING: f64 = 0.01;

/// The filter. Everything is in support coordinates: x along the support foot, y to its left.
#[derive(Clone, Debug)]
pub struct GroundSlopeFilter {
    /// What the footprints before the present one say.
    before: SlopeEstimate,
    /// Lean of the vertical over the support sole while it bears alone (-).
    lean: MeanLean,
    /// Where the other sole stands, from the support sole (m).
    other_sole: Option<Vector3<f64>>,
    /// Whether the height of the support sole over the footprint before has been absorbed.
    has_height: bool,
    /// Variance of a lean by the unevenness of the ground (-).
    lean_variance: Matrix2<f64>,
    /// Variance of the height between two footprints by the unevenness of the ground (m²).
    height_variance: f64,
}

/// Lean of the vertical over the ground: x and y of the unit vector (-), and its covariance.
#[derive(Clone, Copy, Debug)]
struct SlopeEstimate {
    lean: Vector2<f64>,
    covariance: Matrix2<f64>,
}

/// The mean of samples.
#[derive(Clone, Copy, Debug, Default)]
struct MeanLean {
    sum: Vector2<f64>,
    number: f64,
}

impl GroundSlopeFilter {
    /// A filter that knows nothing of the ground.
    pub fn new(mechanism: &Mechanism) -> Self {
        let proportions = StabilizerProportions::of(mechanism);
        let height_variance = 2.0 * proportions.unevenness.powi(2);
        // Two ends of a sole stand at heights as different as two footprints.
        let lean = proportions.sole_half_size.map(|half| height_variance / (4.0 * half * half));
        Self {
            before: SlopeEstimate {
                lean: Vector2::zeros(),
                covariance: Matrix2::from_diagonal_element(UNKNOWN * UNKNOWN),
            },
            lean: MeanLean::default(),
            other_sole: None,
            has_height: false,
            lean_variance: Matrix2::from_diagonal(&lean),
            height_variance,
        }
    }

    /// Absorbs a measurement.
    ///
    /// * `kinematics` – of the measured joint angles
    /// * `is_flat` – whether the support sole lies flat on the ground
    /// * `bears` – whether the support and the swing foot bear
    pub fn update(
        &mut self,
        mechanism: &Mechanism,
        measurement: &SupportFrameMeasurement,
        kinematics: &Kinematics,
        is_flat: bool,
        bears: [bool; 2],
    ) {
        let up = measurement.up_over_sole(kinematics);
        if bears == [true, false] && is_flat {
            self.lean.absorb(up.xy());
        }
        if bears == [true, true] {
            // Before the support sole bears alone, the other one is the footprint before, and soon lifts off. After
            // that it lands, and settles.
            let lands = self.lean.value().is_some();
            if lands || !(self.has_height || self.other_sole.is_some()) {
                let levelling = Rotation3::rotation_between(&up, &Vector3::z()).unwrap_or_default();
                self.other_sole = Some(levelling * kinematics.sole_to_world(mechanism, Side::Left).translation.vector);
            }
        }
    }

    /// Expresses everything in support coordinates of the other foot, which supports from now on.
    ///
    /// * `heading` – of the new support foot against the former one: a unit vector in its coordinates
    pub fn change_support(&mut self, heading: Vector2<f64>) {
        let SlopeEstimate { lean, covariance } = self.estimate();
        let aside = Vector2::new(-heading.y, heading.x);
        let turn = Matrix2::from_rows(&[heading.transpose(), -aside.transpose()]);
        let change = Matrix2::from_diagonal_element(CHANGE_PER_FOOTPRINT * CHANGE_PER_FOOTPRINT);
        self.before = SlopeEstimate { lean: turn * lean, covariance: turn * covariance * turn.transpose() + change };
        self.has_height = self.other_sole.take().is_some();
        self.lean = MeanLean::default();
    }

    /// A sensor was found to be wrong: forgets what it said of the present footprint.
    pub fn distrust(&mut self) {
        (self.lean, self.other_sole) = (MeanLean::default(), None);
    }

    /// Lean of the vertical over the ground: x and y of the unit vector in axes of the ground (-).
    ///
    /// Of a slope no steeper than what soles and drives yield by, little is believed.
    pub fn vertical(&self) -> Vector2<f64> {
        let lean = self.estimate().lean;
        let square = lean.norm_squared();
        lean * (square / (square + LEAN_OF_YIELDING * LEAN_OF_YIELDING))
    }

    /// What all footprints say, the present one included.
    fn estimate(&self) -> SlopeEstimate {
        let mut estimate = self.before;
        if let Some(lean) = self.lean.value() {
            estimate.absorb_lean(lean, &self.lean_variance);
        }
        if let Some(sole) = &self.other_sole {
            estimate.absorb_height(sole, self.height_variance);
        }
        estimate
    }
}

impl MeanLean {
    fn absorb(&mut self, value: Vector2<f64>) {
        self.sum += value;
        self.number += 1.0;
    }

    fn value(&self) -> Option<Vector2<f64>> {
        (self.number > 0.0).then(|| self.sum / self.number)
    }
}

impl SlopeEstimate {
    /// Absorbs the lean of the vertical over a sole.
    fn absorb_lean(&mut self, lean: Vector2<f64>, variance: &Matrix2<f64>) {
        // Both are positive definite.
        let Some(inverse) = (self.covariance + variance).try_inverse() else { return };
        let gain = self.covariance * inverse;
        self.lean += gain * (lean - self.lean);
        self.covariance -= gain * self.covariance;
    }

    /// Absorbs where another sole stands (m): uphill it is higher, and the vertical leans uphill.
    fn absorb_height(&mut self, sole: &Vector3<f64>, variance: f64) {
        let spread = self.covariance * sole.xy();
        let gain = spread / (sole.xy().dot(&spread) + variance);
        self.lean += gain * (sole.z - sole.xy().dot(&self.lean));
        self.covariance -= gain * spread.transpose();
    }
}

#[cfg(test)]
mod tests {
    use config::Config;
    use dynamics::Tree;
    use model::{Joint, JointVector, Wrench};
    use nalgebra::Rotation2;

    use super::*;

    /// A robot that walks on the spot or ahead, one foot after the other.
    struct Walker {
        mechanism: Mechanism,
        tree: Tree,
        filter: GroundSlopeFilter,
    }

    impl Walker {
        fn new() -> Self {
            let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml");
            let mechanism = Mechanism::load(file).unwrap();
            Self { tree: Tree::new(&mechanism), filter: GroundSlopeFilter::new(&mechanism), mechanism }
        }

        /// A footprint, the next one, and the change of support.
        ///
        /// * `lean` – of the vertical over the support sole (-)
        /// * `angles` – that place the other sole
        /// * `turn` – of the new support foot against the former one (rad)
        fn step(&mut self, lean: Vector2<f64>, angles: &JointVector, turn: f64) {
            let kinematics = Kinematics::fixed_base(&self.tree, angles);
            let up = lean.push((1.0 - lean.norm_squared()).sqrt());
            let measurement = SupportFrameMeasurement {
                angles: *angles,
                rates: JointVector::ZERO,
                support_foot: Wrench::ZERO,
                swing_foot: Wrench::ZERO,
                up_in_trunk: kinematics.rotation[Mechanism::TRUNK].tr_mul(&up),
                trunk_rate: None,
                specific_force: None,
            };
            for bears in [[true, false], [true, true]] {
                self.filter.update(&self.mechanism, &measurement, &kinematics, true, bears);
            }
            self.filter.change_support(Vector2::new(turn.cos(), turn.sin()));
        }
    }

    /// The left foot ahead, both soles in one plane (rad).
    fn stride() -> JointVector {
        let mut angles = JointVector::ZERO;
        (angles[Joint::RightAnklePitch], angles[Joint::RightHipPitch]) = (0.15, -0.15);
        (angles[Joint::LeftHipPitch], angles[Joint::LeftAnklePitch]) = (-0.15, 0.15);
        angles
    }

    /// As seen from the other foot: mirrored and turned.
    fn seen_from_other_foot(lean: Vector2<f64>, turn: f64) -> Vector2<f64> {
        let seen = Rotation2::new(-turn) * lean;
        Vector2::new(seen.x, -seen.y)
    }

    /// The oracle: geometry. Both soles lie in one plane, whatever the vertical over it; the walk turns as it goes.
    #[test]
    fn slope_of_a_plane_is_found_within_three_footprints() {
        for (x, y) in [(0.14, 0.0), (-0.1, 0.05), (0.0, -0.12)] {
            let mut walker = Walker::new();
            let mut lean = Vector2::new(x, y);
            for _ in 0..3 {
                walker.step(lean, &stride(), 0.2);
                lean = seen_from_other_foot(lean, 0.2);
            }
            let error = walker.filter.vertical() - lean;
            assert!(error.norm() < 0.12 * lean.norm(), "{} instead of {lean}", walker.filter.vertical());
        }
    }

    /// The vertical leans over each sole by another stone, but the footprints lie at one height.
    #[test]
    fn soles_on_stones_are_no_slope() {
        let mut walker = Walker::new();
        for step in 0..12 {
            let tilt = 0.08 * f64::from(step % 3 - 1);
            let mut angles = stride();
            // The ankle rolls with the stone, and the leg above it stays upright.
            angles[Joint::RightAnkleRoll] = -tilt * walker.mechanism.links[Joint::RightAnkleRoll].axis.x;
            walker.step(Vector2::new(0.0, tilt), &angles, 0.0);
            assert!(walker.filter.vertical().norm() < 0.04, "{}", walker.filter.vertical());
        }
    }

    #[test]
    fn without_a_footprint_the_ground_is_level() {
        let mut walker = Walker::new();
        assert_eq!(walker.filter.vertical(), Vector2::zeros());
        walker.filter.change_support(Vector2::x());
        assert_eq!(walker.filter.vertical(), Vector2::zeros());
    }

    /// What a footprint says counts once, however long the robot stands on it.
    #[test]
    fn a_long_stance_says_no_more_than_a_short_one() {
        let vertical = |samples: u32| {
            let mut walker = Walker::new();
            let kinematics = Kinematics::fixed_base(&walker.tree, &JointVector::ZERO);
            let up = Vector3::new(0.1, 0.0, 0.99_f64.sqrt());
            let measurement = SupportFrameMeasurement {
                angles: JointVector::ZERO,
                rates: JointVector::ZERO,
                support_foot: Wrench::ZERO,
                swing_foot: Wrench::ZERO,
                up_in_trunk: up,
                trunk_rate: None,
                specific_force: None,
            };
            for _ in 0..samples {
                walker.filter.update(&walker.mechanism, &measurement, &kinematics, true, [true, false]);
            }
            walker.filter.vertical()
        };
        assert!((vertical(1) - vertical(1000)).norm() < 1e-9);
        assert!((0.05..0.1).contains(&vertical(1).x), "{}", vertical(1));
    }
}
