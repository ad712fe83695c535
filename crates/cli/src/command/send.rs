//! `halfstep send`: one request, and what became of it.
//!
//! It lasts until another request changes it and holds command of nothing; with `--for` it holds command for that time,
//! and then the walk comes to a stand.

use std::time::Duration;

use clap::Subcommand;
use wire::{Intent, Lasting, OperatorEnd, Request, Source, Verdict};

use super::{InstanceOption, duration, print_json, print_line};
use crate::failure::{Failure, Outcome};
use crate::words::{self, ReplyInJson};

/// Ask the running controller for something, and print its reply
#[derive(Clone, Debug, clap::Args)]
pub struct Send {
    #[command(flatten)]
    instance: InstanceOption,
    /// Keep command for this time, e.g. 5s: sources with less priority are refused, and at its end, unless something else
    /// was sent, the walk comes to a stand. Without it what is asked lasts until another request changes it
    #[arg(long = "for", value_name = "DURATION", value_parser = duration, global = true)]
    duration: Option<Duration>,
    #[command(subcommand)]
    asked: Asked,
}

#[derive(Clone, Copy, Debug, Subcommand)]
enum Asked {
    /// Turn the walk by this much per full step
    #[command(allow_negative_numbers = true)]
    Turn {
        /// Degrees, positive to the left
        degrees: f64,
    },
    /// Walk so many times as fast as the nominal
    #[command(allow_negative_numbers = true)]
    Speed {
        /// 1 is the nominal speed
        factor: f64,
    },
    /// Extend the steps
    #[command(allow_negative_numbers = true)]
    Extend {
        /// Degrees at the hips, negative for shorter steps
        degrees: f64,
    },
    /// Walk on
    Walk,
    /// Step in place, turning if a turn is asked
    InPlace,
    /// Come to a stand at the end of the half-step
    Stop,
    /// Keep the posture
    Hold,
    /// Take back a fault
    Reset,
}

/// How long the controller may take to answer.
const PATIENCE: Duration = Duration::from_secs(2);

impl Send {
    pub fn run(self, json: bool) -> Result<Outcome, Failure> {
        let request = match self.duration {
            None => self.asked.request(),
            Some(duration) => Request {
                lasting: Lasting::WhileSpeaking,
                age_limit: Some(duration.as_secs_f64()),
                ..self.asked.request()
            },
        };
        let operator = OperatorEnd::connect(&self.instance.instance()?)?;
        let reply = operator.requests.ask(&(&request).into(), PATIENCE)?.checked().map_err(Failure::new)?;
        if json {
            print_json(&ReplyInJson::from(&reply))?
        } else {
            print_line(words::reply(&request, &reply))?
        }
        Ok(Outcome::fine_if(reply.verdict != Verdict::Refused))
    }
}

impl Asked {
    fn request(self) -> Request {
        let nothing = Request::by(Source::Console);
        let intent = |intent| Request { intent: Some(intent), ..nothing };
        match self {
            Asked::Turn { degrees } => Request { turn: Some(degrees.to_radians()), ..nothing },
            Asked::Speed { factor } => Request { speed: Some(factor), ..nothing },
            Asked::Extend { degrees } => Request { extension: Some(degrees.to_radians()), ..nothing },
            Asked::Walk => intent(Intent::Walk),
            Asked::InPlace => intent(Intent::InPlace),
            Asked::Stop => intent(Intent::Stop),
            Asked::Hold => intent(Intent::Hold),
            Asked::Reset => intent(Intent::Reset),
        }
    }
}
