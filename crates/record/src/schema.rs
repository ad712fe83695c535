//! Schemas: a message's layout as the text of a ROS 2 `.msg` file.

use std::fmt::Write;

use wire::{Field, Layout, NumberType};

/// MCAP's name for the encoding of [`text`].
pub(crate) const SCHEMA_ENCODING: &str = "ros2msg";
/// MCAP's name for the encoding of [`HEAD`] followed by the bytes of a message.
pub(crate) const MESSAGE_ENCODING: &str = "cdr";
/// Comes before each message: CDR, little-endian. Fields are aligned from its end on, as in shared memory.
pub(crate) const HEAD: [u8; 4] = [0, 1, 0, 0];

/// Name of the message in ROS 2: `halfstep/msg/Setpoint`.
pub(crate) fn name(layout: &Layout) -> String {
    format!("halfstep/msg/{}", layout.message.trim_end_matches("Message"))
}

/// The schema: a line that names the version of the layout, and one for each field.
pub(crate) fn text(layout: &Layout) -> String {
    let mut text = format!("# {}\n", layout.type_name);
    for field in &layout.fields {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{} {}", type_of(field), field.name);
    }
    text
}

/// The type of a field: `float64[20]`.
pub(crate) fn type_of(field: &Field) -> String {
    let number = match field.number {
        NumberType::U32 => "uint32",
        NumberType::U64 => "uint64",
        NumberType::F64 => "float64",
    };
    let many = field.count.map_or(String::new(), |count| format!("[{count}]"));
    format!("{number}{many}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Channel;

    #[test]
    fn a_layout_becomes_a_message_definition() {
        let layout = Channel::Setpoint.layout();
        assert_eq!(name(&layout), "halfstep/msg/Setpoint");
        let expected = "# halfstep.Setpoint.v1\nuint64 tick\nuint64 time_ns\nfloat64[20] angles\nfloat64[20] rates\n\
                        float64[20] feed_forward\n";
        assert_eq!(text(&layout), expected);
    }

    /// CDR aligns every number to its size, counted from the end of the head.
    #[test]
    fn fields_in_shared_memory_are_aligned_as_in_cdr() {
        for channel in Channel::ALL {
            let layout = channel.layout();
            let mut end = 0;
            for field in &layout.fields {
                let size = if field.number == NumberType::U32 { 4 } else { 8 };
                assert_eq!((field.offset, field.offset % size), (end, 0), "{} {}", layout.message, field.name);
                end = field.offset + size * field.count.unwrap_or(1);
            }
            assert_eq!(end, layout.size, "{}", layout.message);
        }
    }
}
