//! What a failed trial is due to: it is repeated with one setting at a time as it usually is.

use crate::examined_robot::{ExaminedRobot, RobotSetup};
use crate::finding::{Finding, Remedy};
use crate::settings::{Setting, unusual};
use crate::trial::{Trial, TrialOutcome};

/// How much further than with the usual settings the ZMP may be from its plan, and how much more the ankles may shake.
const WORSE_MAX: f64 = 1.5;
/// Differences that do not count: of lengths per that of the leg, and of the rate of the ankles (rad/s).
const SLACK: f64 = 1.5e-3;
const SHAKING_SLACK: f64 = 0.02;

/// Longest text of a value that is shown (bytes).
const TEXT_MAX: usize = 40;

/// Runs a trial, and finds what is wrong if it fails.
pub fn run(examined: &ExaminedRobot, trial: &Trial) -> Finding {
    let differ = unusual(&examined.setup, &examined.usual);
    let run = |setup: &RobotSetup| trial.run(examined, setup).map_err(|error| error.to_string());
    let outcome = run(&examined.setup);
    // What is as usual is compared with nothing but what was asked.
    let usual = if differ.is_empty() { None } else { run(&examined.usual).ok() };
    let is_reference = |usual: &TrialOutcome| usual.fell_at.is_none() && usual.stopped_by.is_none();
    let usual = usual.filter(is_reference);
    let complaint = |outcome: &Result<TrialOutcome, String>| match outcome {
        Ok(outcome) => complaint(trial, outcome, usual.as_ref(), examined.leg()),
        Err(error) => Some(error.clone()),
    };
    let figure = outcome.as_ref().map_or_else(|_| String::new(), figure);
    let Some(wrong) = complaint(&outcome) else { return Finding::good(trial.name, figure) };

    let with = |settings: &[&Setting]| {
        let mut setup = examined.setup.clone();
        settings.iter().for_each(|setting| (setting.copy)(&mut setup, &examined.usual));
        complaint(&run(&setup)).is_none()
    };
    let mut menders: Vec<&Setting> = differ.iter().copied().filter(|setting| with(&[setting])).collect();
    // All thresholds together mend it, too, if one of them does.
    let keys: Vec<&str> = menders.iter().map(|setting| setting.key).collect();
    menders.retain(|setting| {
        !keys.iter().any(|key| key.strip_prefix(setting.key).is_some_and(|rest| rest.starts_with('.')))
    });
    let mut together = "";
    if menders.is_empty() && differ.len() > 1 && with(&differ) {
        menders = differ.clone();
        together = "together with the others: ";
    }
    let mut remedies: Vec<Remedy> = menders.iter().map(|setting| remedy(examined, setting, together)).collect();
    if remedies.is_empty() {
        remedies.push(Remedy {
            file: "nominal_half_step.csv",
            key: "(the table)".to_owned(),
            advice: "no setting mends it by itself, nor all of them as usual: the half-step does not suit the robot, \
                     or its mechanism is wrong"
                .to_owned(),
        });
    }
    Finding::bad(trial.name, figure, wrong, remedies)
}

fn remedy(examined: &ExaminedRobot, setting: &Setting, together: &str) -> Remedy {
    let (is, usual) = ((setting.text)(&examined.setup), (setting.text)(&examined.usual));
    // Whole tables have no short text.
    let values = if is.len() > TEXT_MAX { "not as usual".to_owned() } else { format!("{is}, usual is {usual}") };
    let advice = format!("{together}{values}; {}", setting.effect);
    Remedy { file: setting.file, key: setting.key.to_owned(), advice }
}

/// What is wrong with an outcome.
fn complaint(trial: &Trial, outcome: &TrialOutcome, usual: Option<&TrialOutcome>, leg: f64) -> Option<String> {
    if let Some(time) = outcome.fell_at {
        let first = outcome.rejected.map_or(String::new(), |(time, rejection)| {
            format!("; from {time:.2} s on samples were rejected: {rejection}")
        });
        return Some(format!("the robot falls after {time:.2} s{first}"));
    }
    if let Some(fault) = &outcome.stopped_by {
        return Some(format!("a fault stops the robot: {fault}"));
    }
    if outcome.mode != trial.ends {
        return Some(format!("the robot is {}, and should be {}", outcome.mode, trial.ends));
    }
    let usual = usual?;
    if outcome.rejections > 10
        && outcome.rejections > 2 * usual.rejections
        && let Some((time, rejection)) = outcome.rejected
    {
        return Some(format!("{} samples are rejected, the first after {time:.2} s: {rejection}", outcome.rejections));
    }
    if outcome.cut.is_some() && usual.cut.is_none() {
        return Some("less is granted than is usual for this robot".to_owned());
    }
    let errors = [("ZMP", outcome.zmp_error, usual.zmp_error), ("centre of mass", outcome.com_error, usual.com_error)];
    for (what, is, was) in errors {
        if is > WORSE_MAX * was + SLACK * leg {
            let [is, was] = [is, was].map(|error| error * 1e3);
            return Some(format!("the {what} is {is:.1} mm off its plan, with usual settings {was:.1} mm"));
        }
    }
    if outcome.shaking > WORSE_MAX * usual.shaking + SHAKING_SLACK {
        let [is, was] = [outcome.shaking, usual.shaking].map(f64::to_degrees);
        return Some(format!("balance turns the ankles at {is:.1} °/s, with usual settings at {was:.1} °/s"));
    }
    None
}

fn figure(outcome: &TrialOutcome) -> String {
    format!(
        "ZMP {:.1} mm, centre of mass {:.1} mm off plan, balance turns the ankles at {:.0} °/s",
        outcome.zmp_error * 1e3,
        outcome.com_error * 1e3,
        outcome.shaking.to_degrees()
    )
}
