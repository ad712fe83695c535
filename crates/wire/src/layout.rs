//! The layouts of all messages as data, from which other languages read and write the same bytes.

use iceoryx2::prelude::ZeroCopySend;

use crate::{
    MeasurementMessage, PushReplyMessage, PushRequestMessage, ReplyMessage, ReportMessage, RequestMessage,
    SetpointMessage, TruePoseMessage,
};

/// The layout of a message in shared memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Name of the Rust type: `SetpointMessage`.
    pub message: &'static str,
    /// Name in shared memory: `halfstep.Setpoint.v1`. It changes with the layout.
    pub type_name: &'static str,
    /// Size of the message (bytes).
    pub size: usize,
    /// The fields in the order of their offsets, without gaps.
    pub fields: Vec<Field>,
}

/// A field of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name of the field.
    pub name: &'static str,
    /// Offset from the beginning of the message (bytes).
    pub offset: usize,
    /// Type of its number, or of each element if it is an array.
    pub number: NumberType,
    /// Number of elements if it is an array.
    pub count: Option<usize>,
}

/// Type of the numbers of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberType {
    /// Unsigned integer of 32 bits.
    U32,
    /// Unsigned integer of 64 bits.
    U64,
    /// IEEE 754 number of 64 bits.
    F64,
}

/// A message whose layout is known as data: enough to store it, or to read it in another language.
pub trait WireLayout: Copy {
    /// Its layout in shared memory.
    fn layout() -> Layout;

    /// Appends its bytes: the fields in their order without gaps, little-endian. Every bit of a number is kept.
    fn encode(&self, bytes: &mut Vec<u8>);

    /// The message that [`encode`](Self::encode) turned into these bytes; `None` if they are too many or too few.
    fn decode(bytes: &[u8]) -> Option<Self>;
}

/// A type that a field of a message may have.
pub trait FieldValue: Copy {
    /// Type of the numbers, and their count if it is an array.
    const KIND: (NumberType, Option<usize>);

    /// Appends its bytes, little-endian.
    fn encode(&self, bytes: &mut Vec<u8>);

    /// Takes a value off the front of `bytes`; `None` if they are too few.
    fn decode(bytes: &mut &[u8]) -> Option<Self>;
}

/// Implements [`WireLayout`] for a `#[repr(C)]` struct without padding, from its name in shared memory and the names of
/// its fields. A struct with a field that is not listed does not compile.
#[macro_export]
macro_rules! wire_layout {
    ($message:ident as $type_name:expr, { $($field:ident),+ $(,)? }) => {
        impl $crate::WireLayout for $message {
            fn layout() -> $crate::Layout {
                let fields = vec![$({
                    let (number, count) = $crate::kind(|message: &$message| &message.$field);
                    let offset = std::mem::offset_of!($message, $field);
                    $crate::Field { name: stringify!($field), offset, number, count }
                }),+];
                let (message, size) = (stringify!($message), std::mem::size_of::<$message>());
                $crate::Layout { message, type_name: $type_name, size, fields }
            }

            fn encode(&self, bytes: &mut Vec<u8>) {
                let Self { $($field),+ } = self;
                $($crate::FieldValue::encode($field, bytes);)+
            }

            fn decode(mut bytes: &[u8]) -> Option<Self> {
                let message = Self { $($field: $crate::FieldValue::decode(&mut bytes)?),+ };
                bytes.is_empty().then_some(message)
            }
        }
    };
}

