//! `halfstep controller`: the process that walks.

use std::path::Path;

use controller::Driver;
use dialogue::reply_text::reply_text;
use interface::Rate;
use node::admission_worker::ClockedWorker;
use node::announcements::{Announced, Announcements};
use node::configuration::{self, CONTROLLER, ConfigFiles, Errors};
use node::controller_loop::run_controller;
use node::cycle::{Clock, Cycles};
use node::interrupt::Interrupt;
use node::request_bridge::RequestBridge;
use node::request_queue::{CAPACITY, RequestQueue};
use node::summary::{ControllerSummary, FaultSummary};
use node::tell::tell;
use node::{realtime, recorder};
use record::{Metadata, Provenance};
use wire::ControllerPorts;

use super::config_options::ConfigOptions;
use super::options::{ChildOptions, InstanceOption, LoopOptions};
use crate::error::CliError;
use crate::output::print;
use crate::status::Status;

/// Run the controller process: it waits for its plant, then walks until a request changes that
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ControllerArgs {
    #[command(flatten)]
    instance: InstanceOption,
    #[command(flatten)]
    config: ConfigOptions,
    #[command(flatten)]
    runs: LoopOptions,
    #[command(flatten)]
    child: ChildOptions,
}

/// How far the priorities of the threads beside the loop are below the loop's. Both are above ordinary threads, so that
/// requests do not wait for other load; evaluating a request takes longer than transferring one.
const BRIDGE_BELOW: u8 = 1;
const ADMISSION_BELOW: u8 = 2;

impl ControllerArgs {
    pub(super) fn run(mut self, json: bool) -> Result<Status, CliError> {
        self.config.resolve()?;
        self.child.bind()?;
        let interrupt = Interrupt::listen()?;

        let mut errors = Errors::default();
        let files = self.config.files();
        let loaded = files.robot(&mut errors).zip(files.controller(&mut errors));
        let loaded = loaded.zip(files.realtime(&mut errors));
        let ((robot, parameters), realtime) = errors.finish(loaded)?;
        let (clock, rate, fingerprint) = (self.runs.clock(), realtime.rate, robot.mechanism.fingerprint);
        let controller = configuration::controller(&robot, parameters, clock, self.runs.from_stand)?;

        let instance = self.instance.of_loop(rate, &self.runs)?;
        let _leftovers = instance.leftovers();
        let ControllerPorts { mut setpoints, measurements, requests, reports } =
            ControllerPorts::connect(&instance, fingerprint)?;
        let mut cycles = Cycles::new(realtime.timing(clock), measurements, "plant", self.runs.ticks(rate), interrupt);
        let mut queue =
            RequestQueue::new(RequestBridge::new(requests, clock, CAPACITY, realtime.controller.below(BRIDGE_BELOW))?);
        let worker = ClockedWorker::new(clock, realtime.controller.below(ADMISSION_BELOW))?;
        let mut driver = Driver { controller, worker };
        // Who answers may run wherever there is room; who writes down has time.
        realtime.keep_off_the_loop(clock);
        let (mut recorder, recorder_thread) = recorder::of_controller(
            clock,
            rate,
            self.recorded(&files, rate, fingerprint)?,
            reports,
            Announcements::new(self.child.announced(), self.instance.instance.as_str(), reply_text),
        )?;

        self.child.bind_run()?;
        // Last: the other threads must not be pinned to the loop's core.
        let _granted = realtime::enter(&realtime.controller, clock, "controller", &self.config.realtime_file());
        if self.child.announced() == Announced::All {
            tell(format_args!("controller: waits for the plant on instance `{}`", self.instance.instance));
        }
        let run = run_controller(
            &mut driver,
            &mut cycles,
            &mut setpoints,
            &mut queue,
            &mut recorder,
            realtime.hold_after_misses,
        );
        let requests = queue.close(&mut recorder);
        drop(recorder);
        let recorded = recorder_thread.finish();
        let run = run.map_err(CliError::new)?;

        let summary = ControllerSummary {
            ticks: run.ticks,
            half_steps: run.half_steps,
            mode: run.mode.map_or(String::new(), |mode| mode.text().to_owned()),
            fault: run.fault.map(|latched| FaultSummary::new(&latched, run.fault_cleared)),
            requests,
            deadline_misses: run.missed,
            timing: (clock == Clock::Realtime).then_some(run.timing),
            setpoint_hash: (clock == Clock::Lockstep).then(|| run.setpoints.to_string()),
            log_gaps: recorded.lost,
            record_error: recorded.error.map(|error| error.to_string()),
        };
        print(json, &summary)?;
        let is_recorded = summary.record_error.is_none();
        Ok(Status::success_if(!run.is_faulted() && is_recorded))
    }

    /// Where to record to, if anywhere, and what the run begins with.
    fn recorded(
        &self,
        files: &ConfigFiles,
        rate: Rate,
        fingerprint: u64,
    ) -> Result<Option<(&Path, Provenance)>, CliError> {
        let Some(folder) = self.child.out.as_deref() else { return Ok(None) };
        let how = Metadata::new("controller", self.runs.words(&self.instance, rate, fingerprint));
        Ok(Some((folder, Provenance { metadata: vec![how], files: files.texts(CONTROLLER, None)? })))
    }
}
