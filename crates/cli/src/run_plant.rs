//! The plant's loop: wait, read, step, write.

use plant::{Measurement, Plant, Setpoint};
use runtime::now_ns;
use wire::{MeasurementMessage, NewestWriter, SetpointMessage};

use crate::engine::EngineError;
use crate::exchange;
use crate::failure::Failure;
use crate::record::{PlantEntry, Record};
use crate::turns::Turns;

/// How often the truth is looked at and written down [control periods].
const TRUTH_PERIODS: u64 = 5;
/// How long a robot that has fallen is simulated on when the run ends with it [control periods].
const AFTER_FALL: u64 = 500;

/// What there is to say at the end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlantRun {
    /// Control periods simulated.
    pub ticks: u64,
    /// Missed deadlines.
    pub missed: u64,
    /// From the first step to the last [ns].
    pub wall_ns: u64,
    /// The control period in which it fell.
    pub fell_at: Option<u64>,
}

/// Runs until the turns end, or `end_when_fallen` and the robot has been lying for half a second. Before the first
/// setpoint comes the robot is held as it `stands`. Who computes its physics is what `step` is.
///
/// # Errors
/// In lockstep the controller has been silent for too long, or the physics cannot be computed.
pub fn run_plant(
    plant: &mut Plant,
    mut step: impl FnMut(&mut Plant, &Setpoint) -> Result<Measurement, EngineError>,
    stands: Setpoint,
    turns: &mut Turns<SetpointMessage>,
    measurements: &mut NewestWriter<MeasurementMessage>,
    record: &mut Record<PlantEntry>,
    end_when_fallen: bool,
) -> Result<PlantRun, Failure> {
    let mut run = PlantRun::default();
    let mut setpoint = stands;
    let mut began_ns = None;
    let mut look_at = TRUTH_PERIODS;
    record.push(PlantEntry { tick: 0, angles: plant.robot.angles, truth: plant.truth() });
    measurements.write(&exchange::measurement::message(0, now_ns(), &plant.measure()));

    while let Some(turn) = turns.wait(|| ()).map_err(Failure::new)? {
        let began_ns = *began_ns.get_or_insert_with(now_ns);
        run.missed += turn.missed;

        // What is no setpoint is not obeyed: the drives keep the last one.
        if let Ok(good) = turn.message.checked() {
            setpoint = exchange::setpoint::for_plant(&good);
        }

        let mut measured = step(plant, &setpoint).map_err(Failure::new)?;
        for _ in 1..turn.periods {
            measured = step(plant, &setpoint).map_err(Failure::new)?;
        }
        run.ticks = turn.tick + 1;

        measurements.write(&exchange::measurement::message(run.ticks, now_ns(), &measured));
        run.wall_ns = now_ns() - began_ns;

        if run.ticks >= look_at {
            look_at = run.ticks - run.ticks % TRUTH_PERIODS + TRUTH_PERIODS;
            let truth = plant.truth();
            if truth.has_fallen() {
                run.fell_at.get_or_insert(run.ticks);
            }
            record.push(PlantEntry { tick: run.ticks, angles: plant.robot.angles, truth });
        }
        if end_when_fallen && run.fell_at.is_some_and(|tick| run.ticks >= tick + AFTER_FALL) {
            break;
        }
    }
    Ok(run)
}
