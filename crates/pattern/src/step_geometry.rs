//! Step lengths: where a leg swung at hip and ankle by an angle puts the foot, in metres, and back.
//!
//! The legs of the nominal half-step are taken at its end, as lines from hip to ankle; see `modified_half_step`.

use dynamics::{Tree, sin_cos};
use gait::{LegOffsets, NominalTable};
use model::{LegReach, Mechanism};
use nalgebra::{Matrix2, Vector2};

use crate::footprint::SolePose;
use crate::modified_half_step::NominalLegs;
use crate::sole_spacing::SoleSpacing;

/// The legs at the end of the nominal half-step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StepGeometry {
    legs: NominalLegs,
    spacing: SoleSpacing,
    /// From hip to ankle of the support leg upward and of the swing leg downward: along x, summed (m).
    ahead: f64,
    /// The same across x, each from the ankle to the hip's height (m).
    height: f64,
    /// Step length less what the legs contribute (m).
    rest: f64,
    /// Distance of the soles, middle to middle, without a sidestep (m).
    pub width: f64,
}

/// Rounds of Newton's method: the error of a step of half a leg's length falls below a nanometre.
const ROUNDS: usize = 5;
/// Rounds in which the legs are aimed: each leaves a tenth of the error or less.
const ROUNDS_TO_AIM: usize = 8;
/// Largest angle by which either leg is swung (rad): far more than any leg can.
const SWING_MAX: f64 = 1.0;

impl StepGeometry {
    /// The geometry of a robot with its nominal half-step.
    pub(crate) fn new(mechanism: &Mechanism, table: &NominalTable) -> Self {
        let legs = NominalLegs::new(mechanism, &Tree::new(mechanism), &LegReach::of(mechanism), table, 1.0);
        let [support_hip, swing_hip] = legs.hips_in_pelvis.map(|hip| legs.pelvis.at(&hip));
        let (up, down) = (support_hip - legs.ankles_in_foot[0], legs.foot.at(&legs.ankles_in_foot[1]) - swing_hip);
        let ahead = up.x + down.x;
        Self {
            ahead,
            height: up.yz().norm() + down.yz().norm(),
            rest: legs.foot.at(&legs.sole_in_foot).x - ahead,
            width: mechanism.foot_distance(),
            legs,
            spacing: SoleSpacing::of(mechanism),
        }
    }

    /// How far ahead of the support sole the swing sole lands (m).
    ///
    /// * `reach` – by which either leg swings ahead (rad)
    pub(crate) fn step(&self, reach: f64) -> f64 {
        let (sine, cosine) = sin_cos(reach);
        self.rest + self.ahead * cosine + self.height * sine
    }

    /// The swing ahead of either leg (rad) for a step (m); the largest possible one if the legs are too short.
    pub(crate) fn reach(&self, step: f64) -> f64 {
        let mut reach = 0.0;
        for _ in 0..ROUNDS {
            let (sine, cosine) = sin_cos(reach);
            let slope = self.height * cosine - self.ahead * sine;
            reach = (reach + (step - self.step(reach)) / slope).clamp(-SWING_MAX, SWING_MAX);
        }
        reach
    }

    /// How much further apart than without a sidestep the soles land (m).
    ///
    /// * `spread` – by which either leg swings away from the other one (rad)
    /// * `reach` – by which either leg swings ahead (rad)
    pub(crate) fn aside(&self, spread: f64, reach: f64) -> f64 {
        self.height_at(reach) * sin_cos(spread).0
    }

    /// The swing aside of either leg (rad) for soles that land further apart (m). It calls no mathematical library of
    /// the system, which would round differently elsewhere.
    pub(crate) fn spread(&self, aside: f64, reach: f64) -> f64 {
        let sine = (aside / self.height_at(reach)).clamp(-0.8, 0.8);
        let mut spread = sine;
        for _ in 0..ROUNDS {
            let (at, slope) = sin_cos(spread);
            spread += (sine - at) / slope;
        }
        spread
    }

    /// Where the swing sole lands, in support coordinates: where the legs put it, or further out if that is too near to
    /// the other one.
    pub(crate) fn landing(&self, offsets: &LegOffsets) -> SolePose {
        self.spacing.kept(&self.put(offsets))
    }

    /// How much further out than the legs put it the swing sole lands (m).
    pub(crate) fn further_out(&self, offsets: &LegOffsets) -> f64 {
        self.spacing.lacking(&self.put(offsets))
    }

    /// Where soles may land beside each other.
    pub(crate) fn spacing(&self) -> &SoleSpacing {
        &self.spacing
    }

    /// Where the legs put the swing sole.
    fn put(&self, offsets: &LegOffsets) -> SolePose {
        self.legs.modified(offsets).swing_sole
    }

    /// The offsets of the legs with which the swing sole lands at a place, in support coordinates. A place out of
    /// reach is approached as far as the legs swing.
    pub(crate) fn legs(&self, landing: &SolePose) -> LegOffsets {
        // In the frame between the headings of both feet. Without a turn, reach and spread are exact there.
        let between = |sole: &SolePose, turn: f64| {
            let (sine, cosine) = sin_cos(-turn);
            Matrix2::new(cosine, -sine, sine, cosine) * sole.position.xy()
        };
        let turn_to = 0.5 * landing.yaw;
        let asked = between(landing, turn_to);
        let (mut turn, mut aim) = (turn_to, asked);
        let offsets = |turn: f64, aim: Vector2<f64>| {
            let reach = self.reach(aim.x);
            LegOffsets { turn, reach, spread: self.spread(aim.y - self.width, reach) }
        };
        for _ in 0..ROUNDS_TO_AIM {
            let lands = self.put(&offsets(turn, aim));
            turn += turn_to - 0.5 * lands.yaw;
            aim += asked - between(&lands, turn_to);
        }
        offsets(turn, aim)
    }

    /// Heights of both hips over their ankles, summed, with the legs swung ahead (m).
    fn height_at(&self, reach: f64) -> f64 {
        let (sine, cosine) = sin_cos(reach);
        self.height * cosine - self.ahead * sine
    }
}
