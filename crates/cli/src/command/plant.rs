//! `halfstep plant`: the process that is the robot.

use interface::Rate;
use std::path::{Path, PathBuf};

use gait::Robot;
use model::{Mechanism, Motion};
use node::announcements::Announced;
use node::configuration::{ConfigFiles, Errors, PLANT, URDF};
use node::cycle::Cycles;
use node::engine::{self, EngineSetup, ExternalPhysics};
use node::interrupt::Interrupt;
use node::physics::OwnPhysics;
use node::plant_loop::{AfterFall, run_plant};
use node::push_bridge::PushBridge;
use node::summary::PlantSummary;
use node::tell::tell;
use node::{realtime, recorder};
use pattern::PatternGenerator;
use plant::PlantParameters;
use record::{Metadata, Provenance};
use view::{FloorFile, FloorTexts};
use wire::{Instance, PlantPorts};

use super::config_options::ConfigOptions;
use super::engine::Engine;
use super::options::{ChildOptions, InstanceOption, LoopOptions};
use crate::error::CliError;
use crate::output::print;
use crate::status::Status;

/// Run the simulated robot: it holds its initial pose until the first setpoint arrives
#[derive(Clone, Debug, clap::Args)]
pub(super) struct PlantArgs {
    #[command(flatten)]
    instance: InstanceOption,
    #[command(flatten)]
    config: ConfigOptions,
    #[command(flatten)]
    runs: LoopOptions,
    #[command(flatten)]
    child: ChildOptions,
    /// Seed of sensor noise and mass errors
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Pushes and sensor faults, as in config/disturbances_demo.toml
    #[arg(long, value_name = "FILE")]
    disturbances: Option<PathBuf>,
    /// Physics engine
    #[arg(long, value_name = "NAME", default_value = "rust")]
    engine: Engine,
    /// End half a second after the robot has fallen
    #[arg(long)]
    end_when_fallen: bool,
    /// Put a robot that has fallen back on its feet, 2 s later and where it began: it is held there until a reset
    #[arg(long, conflicts_with = "end_when_fallen")]
    lift_when_fallen: bool,
}

impl PlantArgs {
    pub(super) fn run(mut self, json: bool) -> Result<Status, CliError> {
        self.config.resolve()?;
        self.child.bind()?;
        let interrupt = Interrupt::listen()?;

        let mut errors = Errors::default();
        let files = self.config.files();
        let loaded = files.robot(&mut errors).zip(files.plant(&mut errors));
        let loaded = loaded.zip(files.realtime(&mut errors));
        let disturbances = files.disturbances(self.disturbances.as_deref(), &mut errors);
        let (((robot, parameters), realtime), disturbances) = errors.finish(loaded.zip(disturbances))?;
        let start = if self.runs.from_stand { self.stand(&robot, &files)? } else { robot.nominal.at(0.0) };
        let after_fall = if self.lift_when_fallen {
            AfterFall::Lift(Box::new(self.stand(&robot, &files)?))
        } else if self.end_when_fallen {
            AfterFall::End
        } else {
            AfterFall::Stay
        };
        let period = realtime.rate.period_s();
        let mut plant = plant::Plant::new(&robot.mechanism, &parameters, &start, period, self.seed);
        let urdf = self.urdf(&robot.mechanism, &files)?;
        let mut outside = match self.engine {
            Engine::Rust => None,
            Engine::Mujoco => {
                let (mechanism, stands) = (&robot.mechanism, plant::RobotState::on_right_foot(&start, 0.0));
                let setup = EngineSetup::new(mechanism, &parameters, &disturbances, &stands, self.seed, period);
                let mut setup = setup.map_err(CliError::new)?;
                if let (Some(text), Some(source)) = (urdf.clone(), &mechanism.source) {
                    setup = setup.with_urdf(text, source, mechanism, &parameters, self.seed);
                }
                Some(ExternalPhysics::start(engine::mujoco()?, setup).map_err(CliError::new)?)
            }
        };
        plant.disturbances = disturbances;

        let instance = self.instance.of_loop(realtime.rate, &self.runs)?;
        let _leftovers = instance.leftovers();
        let PlantPorts { setpoints, mut measurements, pushes, true_poses } =
            PlantPorts::connect(&instance, robot.mechanism.fingerprint)?;
        let clock = self.runs.clock();
        let _floor = self.tell_floor(&instance, &files, &parameters)?;
        let field = parameters.floor.height_field.as_ref();
        let attached = urdf.map(|text| (URDF.to_owned(), text)).into_iter();
        let attached = attached.chain(field.map(|field| (field.file.clone(), field.text.to_string())));
        let to = self.recorded(&files, attached.collect(), realtime.rate, robot.mechanism.fingerprint)?;
        realtime.keep_off_the_loop(clock);
        let mut pushes = PushBridge::new(pushes, clock)?;
        if let Some(engine) = &outside {
            pushes = pushes.on_links(|link| engine.has(link));
        }
        let (mut recorder, recorder_thread) =
            recorder::of_plant(clock, realtime.rate, to, self.child.announced(), true_poses)?;
        let ticks = self.runs.ticks(realtime.rate);
        let mut cycles = Cycles::new(realtime.timing(clock), setpoints, "controller", ticks, interrupt).following();

        self.child.bind_run()?;
        // Last: other threads must not be pinned to the loop's core. With an external engine the loop is not pinned, so
        // that the engine need not wait for a core that the loop never leaves.
        let file = self.config.realtime_file();
        let _granted = outside.is_none().then(|| realtime::enter(&realtime.plant, clock, "plant", &file));
        if self.child.announced() == Announced::All {
            tell(format_args!("plant: waits for the controller on instance `{}`", self.instance.instance));
        }
        let (measurements, pushes, recorded) = (&mut measurements, &mut pushes, &mut recorder);
        let run = match &mut outside {
            None => run_plant(&mut plant, &mut OwnPhysics, &mut cycles, measurements, pushes, recorded, &after_fall),
            Some(physics) => run_plant(&mut plant, physics, &mut cycles, measurements, pushes, recorded, &after_fall),
        };
        drop(recorder);
        let recorded = recorder_thread.finish();
        let run = run?;

        let summary = PlantSummary {
            ticks: run.ticks,
            floor: parameters.floor_text(),
            fell_at_s: run.fell_at.map(|tick| tick as f64 * period),
            deadline_misses: run.missed,
            unstable: run.unstable.map(|unstable| {
                format!(
                    "{unstable}; look at, in {}: {}",
                    files.plant_file().display(),
                    plant.unstable_settings().join(", ")
                )
            }),
            log_gaps: recorded.lost,
            record_error: recorded.error.map(|error| error.to_string()),
            wall_s: run.wall_ns as f64 * 1e-9,
            setpoints_repeated: run.setpoints_repeated,
            setpoints_lost: run.setpoints_lost,
        };
        print(json, &summary)?;
        Ok(Status::success_if(run.fell_at.is_none() && run.unstable.is_none() && summary.record_error.is_none()))
    }

