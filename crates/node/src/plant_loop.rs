//! The plant's loop: wait, read, step, write.

use std::time::Duration;

use interface::{PushOutcome, PushReply, Rate};
use model::Motion;
use plant::{Instability, Obedience, Plant};
use runtime::now_ns;
use wire::{LatestWriter, MeasurementMessage, SetpointMessage};

use crate::cycle::Cycles;
use crate::entry::{PlantEntry, PlantEvent};
use crate::error::NodeError;
use crate::physics::Physics;
use crate::push_bridge::PushBridge;
use crate::recorder::Recorder;

/// Time between two records of the robot's true state.
const TRUTH_INTERVAL: Duration = Duration::from_millis(5);
/// After how long without a new setpoint the controller counts as silent.
const SILENT_AFTER: Duration = Duration::from_millis(500);
/// How long the run goes on after the robot has fallen, if the run ends with a fall.
const AFTER_FALL: Duration = Duration::from_millis(500);
/// How long a robot that has fallen lies there, if it is lifted.
const LIFTED_AFTER: Duration = Duration::from_secs(2);

/// What becomes of a robot that has fallen.
#[derive(Clone, Debug, PartialEq)]
pub enum AfterFall {
    /// It stays where it lies.
    Stay,
    /// The run ends half a second later.
    End,
    /// Two seconds later it is put back to where it began, with this posture, and held there until a controller begins
    /// in it.
    Lift(Box<Motion>),
}

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
    lifted_ticks: u64,
}

impl Intervals {
    fn at(rate: Rate) -> Self {
        Self {
            truth_ticks: rate.ticks(TRUTH_INTERVAL).max(1),
            after_fall_ticks: rate.ticks(AFTER_FALL),
            silent_ticks: rate.ticks(SILENT_AFTER).max(1),
            lifted_ticks: rate.ticks(LIFTED_AFTER),
        }
    }
}

/// Runs until the cycles end, until the simulation has become unstable or, if `after_fall` says so, until half a second
/// after the robot has fallen. The robot is held where it is until a controller begins there ([`Obedience`]). `pushes`
/// are on the robot as this process simulates it.
///
/// # Errors
/// In lockstep no setpoint has arrived for too long, or the physics cannot be computed.
pub fn run_plant(
    plant: &mut Plant,
    physics: &mut impl Physics,
    cycles: &mut Cycles<SetpointMessage>,
    measurements: &mut LatestWriter<MeasurementMessage>,
    pushes: &mut PushBridge,
    recorder: &mut Recorder<PlantEvent>,
    after_fall: &AfterFall,
) -> Result<PlantRun, NodeError> {
    let mut run = PlantRun::default();
    let mut obedience = Obedience::of(plant);
    let mut fallen_since = None;
    let (mut began_ns, mut last_tick) = (None, None);
    let Intervals { truth_ticks, after_fall_ticks, silent_ticks, lifted_ticks } = Intervals::at(cycles.rate());
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
            obedience.hear(&valid);
        }
        let mut pass = || obedience.obey(plant, |plant, setpoint| physics.step(plant, setpoint));
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
                fallen_since.get_or_insert(run.ticks);
            }
            recorder.push(PlantEvent::Tick(PlantEntry { tick: run.ticks, angles: plant.robot.angles, truth }));
        }
        let has_lain_for = |ticks| fallen_since.is_some_and(|fallen| run.ticks >= fallen + ticks);
        match after_fall {
            AfterFall::End if has_lain_for(after_fall_ticks) => break,
            AfterFall::Lift(posture) if has_lain_for(lifted_ticks) => {
                plant.place(posture);
                physics.place(plant, posture)?;
                obedience = Obedience::of(plant);
                fallen_since = None;
            }
            _ => (),
        }
    }
    Ok(run)
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
            assert_eq!(intervals.lifted_ticks, 4 * after_fall_ticks, "{hz} Hz");
        }
    }
}
