//! The layouts of all messages as data: what other languages lay out the same bytes from.

use std::mem::{offset_of, size_of};

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

/// A message's layout from the names of its fields; what is not named does not compile.
macro_rules! layout {
    ($message:ident { $($field:ident),+ }) => {{
        let _ = |message: $message| { let $message { $($field: _),+ } = message; };
        let fields = vec![$({
            let (number, count) = kind(|message: &$message| &message.$field);
            Field { name: stringify!($field), offset: offset_of!($message, $field), number, count }
        }),+];
        Layout { message: stringify!($message), type_name: type_name::<$message>(), size: size_of::<$message>(), fields }
    }};
}
/// All messages.
pub fn layouts() -> Vec<Layout> {
    vec![
        layout!(SetpointMessage { tick, time_ns, angles, rates, feed_forward }),
        layout!(MeasurementMessage {
            tick,
            time_ns,
            sample,
            angles,
            rates,
            wrench_right,
            wrench_left,
            imu_orientation,
            imu_rate,
            motor_current
        }),
        layout!(RequestMessage { not_before, present, intent, source, lasting, turn, speed, extension, age_limit }),
        layout!(ReplyMessage {
            verdict,
            reason,
            effect_half_step,
            turn,
            speed,
            extension,
            intent,
            known,
            joint,
            source,
            value,
            limit,
            remaining,
            predicted_margin
        }),
        layout!(ReportMessage {
            tick,
            time_ns,
            mode,
            support,
            half_step,
            progress,
            speed,
            turn,
            extension,
            zmp_in_support,
            zmp_planned,
            margin,
            lean,
            added,
            com_in_support,
            com_velocity_in_support,
            com_planned,
            com_velocity_planned,
            faults,
            missed,
            compute_ns
        }),
    ]
}

/// What a field may be.
trait Kind {
    const KIND: (Number, Option<usize>);
}

impl Kind for u32 {
    const KIND: (Number, Option<usize>) = (Number::U32, None);
}

impl Kind for u64 {
    const KIND: (Number, Option<usize>) = (Number::U64, None);
}

impl Kind for f64 {
    const KIND: (Number, Option<usize>) = (Number::F64, None);
}

impl<const N: usize> Kind for [f64; N] {
    const KIND: (Number, Option<usize>) = (Number::F64, Some(N));
}

/// The kind of a field, which the compiler reads off its accessor.
fn kind<M, F: Kind>(_field: fn(&M) -> &F) -> (Number, Option<usize>) {
    F::KIND
}

fn type_name<M: ZeroCopySend>() -> &'static str {
    // SAFETY: `unsafe` only to implement it: a wrong name would let other types be taken for this one.
    unsafe { <M as ZeroCopySend>::type_name() }
}
