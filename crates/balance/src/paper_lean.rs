//! The paper's compensator (DESIGN §5.2): a constant lean of ankle or trunk for the whole half-step.
//!
//! The lean is given in degrees by the paper, or computed: the least lean that maximises the least margin of the
//! half-step. It flips its side at every swap, which a real body cannot follow; as the paper does, it counts as there from
//! the start of the half-step to its end.

use dynamics::Tree;
use model::{Joint, JointVector, Motion, Sole};
use nalgebra::{Matrix2, Vector2};

use crate::{ZmpExtents, zmp_by_newton_euler};

/// Which two joints lean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeanAt {
    /// The bearing ankle: joints 3 and 4.
    Ankle,
    /// The waist: joints 15 and 16.
    Trunk,
}

impl LeanAt {
    /// The two joints, in the paper's order.
    pub const fn joints(self) -> [Joint; 2] {
        match self {
            LeanAt::Ankle => [Joint::RightAnkleRoll, Joint::RightAnklePitch],
            LeanAt::Trunk => [Joint::WaistPitch, Joint::WaistRoll],
        }
    }
}

/// A constant lean, in support coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperLean {
    /// Which joints.
    pub at: LeanAt,
    /// What is added to each of [`LeanAt::joints`] [rad].
    pub angles: Vector2<f64>,
}

impl PaperLean {
    /// No lean.
    pub fn none(at: LeanAt) -> Self {
        Self { at, angles: Vector2::zeros() }
    }

    /// What is added to the angles of all joints [rad].
    pub fn offsets(&self) -> JointVector {
        let mut offsets = JointVector::ZERO;
        for (joint, angle) in self.at.joints().into_iter().zip(self.angles.iter()) {
            offsets[joint] = *angle;
        }
        offsets
    }

    /// A motion with the lean added; being constant it has no rate.
    pub fn lean(&self, motion: &Motion) -> Motion {
        Motion { angles: motion.angles + self.offsets(), ..*motion }
    }

    /// The least lean that maximises the least margin of `motions`, which hold all instants that must be served with it:
    /// a half-step or several, at the speed that they are played at.
    ///
    /// The ZMP is nearly linear in the lean: in each round it is linearised about the best lean so far, for which the
    /// margin, a concave function of two angles, is maximised by golden sections. Same inputs, same bits.
    pub fn best(tree: &Tree, sole: &Sole, at: LeanAt, motions: &[Motion]) -> Self {
        let mut best = Self::none(at);
        for _ in 0..ROUNDS_MAX {
            let before = best.angles;
            let slopes = ZmpSlopes::around(tree, &best, motions);
            let objective = |angles: Vector2<f64>| slopes.margin(sole, angles) - COST * angles.norm_squared();
            let (first, _) = maximum(before.x, |x| best_second(before, x, &objective).1);
            best.angles = Vector2::new(first, best_second(before, first, &objective).0);
            if (best.angles - before).amax() < SETTLED {
                break;
            }
        }
        best
    }

    /// What the ZMP path of `motions` covers under this lean.
    pub fn extents(&self, tree: &Tree, sole: &Sole, motions: &[Motion]) -> ZmpExtents {
        let leaning: Vec<Motion> = motions.iter().map(|motion| self.lean(motion)).collect();
        ZmpExtents::of_path(zmp_by_newton_euler(tree, &leaning), sole)
    }
}

/// Rounds of linearisation; four are usual.
const ROUNDS_MAX: usize = 12;
/// Change of the lean at which it counts as settled [rad].
const SETTLED: f64 = 1e-7;
/// Largest change of either angle in a round [rad].
const STEP_MAX: f64 = 0.4;
/// What a lean costs in margin [m/rad²]: decides between leans that serve alike, for the least, and gives away less than
/// 0.1 mm of margin at 15°.
const COST: f64 = 1e-3;
/// Golden sections of the step: narrows it to 1e-8 rad.
const SECTIONS: usize = 38;
/// Half of the span of central differences [rad].
const DIFFERENCE: f64 = 1e-4;

/// The ZMP of each instant as a linear function of the two angles.
struct ZmpSlopes {
    about: Vector2<f64>,
    instants: Vec<(Vector2<f64>, Matrix2<f64>)>,
}

impl ZmpSlopes {
    fn around(tree: &Tree, lean: &PaperLean, motions: &[Motion]) -> Self {
        let path = |change: Vector2<f64>| -> Vec<Vector2<f64>> {
            let changed = PaperLean { angles: lean.angles + change, ..*lean };
            let leaning: Vec<Motion> = motions.iter().map(|motion| changed.lean(motion)).collect();
            zmp_by_newton_euler(tree, &leaning).collect()
        };
        let here = path(Vector2::zeros());
        let slopes = [Vector2::x(), Vector2::y()].map(|direction| {
            let (after, before) = (path(direction * DIFFERENCE), path(direction * -DIFFERENCE));
            let slope = |(after, before): (&Vector2<f64>, &Vector2<f64>)| (after - before) / (2.0 * DIFFERENCE);
            after.iter().zip(&before).map(slope).collect::<Vec<_>>()
        });
        let slopes = slopes[0].iter().zip(&slopes[1]).map(|(first, second)| Matrix2::from_columns(&[*first, *second]));
        Self { about: lean.angles, instants: here.into_iter().zip(slopes).collect() }
    }

    fn margin(&self, sole: &Sole, angles: Vector2<f64>) -> f64 {
        let change = angles - self.about;
        let margin = |(point, slope): &(Vector2<f64>, Matrix2<f64>)| {
            let point = point + slope * change;
            sole.margin(point.x, point.y)
        };
        self.instants.iter().map(margin).fold(f64::INFINITY, f64::min)
    }
}

/// The second angle that is best with the `first`, and what the objective is then.
fn best_second(about: Vector2<f64>, first: f64, objective: &impl Fn(Vector2<f64>) -> f64) -> (f64, f64) {
    maximum(about.y, |second| objective(Vector2::new(first, second)))
}

/// Where a concave function is greatest within a step of `about`, and how great.
fn maximum(about: f64, value: impl Fn(f64) -> f64) -> (f64, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut low, mut high) = (about - STEP_MAX, about + STEP_MAX);
    let inner = |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut points = inner(low, high);
    let mut values = points.map(&value);
    for _ in 0..SECTIONS {
        if values[0] < values[1] {
            low = points[0];
            points = [points[1], inner(low, high)[1]];
            values = [values[1], value(points[1])];
        } else {
            high = points[1];
            points = [inner(low, high)[0], points[0]];
            values = [value(points[0]), values[0]];
        }
    }
    let middle = 0.5 * (low + high);
    (middle, value(middle))
}
