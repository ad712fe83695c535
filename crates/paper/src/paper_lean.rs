//! The compensator of the paper: a constant lean of ankle or trunk for the whole half-step.
//!
//! The lean is given in degrees by the paper, or computed: the least lean that maximises the least margin of the
//! half-step. It flips its side at every support change, which a real body cannot follow; as in the paper, it holds
//! from the very start of the half-step to its end.

use dynamics::Tree;
use model::{Joint, JointVector, Motion, Sole};
use nalgebra::{Matrix2, Vector2};

use crate::{ZmpExtents, zmp_by_newton_euler};

/// The two joints that lean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeanAt {
    /// The support ankle: joints 3 and 4.
    Ankle,
    /// The waist: joints 15 and 16.
    Trunk,
}

impl LeanAt {
    /// The two joints, in the order of the paper.
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
    /// The joints that lean.
    pub at: LeanAt,
    /// Angles added to the two joints of [`LeanAt::joints`] (rad).
    pub angles: Vector2<f64>,
}

impl PaperLean {
    /// No lean.
    pub fn none(at: LeanAt) -> Self {
        Self { at, angles: Vector2::zeros() }
    }

    /// Angles added to all joints (rad).
    pub fn offsets(&self) -> JointVector {
        let mut offsets = JointVector::ZERO;
        for (joint, angle) in self.at.joints().into_iter().zip(self.angles.iter()) {
            offsets[joint] = *angle;
        }
        offsets
    }

    /// A motion with the lean added, which is constant and has no rate.
    pub fn lean(&self, motion: &Motion) -> Motion {
        Motion { angles: motion.angles + self.offsets(), ..*motion }
    }

    /// The least lean that maximises the least margin of a motion.
    ///
    /// The ZMP is nearly linear in the lean: each round linearises it about the best lean so far, and maximises the
    /// margin, a concave function of two angles, by golden sections. The same inputs give the same bits.
    ///
    /// * `motions` – all instants that one lean must serve: a half-step or several, at the speed at which they are
    ///   played
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

    /// Extents of the ZMP path of `motions` with this lean.
    pub fn extents(&self, tree: &Tree, sole: &Sole, motions: &[Motion]) -> ZmpExtents {
        let leaning: Vec<Motion> = motions.iter().map(|motion| self.lean(motion)).collect();
        ZmpExtents::of_path(zmp_by_newton_euler(tree, &leaning), sole)
    }
}

/// Rounds of linearisation at most; four are usual.
const ROUNDS_MAX: usize = 12;
/// Change of the lean at which it counts as settled (rad).
const SETTLED: f64 = 1e-7;
/// Largest change of either angle in a round (rad).
const STEP_MAX: f64 = 0.4;
/// Cost of a lean in margin (m/rad²): among leans of equal margin the least is chosen, and less than 0.1 mm of margin
/// is lost at 15°.
const COST: f64 = 1e-3;
/// Golden sections of the step, which narrow it to 1e-8 rad.
const SECTIONS: usize = 38;
/// Half of the span of a central difference (rad).
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

/// The best second angle with the `first`, and the objective with both.
fn best_second(about: Vector2<f64>, first: f64, objective: &impl Fn(Vector2<f64>) -> f64) -> (f64, f64) {
    maximum(about.y, |second| objective(Vector2::new(first, second)))
}

/// Argument and value of the maximum of a concave function within a step of `about`.
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
