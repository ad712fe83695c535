//! The dynamics filter (second preview of Kajita et al. 2003): plays the whole body ahead along the centre of mass of
//! the cart-table model, and corrects it by the ZMP that the whole body would miss.

use dynamics::{Batch, LANES, NewtonEuler, zmp};
use model::{JointVector, Motion, Wrench};
use nalgebra::Vector2;

use crate::foot_trajectory::FootTrajectory;
use crate::footprint::Footprint;
use crate::footstep_plan::FootstepPlan;
use crate::knot::KNOT;
use crate::pattern_model::{KNOTS_FILTERED, PatternModel};
use crate::preview_controller::CartState;
use crate::whole_body_ik::{WholeBodyIk, WholeBodyTask};
use crate::zmp_reference::ZmpReference;

/// The coming knots by the cart-table model alone. Computed anew when the footsteps change; else one knot is added as
/// one is used.
#[derive(Clone, Debug)]
pub(crate) struct DynamicsFilter {
    /// The feet at the farthest knot.
    foot_trajectory: FootTrajectory,
    zmp_reference: ZmpReference,
    body: WholeBodyIk,
    inverse: NewtonEuler,
    batch: Batch,
    /// A ring of the previous knot, the present one and the coming ones.
    knots: [FilterKnot; KNOTS_FILTERED + 2],
    /// ZMP of the whole body less that of the cart-table model and the expected residual, at each of these knots, in
    /// the walk frame (m).
    unexpected: [Vector2<f64>; KNOTS_FILTERED + 2],
    /// The largest of these that is corrected (m).
    unexpected_max: f64,
    /// Slot of the present knot in the ring.
    present: usize,
    /// How many knots after the present one are computed.
    ahead: usize,
    /// The preview input of the correction, along both axes of the walk frame.
    correction_input: Vector2<f64>,
    /// What is computed next of the farthest knot.
    stage: Stage,
}

/// A knot is computed in stages, so that no tick computes all of it.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// Centre of mass of the cart-table model, and footsteps.
    CentreOfMass,
    /// Task of the whole body; with the support foot of the knot before.
    Task(Footprint),
    /// Joint angles that fulfil it.
    Posture(Footprint),
    /// ZMP of the knot before, which only now has a neighbour on either side.
    Zmp(Footprint),
    /// Preview input of the correction.
    Correction,
}

/// One coming knot.
#[derive(Clone, Copy, Debug)]
struct FilterKnot {
    /// Centre of mass of the cart-table model, along x and y of the walk frame.
    com: [CartState; 2],
    /// Task of the whole body, with this centre of mass.
    task: WholeBodyTask,
    /// Physical joint angles that fulfil it (rad).
    angles: JointVector,
    /// Whether these do; else a leg is too short, and they are those of the knot before.
    is_reached: bool,
    /// Expected ZMP of the whole body less that of the cart-table model, in the walk frame (m).
    expected_residual: Vector2<f64>,
}

impl DynamicsFilter {
    /// Looks ahead from the very beginning of a walk.
    ///
    /// * `com` – centre of mass along x and y of the walk frame
    /// * `motion` – joints, in support coordinates
    pub(crate) fn new(model: &PatternModel, feet: &FootTrajectory, com: [CartState; 2], motion: &Motion) -> Self {
        let angles = feet.to_physical(model, &motion.angles);
        let task = feet.task(model, projection(&com));
        let now = FilterKnot { com, task, angles, is_reached: true, expected_residual: Vector2::zeros() };
        let before = FilterKnot { angles: feet.to_physical(model, &(motion.angles - motion.rates * KNOT)), ..now };
        let mut knots = [before; KNOTS_FILTERED + 2];
        knots[0] = now;
        let mut filter = Self {
            zmp_reference: ZmpReference::new(model, &feet.footsteps),
            foot_trajectory: feet.clone(),
            body: WholeBodyIk::new(model, &motion.angles),
            inverse: NewtonEuler::default(),
            batch: Batch::default(),
            knots,
            unexpected: [Vector2::zeros(); KNOTS_FILTERED + 2],
            unexpected_max: f64::INFINITY,
            present: 0,
            ahead: 0,
            correction_input: Vector2::zeros(),
            stage: Stage::CentreOfMass,
        };
        filter.recompute(model, feet);
        filter
    }

