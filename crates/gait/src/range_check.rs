//! The configured range of the gait parameters: what of a requested change it admits.

use std::fmt;

use interface::{ActiveLimit, Command, GaitChange, Objection, Reason, Verdict};

use crate::Limits;

/// What became of a requested change of gait parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeCheck {
    /// Granted as requested, in part, or not at all.
    pub verdict: Verdict,
    /// Why it was not granted as requested: the first parameter that was not, in the order turn, speed, extension,
    /// sidestep.
    pub objection: Option<Objection>,
    /// The parameters in force from now on; after a refusal, those in force before.
    pub granted: Command,
    /// Index of the half-step at which the last of the changes takes effect; the present one if nothing changes.
    pub effect_half_step: u64,
}

/// A gait parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// `α`, the change of heading per full step.
    Turn,
    /// `c`, the speed.
    Speed,
    /// `β`, the step extension.
    Extension,
    /// `γ`, the sidestep.
    Sidestep,
}

impl Limits {
    /// Least and greatest value of a parameter.
    pub fn bounds(&self, quantity: Quantity) -> (f64, f64) {
        match quantity {
            Quantity::Turn => (-self.turn_max, self.turn_max),
            Quantity::Speed => (self.speed_min, self.speed_max),
            Quantity::Extension => (self.extension_min, self.extension_max),
            Quantity::Sidestep => (-self.sidestep_max, self.sidestep_max),
        }
    }

    /// What of a change is granted while `in_force` holds; the caller adds when it takes effect. One value that is not
    /// finite refuses the whole set.
    pub(crate) fn admit(&self, change: &GaitChange, in_force: Command) -> (Verdict, Option<Objection>, Command) {
        let (turn, turn_objection) = self.nearest(Quantity::Turn, change.turn, in_force.turn);
        let (speed, speed_objection) = self.nearest(Quantity::Speed, change.speed, in_force.speed);
        let (extension, extension_objection) = self.nearest(Quantity::Extension, change.extension, in_force.extension);
        let (sidestep, sidestep_objection) = self.nearest(Quantity::Sidestep, change.sidestep, in_force.sidestep);
        let objections = [turn_objection, speed_objection, extension_objection, sidestep_objection];
        let mut objections = objections.into_iter().flatten();
        let refusal = objections.clone().find(|objection| objection.reason == Reason::NotFinite);
        if refusal.is_some() {
            return (Verdict::Refused, refusal, in_force);
        }
        let objection = objections.next();
        let verdict = if objection.is_none() { Verdict::Accepted } else { Verdict::Limited };
        (verdict, objection, Command { turn, speed, extension, sidestep })
    }

    /// The permitted value nearest to the requested one, and the objection if it differs.
    fn nearest(&self, quantity: Quantity, requested: Option<f64>, in_force: f64) -> (f64, Option<Objection>) {
        let Some(requested) = requested else {
            return (in_force, None);
        };
        let (min, max) = self.bounds(quantity);
        let limited = |limit: f64| {
            let active_limit = Some(ActiveLimit { joint: None, value: requested, limit });
            (limit, Some(Objection { reason: quantity.limit_reason(), active_limit }))
        };
        if !requested.is_finite() {
            (requested, Some(Objection { reason: Reason::NotFinite, active_limit: None }))
        } else if requested < min {
            limited(min)
        } else if requested > max {
            limited(max)
        } else {
            (requested, None)
        }
    }
}

impl Quantity {
    /// The reason for limiting this parameter.
    const fn limit_reason(self) -> Reason {
        match self {
            Quantity::Turn => Reason::TurnLimit,
            Quantity::Speed => Reason::SpeedLimit,
            Quantity::Extension => Reason::ExtensionLimit,
            Quantity::Sidestep => Reason::SidestepLimit,
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Quantity::Turn => "turn",
            Quantity::Speed => "speed",
            Quantity::Extension => "extension",
            Quantity::Sidestep => "sidestep",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Limits = Limits {
        turn_max: 0.5,
        speed_min: 0.6,
        speed_max: 1.4,
        extension_min: -0.1,
        extension_max: 0.2,
        sidestep_max: 0.3,
    };

    #[test]
    fn values_outside_the_range_are_limited_and_the_first_is_named() {
        let change = GaitChange { turn: Some(-1.0), speed: Some(2.0), ..GaitChange::NONE };
        let (verdict, objection, granted) = LIMITS.admit(&change, Command::NOMINAL);
        assert_eq!(verdict, Verdict::Limited);
        assert_eq!(granted, Command { turn: -0.5, speed: 1.4, ..Command::NOMINAL });
        let active_limit = Some(ActiveLimit { joint: None, value: -1.0, limit: -0.5 });
        assert_eq!(objection, Some(Objection { reason: Reason::TurnLimit, active_limit }));
    }

    #[test]
    fn one_value_that_is_not_finite_refuses_the_whole_set() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let change = GaitChange { turn: Some(0.1), speed: Some(bad), extension: Some(9.0), sidestep: None };
            let (verdict, objection, granted) = LIMITS.admit(&change, Command::NOMINAL);
            assert_eq!((verdict, granted), (Verdict::Refused, Command::NOMINAL));
            assert_eq!(objection, Some(Objection { reason: Reason::NotFinite, active_limit: None }));
        }
    }
}
