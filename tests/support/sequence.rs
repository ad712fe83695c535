//! Random sequences of what an operator may do: change the walk, stop it, hold it, start it again, take a stop back.

use controller::Tick;
use gait::Limits;
use interface::{GaitChange, Intent, Mode, Verdict};
use rand::{Rng, rngs::StdRng};

use crate::walking::Walking;

/// Longest time from an intended stop to a stand (s): the half-step that is on, a calm one at the slowest speed, and as
/// much again.
pub const TO_STAND_MAX: f64 = 4.5;
/// Longest time from an intended start to the next half-step (s): the weight shifts, and a half-step is made.
pub const TO_WALK_MAX: f64 = 4.5;

/// What a sequence did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// Stops that led to a stand.
    pub stops: u32,
    /// Starts that led to walking.
    pub starts: u32,
    /// Changes of the walk while it walked, stopped or stood.
    pub changes: u32,
    /// Longest time from the intention to a stand (s).
    pub slowest_stop: f64,
    /// Longest time from the intention to the end of the first half-step (s).
    pub slowest_start: f64,
    /// Walked and stood time (s).
    pub seconds: f64,
}

/// What went wrong in a sequence.
#[derive(Clone, Debug, PartialEq)]
pub struct Trouble {
    /// Whether the robot fell; otherwise a mode was stuck.
    pub fell: bool,
    /// Since the beginning (s).
    pub time: f64,
    /// What was going on.
    pub what: String,
}

/// Plays so many random acts, with changes drawn from `limits`; the robot begins in stride.
///
/// # Errors
/// The first trouble.
pub fn play(walking: &mut Walking, random: &mut StdRng, limits: &Limits, acts: u32) -> Result<Tally, Trouble> {
    let mut sequence = Sequence { walking, random, limits, tally: Tally::default() };
    let mut stands = false;
    for _ in 0..acts {
        stands = if stands { sequence.while_standing()? } else { sequence.while_walking()? };
    }
    Ok(Tally { seconds: sequence.walking.time(), ..sequence.tally })
}

struct Sequence<'a> {
    walking: &'a mut Walking,
    random: &'a mut StdRng,
    limits: &'a Limits,
    tally: Tally,
}