    /// Computes all coming knots anew: the walk continues from the present knot by other footsteps.
    pub(crate) fn recompute(&mut self, model: &PatternModel, feet: &FootTrajectory) {
        self.restart(model, feet, f64::INFINITY);
        self.complete(model);
    }

    /// Discards the coming knots, which are to be computed by other footsteps.
    ///
    /// * `unexpected_max` – largest unexpected ZMP that is corrected (m)
    pub(crate) fn restart(&mut self, model: &PatternModel, feet: &FootTrajectory, unexpected_max: f64) {
        self.unexpected_max = unexpected_max;
        self.foot_trajectory.clone_from(feet);
        self.zmp_reference.restart(model, &feet.footsteps);
        (self.ahead, self.stage) = (0, Stage::CentreOfMass);
        let [before, now] =
            [self.slot(0) + self.knots.len() - 1, self.slot(0)].map(|slot| self.knots[slot % self.knots.len()].angles);
        self.body = WholeBodyIk::new(model, &feet.to_support(model, &now));
        self.body.expect_change(&feet.to_support(model, &(now - before)));
    }

    /// Computes all that is missing.
    pub(crate) fn complete(&mut self, model: &PatternModel) {
        while self.missing() >= LANES && matches!(self.stage, Stage::CentreOfMass) {
            self.extend_by_batch(model);
        }
        while self.missing() > 0 {
            self.extend(model);
        }
    }

    /// How many knots are still to be computed.
    pub(crate) fn missing(&self) -> usize {
        KNOTS_FILTERED - self.ahead
    }

    /// Computes one knot more, or the rest of one.
    pub(crate) fn extend(&mut self, model: &PatternModel) {
        let ahead = self.ahead;
        while self.ahead == ahead {
            self.compute_stage(model);
        }
    }

    /// Computes [`LANES`] knots more, their dynamics at once.
    fn extend_by_batch(&mut self, model: &PatternModel) {
        let first = self.ahead;
        let mut footprints = [self.foot_trajectory.footsteps.feet.footprint; LANES];
        for (lane, footprint) in footprints.iter_mut().enumerate() {
            self.ahead = first + lane;
            while !matches!(self.stage, Stage::Zmp(_)) {
                self.compute_stage(model);
            }
            if let Stage::Zmp(before) = std::mem::replace(&mut self.stage, Stage::CentreOfMass) {
                *footprint = before;
                self.batch.set(lane, &self.motion_over(model, before));
            }
        }
        self.batch.compute(&model.tree);
        for (lane, footprint) in footprints.into_iter().enumerate() {
            self.ahead = first + lane;
            self.record_unexpected(model, footprint, &self.batch.ground(lane));
            self.stage = Stage::Correction;
            self.compute_stage(model);
        }
    }

    /// Advances by a knot: the next knot becomes the present one. All must be computed before the next call.
    pub(crate) fn advance(&mut self) {
        self.present = self.slot(1);
        self.ahead -= 1;
    }

    /// Computes as much of the missing knot as is due.
    ///
    /// * `share` – share of the time to the next knot that has passed
    pub(crate) fn keep_up(&mut self, model: &PatternModel, share: f64) {
        while self.missing() > 0 && self.stage.is_due(share) {
            self.compute_stage(model);
        }
    }

    /// The task of the whole body at the present knot, its centre of mass corrected.
    ///
    /// * `footprint` – the support foot
    /// * `correction` – of the centre of mass, in the walk frame (m)
    pub(crate) fn task(&self, footprint: &Footprint, correction: Vector2<f64>) -> WholeBodyTask {
        let FilterKnot { com, task, .. } = &self.knots[self.present];
        WholeBodyTask { com: footprint.point_to_support(projection(com) + correction), ..*task }
    }

    /// The preview input of the correction, once all knots are computed, along both axes of the walk frame.
    pub(crate) fn correction_input(&self) -> Vector2<f64> {
        self.correction_input
    }

    /// The footsteps at the farthest knot.
    #[cfg(test)]
    pub(crate) fn farthest_footsteps(&self) -> &FootstepPlan {
        &self.foot_trajectory.footsteps
    }

    fn slot(&self, ahead: usize) -> usize {
        (self.present + ahead) % self.knots.len()
    }

