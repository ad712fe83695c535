//! `halfstep controller`: the process that walks.

use std::path::Path;

use ::record::{Note, Origin};
use runtime::Rate;
use wire::ControllerEnd;

use super::{InstanceOption, LoopOptions, PartOptions, print};
use crate::advisor::Advisor;
use crate::clerk::Clerk;
use crate::configuration::{CONTROLLER, ConfigOptions, Errors};
use crate::failure::{Failure, Outcome};
use crate::inbox::{CAPACITY, Inbox};
use crate::interrupt::Interrupt;
use crate::realtime;
use crate::record;
use crate::run_controller::run_controller;
use crate::summary::ControllerSummary;
use crate::turns::{Clock, Turns};

/// Run the controller alone: it waits for its plant, then walks until it is asked otherwise
#[derive(Clone, Debug, clap::Args)]
pub struct Controller {
    #[command(flatten)]
    instance: InstanceOption,
    #[command(flatten)]
    config: ConfigOptions,
    #[command(flatten)]
    runs: LoopOptions,
    #[command(flatten)]
    part: PartOptions,
}

/// How far the threads beside the loop are below it in priority: above every ordinary thread, or requests would wait for
/// whatever else the machine does; and a forecast takes long beside carrying a letter.
const CLERK_BELOW: u8 = 1;
const ADVISOR_BELOW: u8 = 2;

impl Controller {
    pub fn run(self, json: bool) -> Result<Outcome, Failure> {
        self.part.bind()?;
        let interrupt = Interrupt::listen()?;

        let mut errors = Errors::default();
        let loaded = self.config.robot(&mut errors).zip(self.config.controller(&mut errors));
        let loaded = loaded.zip(self.config.realtime(&mut errors));
        let ((robot, parameters), realtime) = errors.finish(loaded)?;
        let (clock, rate, fingerprint) = (self.runs.clock(), realtime.rate, robot.mechanism.fingerprint);
        let mut controller = robot.controller(parameters, clock, self.runs.from_stand)?;

        let ControllerEnd { mut setpoints, measurements, requests, reports } =
            ControllerEnd::connect(&self.instance.at_rate(rate)?, fingerprint)?;
        let mut turns = Turns::new(realtime.pace(clock), measurements, "plant", self.runs.ticks(rate), interrupt);
        let mut inbox = Inbox::new(Clerk::new(requests, clock, CAPACITY, realtime.controller.below(CLERK_BELOW))?);
        let mut advisor = Advisor::new(clock, realtime.controller.below(ADVISOR_BELOW));
        // Who answers may run wherever there is room; who writes down has time.
        realtime.keep_off_the_loop(clock);
        let (mut record, record_end) = record::of_controller(clock, rate, self.recorded(rate, fingerprint)?, reports)?;

        // Last: the other threads are not to keep to the loop's core.
        let _granted = realtime::enter(&realtime.controller, clock, "controller");
        let run = run_controller(
            &mut controller,
            &mut turns,
            &mut setpoints,
            &mut inbox,
            &mut advisor,
            &mut record,
            realtime.hold_after_misses,
        );
        let requests = inbox.close(&mut record);
        drop(record);
        let log_gaps = record_end.finish()?;
        let run = run.map_err(Failure::new)?;

        let summary = ControllerSummary {
            ticks: run.ticks,
            half_steps: run.half_steps,
            mode: run.mode.map_or(String::new(), |mode| crate::exchange::report::mode(mode).text().to_owned()),
            requests,
            deadline_misses: run.missed,
            kept_time: (clock == Clock::Realtime).then_some(run.kept_time),
            log_gaps,
        };
        print(json, &summary)?;
        Ok(Outcome::fine_if(run.mode != Some(controller::Mode::Fallen)))
    }

    /// Where to record to, if anywhere, and what the run begins with.
    fn recorded(&self, rate: Rate, fingerprint: u64) -> Result<Option<(&Path, Origin)>, Failure> {
        let Some(folder) = self.part.out.as_deref() else { return Ok(None) };
        let how = Note::new("controller", self.runs.words(&self.instance, rate, fingerprint));
        Ok(Some((folder, Origin { notes: vec![how], files: self.config.texts(CONTROLLER)? })))
    }
}
