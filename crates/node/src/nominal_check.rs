//! Checks the nominal half-step against the mechanism that is to walk it.

use std::path::Path;

use gait::NominalTable;
use model::{Joint, Mechanism, Mirror};

/// The first interval over which a joint moves faster than it may, or otherwise than its rates and accelerations say;
/// and by how much it moves.
fn first_jump(nominal: &NominalTable, joint: Joint, step: f64, rate_max: f64) -> Option<(usize, f64)> {
    /// Largest difference from the rule below (rad): of a table of four intervals it is a tenth.
    const OFF_MAX: f64 = 0.05;
    let intervals = nominal.rows.windows(2).map(|rows| {
        let [from, to] = [rows[0].motion, rows[1].motion]
            .map(|motion| [motion.angles[joint], motion.rates[joint], motion.accelerations[joint]]);
        // The corrected trapezoidal rule.
        let moved = step * (from[1] + to[1]) / 2.0 - step * step * (to[2] - from[2]) / 12.0;
        (to[0] - from[0], to[0] - from[0] - moved)
    });
    let is_jump = |(jump, off): &(f64, f64)| jump.abs() > rate_max * step || off.abs() > OFF_MAX;
    intervals.enumerate().find(|(_, interval)| is_jump(interval)).map(|(row, (jump, _))| (row, jump))
}

/// Tells whether the end of the half-step differs from the mirror image of its start, and for each joint where it first
/// exceeds the joint's limits.
pub(crate) fn check_nominal(mechanism: &Mechanism, nominal: &NominalTable, file: &Path) -> Vec<String> {
    let mut errors = Vec::new();
    let file = file.display();
    if let Some(mirror) = Mirror::new(mechanism)
        && let Err(error) = nominal.check(&mirror)
    {
        errors.push(format!("{file}: {error}"));
    }
    for joint in Joint::ALL {
        let (number, name) = (joint.number(), joint.name());
        let moves = |row: &gait::NominalRow| row.motion.angles[joint] != 0.0 || row.motion.rates[joint] != 0.0;
        let Some(limits) = mechanism.links[joint].limits else {
            if let Some(row) = nominal.rows.iter().position(moves) {
                errors.push(format!(
                    "{file}: interval {row}: joint {number} ({name}) has no motor and must be at rest at 0: the \
                     support sole is flat on the ground"
                ));
            }
            continue;
        };
        let step = nominal.duration / nominal.rows.len().saturating_sub(1).max(1) as f64;
        if let Some((row, jump)) = first_jump(nominal, joint, step, limits.rate_max) {
            errors.push(format!(
                "{file}: interval {row}: joint {number} ({name}) jumps by {:.2}° to the next row, which does not \
                 follow from its rates",
                jump.to_degrees()
            ));
        }
        let (min, max) = (limits.angle_min, limits.angle_max);
        let angles = nominal.rows.iter().map(|row| row.motion.angles[joint]).enumerate();
        if let Some((row, angle)) = angles.into_iter().find(|(_, angle)| !(min..=max).contains(angle)) {
            let [angle, min, max] = [angle, min, max].map(f64::to_degrees);
            errors.push(format!(
                "{file}: interval {row}: joint {number} ({name}) is at {angle:.2}°; its range is {min:.2}° to {max:.2}°"
            ));
        }
        let rates = nominal.rows.iter().map(|row| row.motion.rates[joint]).enumerate();
        if let Some((row, rate)) = rates.into_iter().find(|(_, rate)| rate.abs() > limits.rate_max) {
            let [rate, max] = [rate, limits.rate_max].map(f64::to_degrees);
            errors.push(format!(
                "{file}: interval {row}: joint {number} ({name}) moves at {rate:.1} °/s; its limit is {max:.1} °/s"
            ));
        }
    }
    errors
}
