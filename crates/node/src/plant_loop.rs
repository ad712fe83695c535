//! The plant's loop: wait, read, step, write.

use std::time::Duration;

use interface::{Measurement, PushOutcome, PushReply, Setpoint};
use model::JointVector;
use plant::{Instability, Plant};
use runtime::{Rate, now_ns};
use wire::{LatestWriter, MeasurementMessage, SetpointMessage};

use crate::cycle::Cycles;
use crate::engine::EngineError;
use crate::entry::{PlantEntry, PlantEvent};
use crate::error::NodeError;
use crate::push_bridge::PushBridge;
use crate::recorder::Recorder;

/// Time between two records of the robot's true state.
const TRUTH_INTERVAL: Duration = Duration::from_millis(5);
/// Largest differences of a setpoint from the initial posture (rad) and its rates (rad/s) with which the robot is let
/// go.
const RELEASE_TOLERANCE: [f64; 2] = [0.05, 0.3];
/// After how long without a new setpoint the controller counts as silent.
const SILENT_AFTER: Duration = Duration::from_millis(500);
/// How long the run goes on after the robot has fallen, if the run ends with a fall.
const AFTER_FALL: Duration = Duration::from_millis(500);

/// Result of a run of the plant's loop.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlantRun {
    /// Simulated control periods.
    pub ticks: u64,
    /// Deadlines missed.
    pub missed: u64,
    /// Wall-clock time from the first step to the last (ns).
    pub wall_ns: u64,
    /// The control period in which the robot fell.
    pub fell_at: Option<u64>,
    /// What showed that the simulation had become unstable, which ended the run.
    pub unstable: Option<Instability>,
    /// Control periods without a new setpoint.
    pub setpoints_repeated: u64,
    /// Setpoints that were replaced before the plant used them.
    pub setpoints_lost: u64,
}

/// The loop's intervals in control periods.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Intervals {
    truth_ticks: u64,
    after_fall_ticks: u64,
    silent_ticks: u64,
}

impl Intervals {
    fn at(rate: Rate) -> Self {
        Self {
            truth_ticks: rate.ticks(TRUTH_INTERVAL).max(1),
            after_fall_ticks: rate.ticks(AFTER_FALL),
            silent_ticks: rate.ticks(SILENT_AFTER).max(1),
        }
    }
}

/// Runs until the cycles end, until the simulation has become unstable or, if `end_when_fallen`, until half a second
/// after the robot has fallen. The robot is held where it is until a controller begins there: one that commands another
/// posture would throw the robot over, and one that only keeps the joints where they are balances nothing. `step`
/// computes the physics of one control period; `pushes` are on the robot as this process simulates it.
///
/// # Errors
/// In lockstep no setpoint has arrived for too long, or the physics cannot be computed.
pub fn run_plant(
    plant: &mut Plant,
    mut step: impl FnMut(&mut Plant, &Setpoint) -> Result<Measurement, EngineError>,
    cycles: &mut Cycles<SetpointMessage>,
    measurements: &mut LatestWriter<MeasurementMessage>,
    pushes: &mut PushBridge,
    recorder: &mut Recorder<PlantEvent>,
    end_when_fallen: bool,
) -> Result<PlantRun, NodeError> {
    let mut run = PlantRun::default();
    let initial = Setpoint { angles: plant.robot.angles, rates: plant.robot.rates, ..Setpoint::default() };
    let mut setpoint = initial;
    let mut is_held = true;
    let (mut began_ns, mut last_tick) = (None, None);
    let Intervals { truth_ticks, after_fall_ticks, silent_ticks } = Intervals::at(cycles.rate());
    let (mut next_truth, mut silence, mut is_silent) = (truth_ticks, 0, false);
    plant.disturbances.make_room();
    recorder.push(PlantEvent::Tick(PlantEntry { tick: 0, angles: plant.robot.angles, truth: plant.truth() }));
    measurements.write(&MeasurementMessage::new(0, now_ns(), &plant.measure()));

    while let Some(cycle) = cycles.wait(|| ())? {
        let began_ns = *began_ns.get_or_insert_with(now_ns);
        pushes.serve(|asked| {
            let start = plant.time();
            match plant.begin_push(asked) {
                Ok(push) => {
                    recorder.push(PlantEvent::Push(run.ticks, push));
                    PushReply { outcome: PushOutcome::Begun, start }
                }
                Err(outcome) => PushReply { outcome, start },
            }
        });
        run.missed += cycle.missed;

        // A setpoint has the tick of the measurement that it answers.
        if let Some(last) = last_tick.replace(cycle.message.tick) {
            let is_repeated = cycle.message.tick == last;
            silence = if is_repeated { silence + cycle.periods } else { 0 };
            if is_silent != (silence >= silent_ticks) {
                is_silent = !is_silent;
                let event = if is_silent { PlantEvent::ControllerSilent } else { PlantEvent::ControllerBack };
                recorder.push(event(cycle.tick));
            }
            run.setpoints_repeated += u64::from(is_repeated);
            run.setpoints_lost += cycle.message.tick.saturating_sub(last).saturating_sub(cycle.periods);
        }
        // An invalid setpoint is not obeyed: the drives keep the last one.
        if let Ok(valid) = cycle.message.checked() {
            setpoint = valid;
        }

        is_held &= only_holds(&setpoint) || !begins_at(&setpoint, &initial);
        let mut pass = || if is_held { Ok(plant.hold()) } else { step(plant, &setpoint) };
        let mut measured = pass()?;
        for _ in 1..cycle.periods {
            measured = pass()?;
        }
        run.ticks = cycle.tick + 1;
        run.unstable = plant.instability();
        if run.unstable.is_some() {
            break;
        }

        measurements.write(&MeasurementMessage::new(run.ticks, now_ns(), &measured));
        run.wall_ns = now_ns() - began_ns;

        if run.ticks >= next_truth {
            next_truth = run.ticks - run.ticks % truth_ticks + truth_ticks;
            let truth = plant.truth();
            if truth.has_fallen() {
                run.fell_at.get_or_insert(run.ticks);
            }
            recorder.push(PlantEvent::Tick(PlantEntry { tick: run.ticks, angles: plant.robot.angles, truth }));
        }
        if end_when_fallen && run.fell_at.is_some_and(|tick| run.ticks >= tick + after_fall_ticks) {
            break;
        }
    }
    Ok(run)
}

/// Whether a setpoint is near the initial posture, and as fast.
fn begins_at(setpoint: &Setpoint, initial: &Setpoint) -> bool {
    let [angle, rate] = RELEASE_TOLERANCE;
    (setpoint.angles - initial.angles).max_abs() <= angle && (setpoint.rates - initial.rates).max_abs() <= rate
}

/// Whether a setpoint does no more than keep the joints where they are, as after a fault.
fn only_holds(setpoint: &Setpoint) -> bool {
    setpoint.rates == JointVector::ZERO && setpoint.feed_forward == JointVector::ZERO
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn run_ends_half_a_second_after_a_fall_at_any_rate() {
        for (hz, truth_ticks, after_fall_ticks) in [(250, 1, 125), (1000, 5, 500), (4000, 20, 2000)] {
            let intervals = Intervals::at(Rate::new(hz).expect("a rate that loops can keep"));
            assert_eq!([intervals.truth_ticks, intervals.after_fall_ticks], [truth_ticks, after_fall_ticks], "{hz} Hz");
            assert_eq!(intervals.silent_ticks, after_fall_ticks, "{hz} Hz: both half a second");
        }
    }
}
