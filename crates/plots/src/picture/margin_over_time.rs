//! Margin over time: distance of the zero-moment point from the edge of the support polygon, planned and measured.

use dynamics::Tree;
use model::Mechanism;

use super::chart::{Pen, Point};
use super::colours::{EDGE, PLANNED, ZMP};
use super::time_panel::{TimePanel, picture, whole_run};
use crate::run_log::{ControllerRow, RunLog};

/// Height of a panel (px).
const HEIGHT: f64 = 260.0;
/// Range that is always shown: the greatest distance of a point of a sole from its edge, and some more (mm).
const ALWAYS: [f64; 2] = [-5.0, 45.0];
/// Lower margins are those of a fall, and would flatten everything else (mm).
pub(super) const LOWEST: f64 = -60.0;

/// Two panels: the margin at every tick, and its least value in each half-step away from support changes, at which the
/// planned point moves from foot to foot.
pub fn margin_over_time(log: &RunLog, mechanism: &Mechanism) -> String {
    let (planned, measured) = (Pen::solid(PLANNED, 2.4), Pen::solid(ZMP, 1.0));
    let edge = Pen::dashed(EDGE, 1.4);
    let margins = Margins::of(log, mechanism);

    let mut every = TimePanel::usual("margin [mm]", &ALWAYS).not_below(LOWEST);
    every.draw("ZMP planned, to the edge", planned, margins.over_time(|margin| margin.planned));
    every.draw("ZMP measured, to the edge", measured, margins.over_time(|margin| margin.measured));
    every.level("edge of the support polygon", &[0.0], edge);

    let mut least = TimePanel::new("least, off support changes [mm]", &ALWAYS).not_below(LOWEST);
    least.draw("ZMP planned, to the edge", planned, margins.least(|margin| margin.planned));
    least.draw("ZMP measured, to the edge", measured, margins.least(|margin| margin.measured));
    least.level("edge of the support polygon", &[0.0], edge);

    picture("Margin of the zero-moment point", log, mechanism, whole_run(log), HEIGHT, vec![every, least])
}

/// The least measured margin of each half-step away from support changes, as a step curve (mm).
pub(super) fn least_measured_margins(log: &RunLog, mechanism: &Mechanism) -> Vec<Point> {
    Margins::of(log, mechanism).least(|margin| margin.measured)
}

/// The margin at a tick (m).
struct Margin {
    time: f64,
    half_step: u64,
    is_off_support_changes: bool,
    measured: Option<f64>,
    /// Margin of the planned point in the hull of the support sole and, if loaded, the other one; `None` near support
    /// changes.
    planned: Option<f64>,
}

struct Margins(Vec<Margin>);

impl Margins {
    fn of(log: &RunLog, mechanism: &Mechanism) -> Self {
        let tree = Tree::new(mechanism);
        let at = |row: &ControllerRow| {
            let plant = log.plant_at(row.time);
            // After the plant's end there is no sole; without its part only the measured margin is known.
            if plant.is_none() && !log.plant.is_empty() {
                return None;
            }
            let planned = row.zmp_planned.filter(|_| row.is_off_support_changes()).zip(plant).map(|(zmp, plant)| {
                let foot = plant.footprint(mechanism, &tree, row.support);
                let support = plant.hull_of_soles(mechanism, &tree, |side| side == row.support || plant.bears(side));
                support.margin(foot.to_world(zmp))
            });
            Some(Margin {
                time: row.time,
                half_step: row.half_step,
                is_off_support_changes: row.is_off_support_changes(),
                measured: row.margin,
                planned,
            })
        };
        Self(log.controller.iter().filter_map(at).collect())
    }

    /// The margin at every tick (mm).
    fn over_time(&self, which: impl Fn(&Margin) -> Option<f64>) -> Vec<Point> {
        self.0.iter().map(|margin| [margin.time, which(margin).map_or(f64::NAN, |margin| margin * 1e3)]).collect()
    }

    /// The least margin of each half-step as a step curve (mm).
    fn least(&self, which: impl Fn(&Margin) -> Option<f64>) -> Vec<Point> {
        let steps = self.0.chunk_by(|before, after| before.half_step == after.half_step).flat_map(|half_step| {
            let within = half_step.iter().filter(|margin| margin.is_off_support_changes);
            let least = within.filter_map(&which).min_by(f64::total_cmp).map_or(f64::NAN, |margin| margin * 1e3);
            let ends = [&half_step[0], &half_step[half_step.len() - 1]];
            ends.map(|end| [end.time, least])
        });
        steps.collect()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;
    use crate::run_log::synthetic;

    #[test]
    fn planned_margin_is_relative_to_the_support_sole() {
        let (mut log, mechanism) = (synthetic::log(4, 0.3), synthetic::mechanism());
        // 3 cm inward of the ankle: 1 cm from the inner edge, on either foot and wherever it points.
        log.controller.iter_mut().for_each(|row| row.zmp_planned = Some(Vector2::new(0.02, 0.03)));
        let dip = &mut log.controller[8];
        (dip.zmp_planned, dip.margin) = (Some(Vector2::new(0.02, 0.05)), Some(-0.02));
        let margins = Margins::of(&log, &mechanism);
        for margin in margins.0.iter().filter(|margin| margin.is_off_support_changes) {
            let expected = if margin.time == log.controller[8].time { -0.01 } else { 0.01 };
            assert!((margin.planned.unwrap() - expected).abs() < 1e-12, "{:?} at {}", margin.planned, margin.time);
        }
        // Ticks 6 to 11 are half-step 1.
        let least = |which: fn(&Margin) -> Option<f64>| margins.least(which).chunks(2).map(|step| step[0][1]).collect();
        let measured: Vec<f64> = least(|margin| margin.measured);
        let planned: Vec<f64> = least(|margin| margin.planned);
        assert_eq!(measured, [20.0, -20.0, 20.0, 20.0, 20.0]);
        assert!(
            planned.iter().zip([10.0, -10.0, 10.0, 10.0, 10.0]).all(|(is, be)| (is - be).abs() < 1e-9),
            "{planned:?}"
        );
    }
}