impl Sequence<'_> {
    /// Changes the walk, stops it, or stops it and takes that back at once; says whether the robot stands then.
    fn while_walking(&mut self) -> Result<bool, Trouble> {
        match self.random.random_range(0..9) {
            0..6 => {
                // Now and then on in place, now and then on from there.
                let intent = [Some(Intent::InPlace), Some(Intent::Walk), None][self.random.random_range(0..3)];
                let what = self.change(intent)?;
                self.wait(0.4, 3.0, &what)?;
                Ok(false)
            }
            6..8 => self.stop().map(|()| true),
            _ => {
                let intent = self.any_stop();
                self.ask(GaitChange::default(), Some(intent), "a stop to be taken back")?;
                self.wait(0.0, 1.2, "stopping, to be taken back")?;
                self.start().map(|()| false)
            }
        }
    }

    /// Goes on standing, changes what is to come, or starts; says whether the robot still stands.
    fn while_standing(&mut self) -> Result<bool, Trouble> {
        match self.random.random_range(0..4) {
            0 => {
                // Standing is no walking: the change says nothing of whether to go.
                let hold = Some(Intent::Hold);
                self.change(hold)?;
                self.wait(0.2, 2.0, "a stand")?;
                Ok(true)
            }
            _ => self.start().map(|()| false),
        }
    }

    fn stop(&mut self) -> Result<(), Trouble> {
        let intent = self.any_stop();
        self.ask(GaitChange::default(), Some(intent), "a stop")?;
        let began = self.walking.time();
        self.until(TO_STAND_MAX, &format!("{intent:?}, not standing yet"), |report| {
            matches!(report.report.mode, Mode::Standing | Mode::Holding)
        })?;
        self.tally.stops += 1;
        self.tally.slowest_stop = self.tally.slowest_stop.max(self.walking.time() - began);
        self.wait(0.0, 3.0, "standing")
    }

    fn start(&mut self) -> Result<(), Trouble> {
        let in_place = self.random.random_range(0..4) == 0;
        let (intent, mode) = if in_place { (Intent::InPlace, Mode::InPlace) } else { (Intent::Walk, Mode::Walking) };
        let mut report = self.ask(GaitChange::default(), Some(intent), "a start")?;
        if report.reply.is_some_and(|reply| reply.verdict == Verdict::Refused) {
            // A stop that cannot be taken back in stride: from the stand to which it leads the robot starts.
            self.until(TO_STAND_MAX, "refused to start, not standing yet", |report| {
                matches!(report.report.mode, Mode::Standing | Mode::Holding)
            })?;
            report = self.ask(GaitChange::default(), Some(intent), "a start from the stand")?;
        }
        let (began, stood_in) = (self.walking.time(), report.report.half_step.index);
        // A stop that was too late to take back ends in a stand first.
        let patience = TO_STAND_MAX + TO_WALK_MAX;
        self.until(patience, &format!("started to {intent:?}, not there yet"), |report| {
            report.report.mode == mode && report.report.half_step.index > stood_in
        })?;
        self.tally.starts += 1;
        self.tally.slowest_start = self.tally.slowest_start.max(self.walking.time() - began);
        self.wait(0.0, 2.0, "walking after a start")
    }

    /// Changes one or all of the four quantities and says how.
    fn change(&mut self, intent: Option<Intent>) -> Result<String, Trouble> {
        let Limits { turn_max, speed_min, speed_max, extension_min, extension_max, sidestep_max } = *self.limits;
        let turn = self.random.random_range(-turn_max..=turn_max);
        let speed = self.random.random_range(speed_min..=speed_max);
        let extension = self.random.random_range(extension_min..=extension_max);
        let sidestep = self.random.random_range(-sidestep_max..=sidestep_max);
        let all =
            GaitChange { turn: Some(turn), speed: Some(speed), extension: Some(extension), sidestep: Some(sidestep) };
        let request = match self.random.random_range(0..6) {
            0 => GaitChange { turn: all.turn, ..GaitChange::default() },
            1 | 2 => GaitChange { speed: all.speed, ..GaitChange::default() },
            3 => GaitChange { extension: all.extension, ..GaitChange::default() },
            4 => GaitChange { sidestep: all.sidestep, ..GaitChange::default() },
            _ => all,
        };
        let what = format!("asked for {request:.3?}");
        self.ask(request, intent, &what)?;
        self.tally.changes += 1;
        Ok(what)
    }

    fn any_stop(&mut self) -> Intent {
        if self.random.random_range(0..2) == 0 { Intent::Stop } else { Intent::Hold }
    }

    fn ask(&mut self, request: GaitChange, intent: Option<Intent>, what: &str) -> Result<Tick, Trouble> {
        let report = self.walking.ask(request, intent);
        if self.walking.has_fallen(&report) { Err(self.trouble(&report, what)) } else { Ok(report) }
    }

    /// Lets a random time between two pass.
    fn wait(&mut self, least: f64, most: f64, what: &str) -> Result<(), Trouble> {
        let end = self.walking.time() + self.random.random_range(least..=most);
        while self.walking.time() < end {
            let report = self.walking.tick(None);
            if self.walking.has_fallen(&report) {
                return Err(self.trouble(&report, what));
            }
        }
        Ok(())
    }

    fn until(&mut self, seconds: f64, what: &str, reached: impl FnMut(&Tick) -> bool) -> Result<(), Trouble> {
        self.walking.walk_until(seconds, reached).map(drop).map_err(|report| self.trouble(&report, what))
    }

    fn trouble(&self, report: &Tick, what: &str) -> Trouble {
        let interface::Command { turn, speed, extension, sidestep } = report.command;
        let [turn, extension, sidestep] = [turn, extension, sidestep].map(f64::to_degrees);
        let place = report.report.half_step.index as f64 + report.report.half_step.progress;
        Trouble {
            fell: self.walking.has_fallen(report),
            time: self.walking.time(),
            what: format!(
                "{:?} in half-step {place:.2} by c {speed:.2} α {turn:.1}° β {extension:.1}° γ {sidestep:.1}°: {what}",
                report.report.mode
            ),
        }
    }
}
