//! What an operator asks of the gait, and what is granted.

use std::fmt;

use crate::Limits;

/// What an operator asks; absent means "as it is". The set is granted or refused as one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Request {
    /// `α`: by how much a full step turns the walk [rad], positive to the left.
    pub turn: Option<f64>,
    /// `c`: speed factor, 1 is the nominal's.
    pub speed: Option<f64>,
    /// `β`: step extension [rad].
    pub extension: Option<f64>,
}

/// What is in force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command {
    /// `α`: by how much a full step turns the walk [rad], positive to the left.
    pub turn: f64,
    /// `c`: speed factor.
    pub speed: f64,
    /// `β`: step extension [rad].
    pub extension: f64,
}

/// The answer to a request.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Admission {
    /// In one word.
    pub verdict: Verdict,
    /// Why something was not granted as asked: turn, speed, extension in this order.
    pub reasons: [Option<Reason>; 3],
    /// What is in force from now on; after a refusal, what was.
    pub granted: Command,
    /// Index of the half-step at which the last of the changes takes effect; the present one if nothing changes.
    pub effect_half_step: u64,
}

/// The answer in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// As asked.
    Accepted,
    /// As near to what was asked as the limits allow.
    Limited,
    /// Nothing changes.
    Refused,
}

/// What can be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// `α`
    Turn,
    /// `c`
    Speed,
    /// `β`
    Extension,
}

/// Why a value was not granted as asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// NaN or infinite.
    NotFinite(Quantity),
    /// Less than the limit, which is granted instead.
    BelowMin {
        /// What was asked for.
        quantity: Quantity,
        /// How much was asked for [rad, or a factor].
        asked: f64,
        /// The limit.
        min: f64,
    },
    /// More than the limit, which is granted instead.
    AboveMax {
        /// What was asked for.
        quantity: Quantity,
        /// How much was asked for [rad, or a factor].
        asked: f64,
        /// The limit.
        max: f64,
    },
}

impl Command {
    /// Straight on, at the nominal's speed and step length.
    pub const NOMINAL: Command = Command { turn: 0.0, speed: 1.0, extension: 0.0 };
}

impl From<Command> for Request {
    /// Asks for all of it.
    fn from(command: Command) -> Self {
        Self { turn: Some(command.turn), speed: Some(command.speed), extension: Some(command.extension) }
    }
}

impl Admission {
    /// The first reason, if anything was not granted as asked.
    pub fn reason(&self) -> Option<Reason> {
        self.reasons.iter().flatten().next().copied()
    }
}

impl Request {
    /// What of it is granted when `in_force` was until now. Says nothing yet about when.
    pub(crate) fn grant(&self, limits: &Limits, in_force: Command) -> (Verdict, [Option<Reason>; 3], Command) {
        let (turn, turn_reason) = limits.grant(Quantity::Turn, self.turn, in_force.turn);
        let (speed, speed_reason) = limits.grant(Quantity::Speed, self.speed, in_force.speed);
        let (extension, extension_reason) = limits.grant(Quantity::Extension, self.extension, in_force.extension);
        let reasons = [turn_reason, speed_reason, extension_reason];
        let refusals = reasons.map(|reason| reason.filter(|reason| matches!(reason, Reason::NotFinite(_))));
        if refusals != [None; 3] {
            (Verdict::Refused, refusals, in_force)
        } else {
            let verdict = if reasons == [None; 3] { Verdict::Accepted } else { Verdict::Limited };
            (verdict, reasons, Command { turn, speed, extension })
        }
    }
}

impl Limits {
    /// Least and greatest value of a quantity.
    pub fn bounds(&self, quantity: Quantity) -> (f64, f64) {
        match quantity {
            Quantity::Turn => (-self.turn_max, self.turn_max),
            Quantity::Speed => (self.speed_min, self.speed_max),
            Quantity::Extension => (self.extension_min, self.extension_max),
        }
    }

    /// The value inside that is nearest to the one asked for, and why it is another.
    fn grant(&self, quantity: Quantity, asked: Option<f64>, in_force: f64) -> (f64, Option<Reason>) {
        let Some(asked) = asked else {
            return (in_force, None);
        };
        let (min, max) = self.bounds(quantity);
        if !asked.is_finite() {
            (asked, Some(Reason::NotFinite(quantity)))
        } else if asked < min {
            (min, Some(Reason::BelowMin { quantity, asked, min }))
        } else if asked > max {
            (max, Some(Reason::AboveMax { quantity, asked, max }))
        } else {
            (asked, None)
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Quantity::Turn => "turn",
            Quantity::Speed => "speed",
            Quantity::Extension => "extension",
        })
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match *self {
            Reason::NotFinite(quantity) => write!(f, "{quantity} must be a finite number"),
            Reason::BelowMin { quantity, asked, min } => {
                write!(f, "{quantity} {} is below the least, {}", quantity.text(asked), quantity.text(min))
            }
            Reason::AboveMax { quantity, asked, max } => {
                write!(f, "{quantity} {} is above the greatest, {}", quantity.text(asked), quantity.text(max))
            }
        }
    }
}

impl Quantity {
    /// A value for people.
    fn text(self, value: f64) -> String {
        match self {
            Quantity::Speed => format!("{value:.2}"),
            Quantity::Turn | Quantity::Extension => format!("{:.1}°", value.to_degrees()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_outside_is_limited_and_named() {
        let request = Request { turn: Some(-1.0), speed: Some(2.0), extension: None };
        let (verdict, reasons, granted) = request.grant(&Limits::default(), Command::NOMINAL);
        assert_eq!(verdict, Verdict::Limited);
        assert_eq!(granted, Command { turn: -30_f64.to_radians(), speed: 1.4, extension: 0.0 });
        let texts: Vec<_> = reasons.iter().flatten().map(Reason::to_string).collect();
        assert_eq!(texts, ["turn -57.3° is below the least, -30.0°", "speed 2.00 is above the greatest, 1.40"]);
    }

    #[test]
    fn one_bad_value_refuses_the_whole_set() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let request = Request { turn: Some(0.1), speed: Some(bad), extension: Some(9.0) };
            let (verdict, reasons, granted) = request.grant(&Limits::default(), Command::NOMINAL);
            assert_eq!((verdict, granted), (Verdict::Refused, Command::NOMINAL));
            assert_eq!(reasons, [None, Some(Reason::NotFinite(Quantity::Speed)), None]);
        }
    }
}
