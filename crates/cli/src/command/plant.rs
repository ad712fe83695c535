//! `halfstep plant`: the process that is the robot.

use std::path::{Path, PathBuf};

use ::record::{Note, Origin};
use balance::Preview;
use gait::{Start, Walk};
use model::Motion;
use plant::Setpoint;
use runtime::Rate;
use wire::PlantEnd;

use super::{InstanceOption, LoopOptions, PartOptions, print};
use crate::configuration::{ConfigOptions, DISTURBANCES, Errors, PLANT, Robot, read};
use crate::engine::{self, Engine, OutsideEngine, Setup};
use crate::failure::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::realtime;
use crate::record;
use crate::run_plant::run_plant;
use crate::summary::PlantSummary;
use crate::turns::Turns;

/// Run the simulated robot alone: it is held as the walk begins until the controller moves it
#[derive(Clone, Debug, clap::Args)]
pub struct Plant {
    #[command(flatten)]
    instance: InstanceOption,
    #[command(flatten)]
    config: ConfigOptions,
    #[command(flatten)]
    runs: LoopOptions,
    #[command(flatten)]
    part: PartOptions,
    /// Seed of the sensors' noise and of the errors of mass
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Pushes and sensor faults, as in config/disturbances_demo.toml
    #[arg(long, value_name = "FILE")]
    disturbances: Option<PathBuf>,
    /// Who computes the robot's physics
    #[arg(long, value_name = "NAME", default_value = "rust")]
    engine: Engine,
    /// End half a second after the robot has fallen
    #[arg(long)]
    end_when_fallen: bool,
}

impl Plant {
    pub fn run(self, json: bool) -> Result<Outcome, Failure> {
        self.part.bind()?;
        let interrupt = Interrupt::listen()?;

        let mut errors = Errors::default();
        let loaded = self.config.robot(&mut errors).zip(self.config.plant(&mut errors));
        let loaded = loaded.zip(self.config.realtime(&mut errors));
        let disturbances = ConfigOptions::disturbances(self.disturbances.as_deref(), &mut errors);
        let (((robot, parameters), realtime), disturbances) = errors.finish(loaded.zip(disturbances))?;
        let start = if self.runs.from_stand { self.stand(&robot)? } else { robot.nominal.at(0.0) };
        let period = realtime.rate.period_s();
        let mut plant = plant::Plant::new(&robot.mechanism, &parameters, &start, period, self.seed);
        let mut outside = match self.engine {
            Engine::Rust => None,
            Engine::Mujoco => {
                let stands = plant::RobotState::on_right_foot(&start, 0.0);
                let setup = Setup::new(&robot.mechanism, &parameters, &disturbances, &stands, self.seed, period)
                    .map_err(Failure::new)?;
                Some(OutsideEngine::start(engine::mujoco()?, &setup).map_err(Failure::new)?)
            }
        };
        plant.disturbances = disturbances;

        let PlantEnd { setpoints, mut measurements } =
            PlantEnd::connect(&self.instance.at_rate(realtime.rate)?, robot.mechanism.fingerprint)?;
        let clock = self.runs.clock();
        let to = self.recorded(realtime.rate, robot.mechanism.fingerprint)?;
        realtime.keep_off_the_loop(clock);
        let (mut record, record_end) = record::of_plant(clock, realtime.rate, to)?;
        let ticks = self.runs.ticks(realtime.rate);
        let mut turns = Turns::new(realtime.pace(clock), setpoints, "controller", ticks, interrupt);

        // Last: other threads are not to keep to the loop's core. Physics that another process computes would wait for a
        // core that this loop never leaves.
        let _granted = outside.is_none().then(|| realtime::enter(&realtime.plant, clock, "plant"));
        let stands = Setpoint { angles: start.angles, ..Setpoint::default() };
        let step = |plant: &mut plant::Plant, setpoint: &Setpoint| match &mut outside {
            None => Ok(plant.step(setpoint)),
            Some(engine) => engine.step(plant, setpoint),
        };
        let run = run_plant(&mut plant, step, stands, &mut turns, &mut measurements, &mut record, self.end_when_fallen);
        drop(record);
        let log_gaps = record_end.finish()?;
        let run = run?;

        let summary = PlantSummary {
            ticks: run.ticks,
            fell_at_s: run.fell_at.map(|tick| tick as f64 * period),
            deadline_misses: run.missed,
            log_gaps,
            wall_s: run.wall_ns as f64 * 1e-9,
        };
        print(json, &summary)?;
        Ok(Outcome::fine_if(run.fell_at.is_none()))
    }

    /// Where to record to, if anywhere, and what the run begins with.
    fn recorded(&self, rate: Rate, fingerprint: u64) -> Result<Option<(&Path, Origin)>, Failure> {
        let Some(folder) = self.part.out.as_deref() else { return Ok(None) };
        let mut files = self.config.texts(PLANT)?;
        if let Some(file) = &self.disturbances {
            files.push((DISTURBANCES.to_owned(), read(file)?));
        }
        let mut how = Note::new("plant", self.runs.words(&self.instance, rate, fingerprint));
        how.words.insert("seed".to_owned(), self.seed.to_string());
        how.words.insert("engine".to_owned(), self.engine.name().to_owned());
        Ok(Some((folder, Origin { notes: vec![how], files })))
    }

    /// The posture at which the controller begins, too.
    fn stand(&self, robot: &Robot) -> Result<Motion, Failure> {
        let mut errors = Errors::default();
        let loaded = self.config.controller(&mut errors);
        let gait = errors.finish(loaded)?.gait;
        let walk = Walk::new(robot.nominal.clone(), &robot.mechanism, &gait, Start::default());
        let preview = Preview::standing(&robot.mechanism, walk.map_err(Failure::bad_input)?);
        Ok(preview.physical_motion())
    }
}
