//! What the coming knots want of the ZMP: the walk played ahead of itself.

use dynamics::{Kinematics, Tree};
use gait::Walk;
use model::Mechanism;
use nalgebra::Vector2;

use crate::preview::{CartTable, Footprint, Gate, NominalSway, SolePose};

/// Where the pendulum's ZMP is wanted in the coming knots: under the foot that will bear, less what the pendulum leaves out.
/// Played anew when a request changes what is to come; else one knot is added as one is used.
#[derive(Clone, Debug)]
pub struct Outlook {
    sway: NominalSway,
    /// In the walk frame [m]; the oldest at `next`.
    wanted: Vec<Vector2<f64>>,
    next: usize,
    /// The walk at the last of them.
    scout: Walk,
    feet: Feet,
    gate: Gate,
}

/// Where the feet are in a half-step.
#[derive(Clone, Copy, Debug)]
pub struct Feet {
    /// The bearing one.
    pub footprint: Footprint,
    /// Where the other one stands before it swings, in support coordinates.
    pub standing: SolePose,
    /// Where it lands.
    pub landing: SolePose,
}

impl Feet {
    /// The feet of the next half-step, whose swing the walk tells.
    pub fn next(&self, swing: impl FnOnce(&SolePose) -> SolePose) -> Self {
        let standing = self.landing.seen_from_landed();
        Self { footprint: self.footprint.next(&self.landing), standing, landing: swing(&standing) }
    }
}

impl Outlook {
    /// Looks `knots` ahead of a walk.
    pub fn new(
        sway: NominalSway,
        tree: &Tree,
        mechanism: &Mechanism,
        walk: &Walk,
        feet: &Feet,
        gate: Gate,
        knots: usize,
    ) -> Self {
        let wanted = vec![Vector2::zeros(); knots];
        let mut outlook = Self { sway, wanted, next: 0, scout: walk.clone(), feet: *feet, gate };
        outlook.begin(tree, mechanism, walk, feet, gate);
        outlook
    }

    /// Looks ahead anew from where the walk is.
    pub fn begin(&mut self, tree: &Tree, mechanism: &Mechanism, walk: &Walk, feet: &Feet, gate: Gate) {
        self.scout.clone_from(walk);
        self.feet = *feet;
        self.gate = gate;
        for _ in 0..self.wanted.len() {
            self.advance(tree, mechanism);
        }
    }

    /// One knot is past: one more comes into sight.
    pub fn advance(&mut self, tree: &Tree, mechanism: &Mechanism) {
        if self.gate.advance(&mut self.scout) {
            self.feet = self.feet.next(|_| swinging_sole(tree, mechanism, &self.scout, 1.0));
        }
        let wanted = if self.gate.is_standing() {
            self.feet.standing.position.xy() * (1.0 - self.gate.weight_on_bearing())
        } else {
            let speed = self.scout.speed().state().value;
            -self.sway.beyond_pendulum(self.scout.half_step().progress, speed)
        };
        self.wanted[self.next] = self.feet.footprint.point_to_walk(wanted);
        self.next = (self.next + 1) % self.wanted.len();
    }

    /// The sum of what is wanted, each knot times its gain, along both axes of the walk frame.
    pub fn weighed(&self, cart: &CartTable) -> Vector2<f64> {
        let (later, sooner) = self.wanted.split_at(self.next);
        sooner.iter().chain(later).enumerate().map(|(ahead, wanted)| wanted * cart.gain(ahead)).sum()
    }
}

/// The swinging sole of the modified half-step at a progress.
pub fn swinging_sole(tree: &Tree, mechanism: &Mechanism, walk: &Walk, progress: f64) -> SolePose {
    SolePose::swinging(mechanism, &Kinematics::standing(tree, &walk.motion_at(progress).angles))
}
