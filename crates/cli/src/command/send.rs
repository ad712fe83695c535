//! `halfstep send`: sends one request, and prints the reply; waits for the arrival at a destination if it is asked to.
//!
//! The request stays in effect until another one changes it, and holds no authority; with `--for` it holds authority
//! for that time, after which the robot stops.

use interface::{GaitChange, Intent, Lifetime, Request, Source, Verdict, WalkVelocity};
use std::time::Duration;

use clap::Subcommand;
use dialogue::reply_text::{ReplyJson, reply_text};
use runtime::now_ns;
use wire::{Instance, OperatorPorts, ReplyMessage, UrgentClient};

use super::arrival::Arrival;
use super::connect::patiently;
use super::destination::{FootstepsArgs, GotoArgs};
use super::options::{InstanceOption, command_timeout, number};
use crate::error::CliError;
use crate::output::{print_json, print_line};
use crate::status::Status;

/// Send a request to a running controller and print the reply
#[derive(Clone, Debug, clap::Args)]
pub(super) struct SendArgs {
    #[command(flatten)]
    instance: InstanceOption,
    /// Hold control authority for this long, e.g. 5s: lower-priority sources are refused, and the robot stops when it
    /// expires unless another request has arrived [default: the request stays in effect until replaced]
    #[arg(long = "for", value_name = "DURATION", value_parser = command_timeout, global = true,
        allow_hyphen_values = true)]
    duration: Option<Duration>,
    #[command(subcommand)]
    request: RequestKind,
}

#[derive(Clone, Debug, Subcommand)]
enum RequestKind {
    /// Set the change of heading per full step
    #[command(allow_negative_numbers = true)]
    Turn {
        /// Degrees, positive to the left
        #[arg(value_parser = number)]
        degrees: f64,
    },
    /// Set the speed as a multiple of the nominal speed
    #[command(allow_negative_numbers = true)]
    Speed {
        /// 1 is the nominal speed
        #[arg(value_parser = number)]
        factor: f64,
    },
    /// Set the step extension
    #[command(allow_negative_numbers = true)]
    Extend {
        /// Degrees at the hips, negative for shorter steps, far below zero for steps backward
        #[arg(value_parser = number)]
        degrees: f64,
    },
    /// Set the sidestep per full step
    #[command(allow_negative_numbers = true)]
    Sidestep {
        /// Degrees at the hips, positive to the left
        #[arg(value_parser = number)]
        degrees: f64,
    },
    /// Walk at a velocity; 0 is a stand
    #[command(allow_negative_numbers = true)]
    Velocity {
        /// Ahead, in m/s
        #[arg(value_parser = number, value_name = "VX")]
        ahead: f64,
        /// To the left, in m/s
        #[arg(value_parser = number, value_name = "VY", default_value_t = 0.0)]
        left: f64,
        /// Turning to the left, in degrees per second
        #[arg(value_parser = number, value_name = "WZ", default_value_t = 0.0)]
        turn: f64,
    },
    Goto(GotoArgs),
    Footsteps(FootstepsArgs),
    /// Start walking, or walk on
    Walk,
    /// Step in place, turning if a turn is in effect
    InPlace,
    /// Stop with the feet side by side; takes up to two half-steps
    Stop,
    /// Stop in stride, one foot before the other
    Hold,
    /// Clear a latched fault; after a fall, return to a stand
    Reset,
}

/// How long the controller may take to begin with the request: then it expires.
const EXPIRY: Duration = Duration::from_secs(2);
/// How long the controller may take to reply: longer, so that no request is carried out that was told to have failed.
const REPLY_TIMEOUT: Duration = Duration::from_millis(2500);

impl SendArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        let request = self.request.message()?;
        let request = match self.duration {
            None => request,
            Some(duration) => {
                Request { lifetime: Lifetime::Streamed, timeout: Some(duration.as_secs_f64()), ..request }
            }
        };
        let instance = self.instance.instance()?;
        let arrival = if self.request.waits() { Some(Arrival::listen(&instance)?) } else { None };
        let request = Request { expires_ns: Some(now_ns() + EXPIRY.as_nanos() as u64), ..request };
        let reply = ask(&instance, &request)?.checked().map_err(CliError::new)?;
        let granted_ns = now_ns();
        let arrival = arrival.filter(|_| reply.verdict != Verdict::Refused);
        // One JSON value at the end; to people the reply is told at once.
        let at_end = (json && arrival.is_some()).then(|| ReplyJson::from(&reply));
        if !json {
            print_line(reply_text(&request, &reply))?;
        } else if at_end.is_none() {
            print_json(&ReplyJson::from(&reply))?;
        }
        match arrival {
            Some(arrival) => arrival.wait(granted_ns, at_end),
            None => Ok(Status::success_if(reply.verdict != Verdict::Refused)),
        }
    }
}

/// Sends a request and waits for the reply. A stop takes its own way, which nothing can block.
fn ask(instance: &Instance, request: &Request) -> Result<ReplyMessage, CliError> {
    let message = request.into();
    if request.is_stop()
        && let Ok(urgent) = UrgentClient::connect(instance)
    {
        return Ok(urgent.stop(&message, REPLY_TIMEOUT)?);
    }
    Ok(patiently(instance, || OperatorPorts::connect(instance))?.requests.ask(&message, REPLY_TIMEOUT)?)
}

impl RequestKind {
    /// Whether the end of the walk is to be waited for.
    fn waits(&self) -> bool {
        match self {
            RequestKind::Goto(goto) => goto.way().wait,
            RequestKind::Footsteps(footsteps) => footsteps.way().wait,
            _ => false,
        }
    }

    /// The request.
    ///
    /// # Errors
    /// Its file cannot be read.
    fn message(&self) -> Result<Request, CliError> {
        let nothing = Request::new(Source::Console);
        let change = |gait| Request { gait, ..nothing };
        let intent = |intent| Request { intent: Some(intent), ..nothing };
        Ok(match *self {
            RequestKind::Turn { degrees } => {
                change(GaitChange { turn: Some(degrees.to_radians()), ..GaitChange::NONE })
            }
            RequestKind::Speed { factor } => change(GaitChange { speed: Some(factor), ..GaitChange::NONE }),
            RequestKind::Extend { degrees } => {
                change(GaitChange { extension: Some(degrees.to_radians()), ..GaitChange::NONE })
            }
            RequestKind::Sidestep { degrees } => {
                change(GaitChange { sidestep: Some(degrees.to_radians()), ..GaitChange::NONE })
            }
            RequestKind::Velocity { ahead, left, turn } => {
                Request { velocity: Some(WalkVelocity { ahead, left, turn: turn.to_radians() }), ..nothing }
            }
            RequestKind::Goto(ref goto) => goto.request(),
            RequestKind::Footsteps(ref footsteps) => footsteps.request()?,
            RequestKind::Walk => intent(Intent::Walk),
            RequestKind::InPlace => intent(Intent::InPlace),
            RequestKind::Stop => intent(Intent::Stop),
            RequestKind::Hold => intent(Intent::Hold),
            RequestKind::Reset => intent(Intent::Reset),
        })
    }
}
