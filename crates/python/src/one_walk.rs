//! One walk, with what its controller returned last and the replies that nobody has taken.

use controller::{RequestAnswer, RequestId, Tick};
use dialogue::reply_text::{ReplyJson, reply_text};
use dialogue::script::{Reader, ScriptError};
use interface::{PushRequest, Request, Verdict};
use lockstep::LockstepWalk;
use model::Joint;
use nalgebra::Vector3;
use pyo3::PyResult;
use serde_json::json;

use crate::columns::write_row;
use crate::failure::{bad_input, unstable};

/// One walk.
#[derive(Clone, Debug)]
pub(crate) struct OneWalk {
    pub(crate) walk: LockstepWalk,
    last: Option<Box<Tick>>,
    /// The request that waits for its reply.
    asked: Option<(RequestId, Request)>,
    /// The reply to the newest request.
    reply: Option<interface::Reply>,
}

impl OneWalk {
    pub(crate) fn new(walk: LockstepWalk) -> Self {
        Self { walk, last: None, asked: None, reply: None }
    }

    /// Walks on by one period.
    pub(crate) fn step(&mut self) {
        let Self { walk, asked, reply, last } = self;
        let mut take = |answer: RequestAnswer| {
            if asked.is_some_and(|(id, _)| id == answer.id) {
                *reply = Some(answer.reply);
            }
        };
        *last = Some(Box::new(walk.step(&mut take)));
    }

    /// Walks on by so many periods.
    ///
    /// # Errors
    /// The simulation has become unstable.
    pub(crate) fn steps(&mut self, count: u64) -> Result<(), String> {
        (0..count).for_each(|_| self.step());
        self.walk.instability().map_or(Ok(()), Err)
    }

    /// Asks for what a line of JSON says, from the next period on.
    pub(crate) fn ask(&mut self, line: &str) -> PyResult<()> {
        let read = Reader::new("request").read(Ok(line));
        // Examples of lines are of no use to who writes none.
        let problem = |error: ScriptError| error.problem.split("; write e.g.").next().unwrap_or_default().to_owned();
        let timed = read.ok_or_else(|| bad_input("nothing is asked for"))?;
        let timed = timed.map_err(|error| bad_input(problem(error)))?;
        let Self { walk, asked, reply, .. } = self;
        *reply = None;
        let mut superseded = None;
        let id = walk.request(&timed.request, &mut |answer| superseded = Some(answer));
        *reply = superseded.filter(|answer| answer.id == id).map(|answer| answer.reply);
        *asked = Some((id, timed.request));
        Ok(())
    }

    /// The reply to the newest request as JSON, once there is one.
    pub(crate) fn reply(&self) -> Option<String> {
        let ((_, request), reply) = self.asked.as_ref().zip(self.reply.as_ref())?;
        let mut value = json!(ReplyJson::from(reply));
        value["text"] = reply_text(request, reply).into();
        Some(value.to_string())
    }

    /// The verdict on the newest request, once there is one.
    pub(crate) fn verdict(&self) -> Option<Verdict> {
        self.reply.as_ref().map(|reply| reply.verdict)
    }

    /// Pushes a link, by its name.
    pub(crate) fn push(&mut self, impulse: [f64; 3], lasts: f64, link: Joint) -> PyResult<()> {
        let push = PushRequest { link, impulse: Vector3::from(impulse), duration: lasts };
        self.walk.push(&push).map(|_| ()).map_err(bad_input)
    }

    /// Writes the state into a row.
    pub(crate) fn write(&self, row: &mut [f64]) {
        write_row(row, self.walk.plant(), self.last.as_deref(), self.walk.measurement());
    }
}

/// The joint that carries a link.
pub(crate) fn link(name: &str) -> PyResult<Joint> {
    Joint::ALL.into_iter().find(|joint| joint.link_name() == Some(name)).ok_or_else(|| {
        let names: Vec<&str> = Joint::ALL.into_iter().filter_map(Joint::link_name).collect();
        bad_input(format!("link = \"{name}\": must be one of {}", names.join(", ")))
    })
}

/// An unstable simulation as an exception.
pub(crate) fn stable(result: Result<(), String>) -> PyResult<()> {
    result.map_err(unstable)
}
