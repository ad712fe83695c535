//! A robot that was pushed over, is put on its feet, reset, and asked to walk.

use std::convert::Infallible;

use interface::{Intent, Measurement, Mode, Reason, Request, Setpoint, Source, Verdict};
use model::{Joint, Mechanism, Motion};
use nalgebra::Vector3;
use plant::{Obedience, Plant, Push};

use crate::walking::{PERIOD, Walking, controller_parameters, standing};

/// How the robot falls, and how it is put on its feet.
#[derive(Clone, Copy, Debug)]
pub struct FallTrial {
    /// Seed of the sensors' noise.
    pub seed: u64,
    /// When it is pushed (s).
    pub pushed_at: f64,
    /// Where it is pushed to, from ahead to the left (rad).
    pub towards: f64,
    /// How long it lies there (s).
    pub lies_for: f64,
    /// How long it is held in a stand before the reset (s).
    pub held_for: f64,
    /// Joints that are not as in a stand when it is put down, and by how much (rad).
    pub bent: &'static [(Joint, f64)],
    /// Whether it is another robot, whose samples are counted from the start.
    pub is_other: bool,
}

/// What becomes of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AfterReset {
    /// The push did not fell it.
    DidNotFall,
    /// The reset was refused.
    Refused(Reason),
    /// It fell again so long after the reset (s).
    FellAgain(f64),
    /// It does not stand, walk or come to a stand again when it should, but is in this mode.
    Stuck(Mode),
    /// It stood, walked, and came to a stand again.
    Walks,
}

/// The push (N·s), which nobody survives, and how long it lasts (s).
const PUSH: [f64; 2] = [90.0, 0.1];
/// How long each act may take (s): the fall; then recovery, walk and stop.
const FALLS_WITHIN: f64 = 6.0;
type Act = (Option<Intent>, Mode, f64);
const ACTS: [Act; 3] =
    [(None, Mode::Standing, 4.0), (Some(Intent::Walk), Mode::Walking, 4.0), (Some(Intent::Stop), Mode::Standing, 3.0)];

impl FallTrial {
    /// Runs the trial with the plant's own physics.
    pub fn run(&self) -> AfterReset {
        let mut walking = Walking::begin(self.seed);
        walking.plant.disturbances.pushes.push(self.push());
        self.run_in(walking, Plant::step, |_, _| ())
    }

    /// The push that fells it.
    pub fn push(&self) -> Push {
        let impulse = Vector3::new(self.towards.cos(), self.towards.sin(), 0.0) * PUSH[0];
        Push { link: Mechanism::TRUNK, impulse, start: self.pushed_at, duration: PUSH[1] }
    }

    /// The same with a robot that gets the push, and other physics: `step` moves the robot on by a period, `place` puts
    /// it on its feet.
    pub fn run_in(
        &self,
        mut walking: Walking,
        mut step: impl FnMut(&mut Plant, &Setpoint) -> Measurement,
        place: impl FnOnce(&Plant, &Motion),
    ) -> AfterReset {
        let ask = |intent| Request { intent: Some(intent), ..Request::new(Source::Console) };
        let lies = |walking: &Walking, mode| mode == Mode::Fallen && walking.plant.truth().has_fallen();
        let mut mode = Mode::Walking;
        while !lies(&walking, mode) {
            if walking.time() > self.pushed_at + FALLS_WITHIN {
                return AfterReset::DidNotFall;
            }
            mode = walking.tick_in(None, &mut step).report.mode;
        }
        for _ in 0..ticks(self.lies_for) {
            walking.tick_in(None, &mut step);
        }

        let mut stand = standing(&crate::mechanism(), &controller_parameters());
        self.bent.iter().for_each(|(joint, angle)| stand.angles[*joint] += angle);
        walking.plant.place(&stand);
        place(&walking.plant, &stand);
        let counted_from = if self.is_other { walking.measurement.sample } else { 0 };
        if self.is_other {
            // Nothing comes from one that is gone.
            for _ in 0..ticks(0.5) {
                walking.driver.step(PERIOD, None, |_| None);
            }
        }
        let mut obedience = Obedience::of(&walking.plant);
        let mut pass = |plant: &mut Plant, setpoint: &Setpoint| {
            obedience.hear(setpoint);
            let measured = obedience.obey(plant, |plant, setpoint| Ok::<_, Infallible>(step(plant, setpoint)));
            let Ok(measured) = measured;
            Measurement { sample: measured.sample.saturating_sub(counted_from), ..measured }
        };
        for _ in 0..ticks(self.held_for) {
            walking.tick_in(None, &mut pass);
        }
        let reset = walking.time();
        let reply = walking.tick_in(Some(&ask(Intent::Reset)), &mut pass).reply.expect("a reset is replied to at once");
        if reply.verdict != Verdict::Accepted {
            return AfterReset::Refused(reply.reason);
        }
        for (intent, wanted, seconds) in ACTS {
            let mut request = intent.map(ask);
            for _ in 0..ticks(seconds) {
                mode = walking.tick_in(request.take().as_ref(), &mut pass).report.mode;
                if mode == Mode::Fallen || walking.plant.truth().has_fallen() {
                    return AfterReset::FellAgain(walking.time() - reset);
                }
            }
            if mode != wanted {
                return AfterReset::Stuck(mode);
            }
        }
        AfterReset::Walks
    }
}

fn ticks(seconds: f64) -> u64 {
    (seconds / PERIOD).round() as u64
}
