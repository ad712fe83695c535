//! The examination: all checks in order, up to the first one that fails.

use crate::examined_robot::ExaminedRobot;
use crate::finding::Finding;
use crate::trial::TRIALS;
use crate::{body, diagnosis, drives, half_step, sensors};

/// Examines a robot, and tells each finding as soon as it is there. Stops at the first thing that is wrong, and returns
/// whether there was none.
///
/// * `timing` – what was found about the machine that runs the loops
pub fn examine(examined: &ExaminedRobot, timing: &Finding, mut tell: impl FnMut(&Finding)) -> bool {
    let mut is_good = |finding: &Finding| {
        tell(finding);
        finding.wrong.is_none()
    };
    let computed = [body::check, drives::check, sensors::check];
    computed.into_iter().all(|check| is_good(&check(examined)))
        && is_good(timing)
        && is_good(&half_step::check(examined))
        && TRIALS.iter().all(|trial| is_good(&diagnosis::run(examined, trial)))
}