    /// Tells those who look on what the floor is, unless it is a plane.
    fn tell_floor(
        &self,
        instance: &Instance,
        files: &ConfigFiles,
        parameters: &PlantParameters,
    ) -> Result<Option<FloorFile>, CliError> {
        if parameters.ground(self.seed).is_plane() {
            return Ok(None);
        }
        let text = |(name, text): (String, String)| (name == PLANT).then_some(text);
        let Some(plant) = files.texts(PLANT, None)?.into_iter().find_map(text) else { return Ok(None) };
        let heights = parameters.floor.height_field.iter().map(|field| (field.file.clone(), field.text.to_string()));
        let texts = FloorTexts { plant, files: heights.collect(), seed: self.seed };
        // Without it a page draws a plane.
        Ok(texts.leave_in(instance.folder()).ok())
    }

    /// The URDF for MuJoCo, if the robot was imported from one.
    fn urdf(&self, mechanism: &Mechanism, files: &ConfigFiles) -> Result<Option<String>, CliError> {
        let Some(source) = mechanism.source.as_ref().filter(|_| self.engine == Engine::Mujoco) else {
            return Ok(None);
        };
        let urdf = files.urdf(source)?;
        if urdf.is_none() {
            let file = files.urdf_file(source);
            tell(format_args!("plant: {} does not exist: MuJoCo gets the mechanism instead", file.display()));
        }
        Ok(urdf)
    }

    /// Where to record to, if anywhere, and what the run begins with.
    ///
    /// * `attached` – names and texts of further files
    fn recorded(
        &self,
        files: &ConfigFiles,
        attached: Vec<(String, String)>,
        rate: Rate,
        fingerprint: u64,
    ) -> Result<Option<(&Path, Provenance)>, CliError> {
        let Some(folder) = self.child.out.as_deref() else { return Ok(None) };
        let mut files = files.texts(PLANT, self.disturbances.as_deref())?;
        files.extend(attached);
        let mut how = Metadata::new("plant", self.runs.words(&self.instance, rate, fingerprint));
        how.entries.insert("seed".to_owned(), self.seed.to_string());
        how.entries.insert("engine".to_owned(), self.engine.name().to_owned());
        Ok(Some((folder, Provenance { metadata: vec![how], files })))
    }

    /// The standing posture with which the controller begins, too.
    fn stand(&self, robot: &Robot, files: &ConfigFiles) -> Result<Motion, CliError> {
        let mut errors = Errors::default();
        let loaded = files.controller(&mut errors);
        PatternGenerator::standing_motion(robot, &errors.finish(loaded)?.gait).map_err(CliError::bad_input)
    }
}
