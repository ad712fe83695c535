//! The messages as a Python module, generated from their layouts: `tools/python/halfstep/messages.py`.

use std::fmt::{Debug, Display, Write};

use interface::{Capturability, Fault, Intent, Lifetime, Mode, PushOutcome, Reason, SensorGroup, Source, Verdict};
use model::Joint;

use crate::{Layout, NumberType, PROTOCOL, layouts};

const HEAD: &str = r#""""The messages as they lie in shared memory.

Written by `halfstep export python`; a test of the repository compares. Do not edit. The meaning of the fields is in
`crates/wire/src/message/`; angles are in radians, joints in the order of the paper.
"""

from ctypes import Array, c_double, c_uint32, c_uint64
from enum import IntEnum, IntFlag

from .message import Message
"#;

/// Writes the text of the Python module.
pub fn python_messages() -> String {
    let mut text = HEAD.to_owned();
    // A String takes everything.
    let _ = write!(text, "\nPROTOCOL = {PROTOCOL}\n\"\"\"The version of all layouts and meanings.\"\"\"\n");
    text.push_str(&codes("Intent", "IntEnum", Intent::ALL, Intent::code));
    text.push_str(&codes("Source", "IntEnum", Source::ALL, Source::code));
    text.push_str(&codes("Lifetime", "IntEnum", Lifetime::ALL, Lifetime::code));
    text.push_str(&codes("Verdict", "IntEnum", Verdict::ALL, Verdict::code));
    text.push_str(&codes("Reason", "IntEnum", Reason::ALL, Reason::code));
    text.push_str(&codes("Mode", "IntEnum", Mode::ALL, Mode::code));
    text.push_str(&codes("Capturability", "IntEnum", Capturability::ALL, Capturability::code));
    text.push_str(&codes("Fault", "IntFlag", Fault::ALL, Fault::code));
    text.push_str(&codes("PushOutcome", "IntEnum", PushOutcome::ALL, PushOutcome::code));
    text.push_str(&codes("SensorGroup", "IntFlag", SensorGroup::ALL, SensorGroup::code));
    text.push_str(&joints());
    for layout in layouts() {
        text.push_str(&class(&layout));
    }
    text
}

/// Writes an enumeration, each variant with its text as a comment.
fn codes<T: Debug + Display + Copy>(name: &str, kind: &str, all: &[T], code: impl Fn(T) -> u32) -> String {
    let mut text = format!("\n\nclass {name}({kind}):\n");
    for variant in all {
        let _ = writeln!(text, "    {} = {}  # {variant}", constant_name(&format!("{variant:?}")), code(*variant));
    }
    text
}

/// Writes the joints with their places in the arrays of messages.
fn joints() -> String {
    let mut text = "\n\nclass Joint(IntEnum):\n    \"\"\"Place of a joint in an array of joints.\"\"\"\n\n".to_owned();
    for joint in Joint::ALL {
        let _ = writeln!(text, "    {} = {}  # joint {}", joint.name().to_uppercase(), joint.index(), joint.number());
    }
    text
}

/// Converts a variant's name to a constant's: `NotFinite` to `NOT_FINITE`.
fn constant_name(variant: &str) -> String {
    let mut name = String::new();
    for (place, letter) in variant.char_indices() {
        if place > 0 && letter.is_uppercase() {
            name.push('_');
        }
        name.extend(letter.to_uppercase());
    }
    name
}

/// Writes a message's class: `SetpointMessage` is called `Setpoint` in Python.
fn class(layout: &Layout) -> String {
    let Layout { message, type_name, size, fields } = layout;
    let name = message.trim_end_matches("Message");
    let mut text = format!("\n\nclass {name}(Message):\n    \"\"\"`{type_name}`, {size} bytes.\"\"\"\n\n");
    for field in fields {
        let kind = match (field.number, field.count) {
            (_, Some(_)) => "Array[c_double]",
            (NumberType::F64, None) => "float",
            (NumberType::U32 | NumberType::U64, None) => "int",
        };
        let _ = writeln!(text, "    {}: {kind}", field.name);
    }
    text.push_str("\n    _fields_ = [\n");
    for field in fields {
        let number = match field.number {
            NumberType::U32 => "c_uint32",
            NumberType::U64 => "c_uint64",
            NumberType::F64 => "c_double",
        };
        let many = field.count.map_or(String::new(), |count| format!(" * {count}"));
        let _ = writeln!(text, "        (\"{}\", {number}{many}),", field.name);
    }
    let _ = write!(
        text,
        "    ]\n\n    @staticmethod\n    def type_name() -> str:\n        \"\"\"What shared memory calls it.\"\"\"\n\
         {:8}return \"{type_name}\"\n",
        ""
    );
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// So that Rust and Python cannot drift apart.
    #[test]
    fn committed_python_module_matches_the_layouts() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tools/python/halfstep/messages.py");
        let committed = std::fs::read_to_string(file).expect("the committed module");
        assert!(
            committed == python_messages(),
            "messages.py is out of date: write it anew with `halfstep export python --out \
             tools/python/halfstep/messages.py`"
        );
    }

    #[test]
    fn name_of_a_variant_becomes_that_of_a_python_constant() {
        assert_eq!(constant_name("NotFinite"), "NOT_FINITE");
        assert_eq!(constant_name("Walk"), "WALK");
    }
}
