//! The layouts of all messages as data: what other languages lay out the same bytes from.

use iceoryx2::prelude::ZeroCopySend;

use crate::{MeasurementMessage, ReplyMessage, ReportMessage, RequestMessage, SetpointMessage};

/// How a message lies in shared memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// What it is called here, `SetpointMessage`.
    pub message: &'static str,
    /// What it is called in shared memory, `halfstep.Setpoint.v1`: it changes with the layout.
    pub type_name: &'static str,
    /// [bytes]
    pub size: usize,
    /// In their order, without gaps.
    pub fields: Vec<Field>,
}

/// A field of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// What it is called.
    pub name: &'static str,
    /// From the message's beginning [bytes].
    pub offset: usize,
    /// What kind of numbers it holds.
    pub number: Number,
    /// How many, if it is an array.
    pub count: Option<usize>,
}

/// A kind of number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    /// 32 bits, not negative.
    U32,
    /// 64 bits, not negative.
    U64,
    /// IEEE 754 double.
    F64,
}

/// A message whose fields are known by name: what stores it, or reads it from elsewhere, needs nothing else.
pub trait LaidOut: Copy {
    /// How it lies in shared memory.
    fn layout() -> Layout;

    /// Appends its bytes: the fields in their order without gaps, little-endian. Every bit of a number is kept.
    fn put(&self, bytes: &mut Vec<u8>);

    /// The message that [`put`](Self::put) gave these bytes; `None` if they are too many or too few.
    fn take(bytes: &[u8]) -> Option<Self>;
}

/// What a field may be.
pub trait FieldValue: Copy {
    /// Which kind of numbers, and how many if it is an array.
    const KIND: (Number, Option<usize>);

    /// Appends its bytes, little-endian.
    fn put(&self, bytes: &mut Vec<u8>);

    /// Takes it off the front of some bytes; `None` if they are too few.
    fn take(bytes: &mut &[u8]) -> Option<Self>;
}

/// Implements [`LaidOut`] for a `#[repr(C)]` struct without padding from its name elsewhere and the names of its fields; what
/// is not named does not compile.
#[macro_export]
macro_rules! laid_out {
    ($message:ident as $type_name:expr, { $($field:ident),+ $(,)? }) => {
        impl $crate::LaidOut for $message {
            fn layout() -> $crate::Layout {
                let fields = vec![$({
                    let (number, count) = $crate::kind(|message: &$message| &message.$field);
                    let offset = std::mem::offset_of!($message, $field);
                    $crate::Field { name: stringify!($field), offset, number, count }
                }),+];
                let (message, size) = (stringify!($message), std::mem::size_of::<$message>());
                $crate::Layout { message, type_name: $type_name, size, fields }
            }

            fn put(&self, bytes: &mut Vec<u8>) {
                let Self { $($field),+ } = self;
                $($crate::FieldValue::put($field, bytes);)+
            }

            fn take(mut bytes: &[u8]) -> Option<Self> {
                let message = Self { $($field: $crate::FieldValue::take(&mut bytes)?),+ };
                bytes.is_empty().then_some(message)
            }
        }
    };
}

laid_out!(SetpointMessage as type_name::<SetpointMessage>(), { tick, time_ns, angles, rates, feed_forward });
laid_out!(MeasurementMessage as type_name::<MeasurementMessage>(), { tick, time_ns, sample, angles, rates, wrench_right, wrench_left, imu_orientation, imu_rate, motor_current });
laid_out!(RequestMessage as type_name::<RequestMessage>(), { not_before, present, intent, source, lasting, turn, speed, extension, age_limit });
laid_out!(ReplyMessage as type_name::<ReplyMessage>(), { verdict, reason, effect_half_step, turn, speed, extension, intent, known, joint, source, value, limit, remaining, predicted_margin });
laid_out!(ReportMessage as type_name::<ReportMessage>(), { tick, time_ns, mode, support, half_step, progress, speed, turn, extension, zmp_in_support, zmp_planned, margin, lean, added, com_in_support, com_velocity_in_support, com_planned, com_velocity_planned, faults, missed, compute_ns });

/// All messages.
pub fn layouts() -> Vec<Layout> {
    vec![
        SetpointMessage::layout(),
        MeasurementMessage::layout(),
        RequestMessage::layout(),
        ReplyMessage::layout(),
        ReportMessage::layout(),
    ]
}

/// The kind of a field, which the compiler reads off its accessor.
#[doc(hidden)]
pub fn kind<M, F: FieldValue>(_field: fn(&M) -> &F) -> (Number, Option<usize>) {
    F::KIND
}

macro_rules! field_value {
    ($($value:ty as $number:expr),+) => {
        $(impl FieldValue for $value {
            const KIND: (Number, Option<usize>) = ($number, None);

            fn put(&self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }

            fn take(bytes: &mut &[u8]) -> Option<Self> {
                bytes.split_off(..size_of::<Self>())?.try_into().ok().map(Self::from_le_bytes)
            }
        })+
    };
}

field_value!(u32 as Number::U32, u64 as Number::U64, f64 as Number::F64);

impl<const N: usize> FieldValue for [f64; N] {
    const KIND: (Number, Option<usize>) = (Number::F64, Some(N));

    fn put(&self, bytes: &mut Vec<u8>) {
        self.iter().for_each(|value| value.put(bytes));
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = f64::take(bytes)?;
        }
        Some(values)
    }
}

fn type_name<M: ZeroCopySend>() -> &'static str {
    // SAFETY: `unsafe` only to implement it: a wrong name would let other types be taken for this one.
    unsafe { <M as ZeroCopySend>::type_name() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Newest;

    #[test]
    fn every_bit_comes_back() {
        let mut message = MeasurementMessage { tick: u64::MAX - 3, ..MeasurementMessage::NOTHING };
        let odd = [f64::from_bits(0x7ff8_0000_0000_1234), f64::NEG_INFINITY, -0.0, f64::MIN_POSITIVE / 4.0];
        message.angles[..4].copy_from_slice(&odd);
        let mut bytes = Vec::new();
        message.put(&mut bytes);
        assert_eq!(bytes.len(), size_of_val(&message), "as it lies in shared memory");
        let back = MeasurementMessage::take(&bytes).unwrap();
        assert_eq!(back.angles.map(f64::to_bits), message.angles.map(f64::to_bits));
        assert_eq!(back.tick, message.tick);
        assert!(MeasurementMessage::take(&bytes[1..]).is_none());
        bytes.push(0);
        assert!(MeasurementMessage::take(&bytes).is_none());
    }
}
