//! What can be wrong with a message.

use interface::PLACES_MAX;
use model::{Joint, JointVector, PerJoint};

/// Why a message is refused. `Copy`, so that it can travel through a journal.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MessageFault {
    /// A number is NaN or infinite.
    #[error("{message}: {field} is {value}; it must be finite")]
    NotFinite {
        /// Which message.
        message: &'static str,
        /// Which field of it.
        field: &'static str,
        /// What stands there.
        value: f64,
    },
    /// A number is below 0.
    #[error("{message}: {field} is {value}; it must be at least 0")]
    Negative {
        /// Which message.
        message: &'static str,
        /// Which field of it.
        field: &'static str,
        /// What stands there.
        value: f64,
    },
    /// The number of a joint is NaN or infinite.
    #[error("{message}: {field} of joint {} ({}) is {value}; it must be finite", joint.number(), joint.name())]
    JointNotFinite {
        /// Which message.
        message: &'static str,
        /// Which field of it.
        field: &'static str,
        /// Whose value it is.
        joint: Joint,
        /// What stands there.
        value: f64,
    },
    /// A number of a way-point or footstep is NaN or infinite.
    #[error("{message}: place {place}: {field} is {value}; it must be finite")]
    PlaceNotFinite {
        /// Which message.
        message: &'static str,
        /// Which place of its destination, counted from 1.
        place: u32,
        /// Which of the place's numbers.
        field: &'static str,
        /// What stands there.
        value: f64,
    },
    /// A destination without places, or with too many.
    #[error("{message}: place_count is {value}; there must be 1 to {PLACES_MAX} places")]
    PlaceCount {
        /// Which message.
        message: &'static str,
        /// What stands there.
        value: u32,
    },
    /// A code that means nothing.
    #[error("{message}: {field} is {value}; known are {known}")]
    UnknownCode {
        /// Which message.
        message: &'static str,
        /// Which field of it.
        field: &'static str,
        /// What stands there.
        value: u32,
        /// The codes that mean something, as text.
        known: &'static str,
    },
}

/// Checks the fields of one kind of message.
pub(crate) struct Check(pub &'static str);

impl Check {
    pub(super) fn number(&self, field: &'static str, value: f64) -> Result<f64, MessageFault> {
        if value.is_finite() { Ok(value) } else { Err(MessageFault::NotFinite { message: self.0, field, value }) }
    }

    pub(super) fn not_negative(&self, field: &'static str, value: f64) -> Result<f64, MessageFault> {
        let value = self.number(field, value)?;
        if value >= 0.0 { Ok(value) } else { Err(MessageFault::Negative { message: self.0, field, value }) }
    }

    pub(super) fn numbers<const N: usize>(
        &self,
        field: &'static str,
        values: &[f64; N],
    ) -> Result<[f64; N], MessageFault> {
        match values.iter().find(|value| !value.is_finite()) {
            None => Ok(*values),
            Some(&value) => Err(MessageFault::NotFinite { message: self.0, field, value }),
        }
    }

    pub(super) fn joints(
        &self,
        field: &'static str,
        values: &[f64; Joint::COUNT],
    ) -> Result<JointVector, MessageFault> {
        let values = PerJoint(*values);
        match values.iter().find(|(_, value)| !value.is_finite()) {
            None => Ok(values),
            Some((joint, &value)) => Err(MessageFault::JointNotFinite { message: self.0, field, joint, value }),
        }
    }

    pub(super) fn code<T: interface::code::Code>(&self, field: &'static str, value: u32) -> Result<T, MessageFault> {
        T::from_code(value).ok_or(MessageFault::UnknownCode { message: self.0, field, value, known: T::KNOWN })
    }
}