    /// Slots of the last but one knot, the last one, and the new one that is being computed.
    fn last_three(&self) -> [usize; 3] {
        [self.ahead + self.knots.len() - 1, self.ahead, self.ahead + 1].map(|ahead| self.slot(ahead))
    }

    fn compute_stage(&mut self, model: &PatternModel) {
        let [_, last, new] = self.last_three();
        self.stage = match self.stage {
            Stage::CentreOfMass => {
                let sum = self.zmp_reference.weighted_sum(&model.com_controller);
                let com = self.knots[last].com;
                self.knots[new].com = [0, 1].map(|axis| model.com_controller.advance(&com[axis], sum[axis]));
                self.zmp_reference.advance(model);
                let before = self.foot_trajectory.footsteps.feet.footprint;
                if self.foot_trajectory.advance(model) {
                    self.body.change_support(model);
                }
                let FootstepPlan { feet, .. } = &self.foot_trajectory.footsteps;
                self.knots[new].expected_residual =
                    feet.footprint.direction_to_walk(self.foot_trajectory.footsteps.lipm_residual(model));
                Stage::Task(before)
            }
            Stage::Task(before) => {
                self.knots[new].task = self.foot_trajectory.task(model, projection(&self.knots[new].com));
                Stage::Posture(before)
            }
            Stage::Posture(before) => {
                let solution = self.body.solve(model, &self.knots[new].task);
                self.knots[new].is_reached = solution.is_ok();
                self.knots[new].angles =
                    solution.map_or(self.knots[last].angles, |angles| self.foot_trajectory.to_physical(model, &angles));
                Stage::Zmp(before)
            }
            Stage::Zmp(footprint) => {
                let motion = self.motion_over(model, footprint);
                let ground = self.inverse.ground_wrench(&model.tree, &motion);
                self.record_unexpected(model, footprint, &ground);
                Stage::Correction
            }
            Stage::Correction => {
                self.ahead += 1;
                if self.missing() == 0 {
                    self.correction_input = -model.correction_controller.weighted_sum(&self.unexpected, self.slot(1));
                }
                Stage::CentreOfMass
            }
        };
    }

    /// The motion at the last knot, in support coordinates of the foot that supports there.
    fn motion_over(&self, model: &PatternModel, footprint: Footprint) -> Motion {
        let [before, here, after] = self.last_three().map(|slot| &self.knots[slot].angles);
        model.mirror.to_support(footprint.side, &Motion::between(before, here, after, KNOT))
    }

    /// Records the unexpected part of the ZMP at the last knot; the new knot is taken to be alike. Where a leg is too
    /// short the posture jumps: that is not the ZMP of what will be played.
    ///
    /// * `footprint` – the support foot
    /// * `ground` – the wrench that the motion there needs
    fn record_unexpected(&mut self, model: &PatternModel, footprint: Footprint, ground: &Wrench) {
        let slots = self.last_three();
        let [_, here, new] = slots;
        let is_reached = slots.iter().all(|slot| self.knots[*slot].is_reached);
        if let Some(point) = zmp(ground).filter(|_| is_reached) {
            let knot = &self.knots[here];
            let pendulum = Vector2::from([0, 1].map(|axis| {
                let [position, _, acceleration] = knot.com[axis].into();
                position - model.lipm_residual.height_over_gravity * acceleration
            }));
            let unexpected = footprint.point_to_walk(point) - pendulum - knot.expected_residual;
            self.unexpected[here] = unexpected.map(|zmp| zmp.clamp(-self.unexpected_max, self.unexpected_max));
        }
        self.unexpected[new] = self.unexpected[here];
    }
}

impl Stage {
    /// Whether the stage is to be computed once a share of the time to the next knot has passed. The last is computed
    /// after three quarters: a quarter is left for ticks that come late.
    fn is_due(self, share: f64) -> bool {
        const DUE: [f64; 5] = [0.15, 0.3, 0.45, 0.6, 0.75];
        let index = match self {
            Stage::CentreOfMass => 0,
            Stage::Task(_) => 1,
            Stage::Posture(_) => 2,
            Stage::Zmp(_) => 3,
            Stage::Correction => 4,
        };
        DUE[index] <= share
    }
}

/// Projection of the centre of mass, in the walk frame (m).
fn projection([x, y]: &[CartState; 2]) -> Vector2<f64> {
    Vector2::new(x.x, y.x)
}
