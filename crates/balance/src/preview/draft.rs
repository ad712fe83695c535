//! A draft: what the loop itself changes about the plan, a stop or a step after a push, is played ahead over several ticks,
//! so that none of them takes long, and takes over at a coming knot.

use nalgebra::Vector2;

use crate::preview::{Biped, Footwork, Foresight, Goal, KNOT};

/// A change of plan in the making.
#[derive(Clone, Debug)]
pub struct Draft {
    change: Change,
    /// Knots until it takes over; 0 when nothing is in the making.
    knots_left: u32,
    /// Where it takes over.
    footwork: Footwork,
    foresight: Foresight,
}

/// What is to be different.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Change {
    /// What the walk is to come to.
    pub goal: Option<Goal>,
    /// How far off its place the swinging foot is to land, in support coordinates [m].
    pub shift: Option<Vector2<f64>>,
}

impl Change {
    /// Makes it; says whether anything is different.
    pub fn apply(&self, footwork: &mut Footwork) -> bool {
        let before = footwork.course.gate;
        if let Some(goal) = self.goal {
            footwork.course.aim(goal);
        }
        let shifts = self.shift.is_some_and(|shift| footwork.shift_landing(shift));
        shifts || footwork.course.gate != before
    }
}

impl Draft {
    /// Nothing in the making.
    pub fn none(footwork: &Footwork, foresight: &Foresight) -> Self {
        Self { change: Change::default(), knots_left: 0, footwork: footwork.clone(), foresight: foresight.clone() }
    }

    /// Begins with a change besides what is in the making already; says whether there is anything to do.
    ///
    /// * `elapsed` – since the present knot [s]
    pub fn begin(
        &mut self,
        biped: &Biped,
        footwork: &Footwork,
        foresight: &Foresight,
        change: Change,
        elapsed: f64,
    ) -> bool {
        self.change = Change { goal: change.goal.or(self.change.goal), shift: change.shift.or(self.change.shift) };
        self.footwork.clone_from(footwork);
        self.foresight.clone_from(foresight);
        // Half a knot is enough to play all of it ahead.
        let knots = if elapsed > KNOT / 2.0 { 2 } else { 1 };
        for _ in 0..knots {
            if self.footwork.advance(biped) {
                // The foot has landed meanwhile.
                self.change.shift = None;
            }
            self.foresight.advance();
        }
        if !self.change.apply(&mut self.footwork) {
            self.take();
            return false;
        }
        self.foresight.restart(biped, &self.footwork);
        self.knots_left = knots;
        true
    }

    /// Plays a part of it ahead: after `dt` [s] of the time until it takes over, `elapsed` after the present knot.
    pub fn work(&mut self, biped: &Biped, elapsed: f64, dt: f64) {
        if self.knots_left == 0 {
            return;
        }
        let until = f64::from(self.knots_left) * KNOT - (elapsed - dt);
        let missing = self.foresight.missing();
        let share = (missing as f64 * dt / until).ceil() as usize;
        for _ in 0..share.min(missing) {
            self.foresight.extend(biped);
        }
    }

    /// A knot has passed: gives what is to take over now, if something is.
    pub fn due(&mut self, biped: &Biped) -> Option<(&Footwork, &Foresight)> {
        self.knots_left = self.knots_left.checked_sub(1)?;
        if self.knots_left > 0 {
            return None;
        }
        self.change = Change::default();
        self.foresight.complete(biped);
        Some((&self.footwork, &self.foresight))
    }

    /// What it is to change.
    pub fn change(&self) -> Change {
        self.change
    }

    /// Something else is aimed at.
    pub fn forget_goal(&mut self) {
        self.change.goal = None;
    }

    /// Ends it and gives what it was to change.
    pub fn take(&mut self) -> Change {
        self.knots_left = 0;
        std::mem::take(&mut self.change)
    }
}