wire_layout!(SetpointMessage as type_name::<SetpointMessage>(), { tick, time_ns, angles, rates, feed_forward });
wire_layout!(MeasurementMessage as type_name::<MeasurementMessage>(), {
    tick, time_ns, sample, angles, rates, wrench_right, wrench_left, imu_orientation, imu_rate, motor_current,
    imu_specific_force, missing,
});
wire_layout!(RequestMessage as type_name::<RequestMessage>(), {
    not_before, present, intent, source, lasting, turn, speed, extension, sidestep, velocity, places, place_count,
    place_kind, place_frame, place_marks, age_limit, id, expires_ns,
});
wire_layout!(ReplyMessage as type_name::<ReplyMessage>(), {
    id, verdict, reason, effect_half_step, turn, speed, extension, sidestep, step_ahead, step_aside, velocity,
    intent, known, joint, source, value, limit, remaining, predicted_margin, mode, fault, fault_time, cause, sensor,
    place, arrival,
});
wire_layout!(ReportMessage as type_name::<ReportMessage>(), {
    tick, time_ns, mode, support, half_step, progress, speed, turn, extension, sidestep, zmp_in_support, zmp_planned,
    margin, lean, added, com_in_support, com_velocity_in_support, com_planned, com_velocity_planned, pose,
    walk_velocity, support_sole, landing, landing_after, destination, destination_places_left, destination_distance,
    destination_turn, capturability, contact, external_force, com_offset, gyro_bias, faults, missed, compute_ns,
});

wire_layout!(PushRequestMessage as type_name::<PushRequestMessage>(), { link, impulse, duration });
wire_layout!(PushReplyMessage as type_name::<PushReplyMessage>(), { outcome, start });
wire_layout!(TruePoseMessage as type_name::<TruePoseMessage>(), { tick, time_ns, position, orientation });

/// The layouts of all messages.
pub fn layouts() -> Vec<Layout> {
    vec![
        SetpointMessage::layout(),
        MeasurementMessage::layout(),
        RequestMessage::layout(),
        ReplyMessage::layout(),
        ReportMessage::layout(),
        PushRequestMessage::layout(),
        PushReplyMessage::layout(),
        TruePoseMessage::layout(),
    ]
}

/// The type of a field, which the compiler infers from its accessor.
#[doc(hidden)]
pub fn kind<M, F: FieldValue>(_field: fn(&M) -> &F) -> (NumberType, Option<usize>) {
    F::KIND
}

macro_rules! field_value {
    ($($value:ty as $number:expr),+) => {
        $(impl FieldValue for $value {
            const KIND: (NumberType, Option<usize>) = ($number, None);

            fn encode(&self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }

            fn decode(bytes: &mut &[u8]) -> Option<Self> {
                bytes.split_off(..size_of::<Self>())?.try_into().ok().map(Self::from_le_bytes)
            }
        })+
    };
}

field_value!(u32 as NumberType::U32, u64 as NumberType::U64, f64 as NumberType::F64);

impl<const N: usize> FieldValue for [f64; N] {
    const KIND: (NumberType, Option<usize>) = (NumberType::F64, Some(N));

    fn encode(&self, bytes: &mut Vec<u8>) {
        self.iter().for_each(|value| value.encode(bytes));
    }

    fn decode(bytes: &mut &[u8]) -> Option<Self> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = f64::decode(bytes)?;
        }
        Some(values)
    }
}

fn type_name<M: ZeroCopySend>() -> &'static str {
    // SAFETY: the function is `unsafe` to implement, because a wrong name would let another type be taken for this one;
    // calling it has no requirements.
    unsafe { <M as ZeroCopySend>::type_name() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Latest;

    #[test]
    fn every_bit_of_a_message_survives_encoding_and_decoding() {
        let mut message = MeasurementMessage { tick: u64::MAX - 3, ..MeasurementMessage::EMPTY };
        let odd = [f64::from_bits(0x7ff8_0000_0000_1234), f64::NEG_INFINITY, -0.0, f64::MIN_POSITIVE / 4.0];
        message.angles[..4].copy_from_slice(&odd);
        let mut bytes = Vec::new();
        message.encode(&mut bytes);
        assert_eq!(bytes.len(), size_of_val(&message), "as it lies in shared memory");
        let back = MeasurementMessage::decode(&bytes).unwrap();
        assert_eq!(back.angles.map(f64::to_bits), message.angles.map(f64::to_bits));
        assert_eq!(back.tick, message.tick);
        assert!(MeasurementMessage::decode(&bytes[1..]).is_none());
        bytes.push(0);
        assert!(MeasurementMessage::decode(&bytes).is_none());
    }
}
