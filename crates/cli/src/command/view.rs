//! `halfstep view`: a page on which the robot is seen and driven.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::PathBuf;
use std::time::Duration;

use config::Config;
use model::Mechanism;
use node::configuration::Errors;
use node::cycle::Clock;
use node::interrupt::Interrupt;
use node::tell::tell;
use robots::ROBOTS;
use serde::Serialize;
use view::{RecordedRun, RunningRobot, Shown, ViewServer};

use super::config_options::ConfigOptions;
use super::options::{InstanceOption, command_timeout};
use crate::error::CliError;
use crate::output::print;
use crate::process::end_with_parent;
use crate::status::Status;

/// Show a robot in the browser, live with means to drive it, or from recordings
///
/// Prints the address of a page and serves it until Ctrl-C. Without RUN it shows the robot of the instance as soon as
/// one is running; one page at a time drives, any page may stop. A page that is closed or cut off while it drives falls
/// silent, and the robot stops. With RUN it plays the recording, with two the one over the other.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ViewArgs {
    /// Recordings to play, or folders of runs; two are drawn over each other
    #[arg(value_name = "RUN", num_args = 0..=2, conflicts_with_all = ["instance", "age_limit"])]
    runs: Vec<PathBuf>,
    #[command(flatten)]
    instance: InstanceOption,
    #[command(flatten)]
    config: ConfigOptions,
    /// Address of the page; port 0 takes any that is free. On another address than the loopback everyone in the network
    /// who knows the token can look on and drive, and nothing is encrypted
    #[arg(long, value_name = "ADDRESS:PORT", default_value_t = LOOPBACK)]
    listen: SocketAddr,
    /// Command timeout: the robot stops when the page that drives is silent for this long, e.g. 500ms [default: the
    /// controller's own, config/controller.toml; none in lockstep]
    #[arg(long, value_name = "DURATION", value_parser = command_timeout, allow_hyphen_values = true)]
    age_limit: Option<Duration>,
    /// Parent process: this one ends when it does
    #[arg(long, value_name = "PID", hide = true)]
    parent: Option<u32>,
}

/// The default address.
const LOOPBACK: SocketAddr = SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), 8720);

/// What is printed once the page can be opened.
#[derive(Debug, Serialize)]
struct PageAddress {
    url: String,
}

impl ViewArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        self.parent.map_or(Ok(()), end_with_parent)?;
        let interrupt = Interrupt::listen()?;
        let shown = if self.runs.is_empty() { self.live()? } else { self.recorded()? };
        let server = ViewServer::bind(self.address())?;
        if !server.is_local() {
            tell(format_args!(
                "{} is not of this computer alone: everyone in the network who knows the token can look on and drive, \
                 and nothing is encrypted",
                self.listen
            ));
        }
        let page = PageAddress { url: server.url() };
        match self.parent {
            Some(_) => tell(format_args!("view: open {}", page.url)),
            None => print(json, &page)?,
        }
        server.serve(shown, || interrupt.is_raised())?;
        Ok(Status::Success)
    }

    /// The address to listen on: beside a walk any port will do, since several may run.
    fn address(&self) -> SocketAddr {
        match self.parent {
            Some(_) if self.listen == LOOPBACK => SocketAddr::new(LOOPBACK.ip(), 0),
            _ => self.listen,
        }
    }

    /// The robot of the instance, whichever it is: that of the configuration, or one in the box.
    fn live(&self) -> Result<Shown, CliError> {
        let mut config = self.config.clone();
        config.resolve()?;
        let mut errors = Errors::default();
        let files = config.files();
        let loaded = files.mechanism(&mut errors).zip(files.realtime(&mut errors));
        let (robot, realtime) = errors.finish(loaded)?;
        // The robot's clock may be either; in lockstep nothing waits for this process.
        realtime.keep_off_the_loop(Clock::Realtime);
        let mut robots = vec![robot];
        for robot in ROBOTS {
            robots.push(Mechanism::from_toml(robot.mechanism_text(), robot.name).map_err(CliError::bad_input)?);
        }
        let (instance, age_limit) = (self.instance.instance()?, self.age_limit);
        Ok(Shown::Live(Box::new(RunningRobot { instance, robots, age_limit })))
    }

    fn recorded(&self) -> Result<Shown, CliError> {
        let runs = self.runs.iter().map(|run| Ok(RecordedRun::read(run)?)).collect::<Result<Vec<_>, CliError>>()?;
        runs.iter().filter_map(|run| run.cut.as_ref()).for_each(tell);
        Ok(Shown::Recorded(runs))
    }
}

impl std::fmt::Display for PageAddress {
    fn fmt(&self, out: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(out, "open {} (Ctrl-C ends)", self.url)
    }
}
