//! Messages of earlier versions, read as those of this one.
//!
//! A recording holds the layout of its messages. Where this version has only added fields, a message is taken over
//! field by field. What was added is zero, which means that there is nothing, or what [`LACKING`] says.

use std::ops::Range;

use interface::SensorGroup;
use wire::{Layout, NumberType};

use crate::schema;

/// Layouts of earlier versions that can be read.
const OLDER: [&str; 10] = [
    "halfstep.Measurement.v2",
    "halfstep.Request.v2",
    "halfstep.Request.v3",
    "halfstep.Request.v4",
    "halfstep.Reply.v2",
    "halfstep.Reply.v3",
    "halfstep.Reply.v4",
    "halfstep.Report.v2",
    "halfstep.Report.v3",
    "halfstep.Report.v4",
];

/// What an integer that was added later is in messages of an earlier layout: layout, field, value.
const LACKING: [(&str, &str, u64); 1] =
    [("halfstep.Measurement.v2", "missing", SensorGroup::SpecificForce.code() as u64)];

/// How a message of an earlier version becomes one of this version.
pub(crate) struct OlderLayout {
    /// Size of the earlier message (bytes).
    from_size: usize,
    /// This version's message with what the earlier one lacks.
    lacking: Vec<u8>,
    /// What it lacks: the fields that were added since, which hold nothing.
    added: Vec<&'static str>,
    /// The name of the earlier layout.
    name: String,
    /// Where each field was, and where it begins now.
    fields: Vec<(Range<usize>, usize)>,
}

impl OlderLayout {
    /// The layout of a schema, if it is an earlier one of `layout` that can be read.
    pub(crate) fn of(schema: &str, layout: &Layout) -> Option<Self> {
        let mut lines = schema.lines();
        let name = lines.next()?.strip_prefix("# ")?;
        let message = |name: &str| name.rsplit_once('.').map(|(message, _)| message.to_owned());
        if !OLDER.contains(&name) || message(name) != message(layout.type_name) {
            return None;
        }
        let (mut from_size, mut fields) = (0, Vec::new());
        for line in lines {
            let (kind, name) = line.split_once(' ')?;
            let field = layout.fields.iter().find(|field| field.name == name)?;
            let size = match field.number {
                NumberType::U32 => 4,
                NumberType::U64 | NumberType::F64 => 8,
            } * field.count.unwrap_or(1);
            if kind != schema::type_of(field) {
                return None;
            }
            fields.push((from_size..from_size + size, field.offset));
            from_size += size;
        }
        let was_there = |field: &wire::Field| fields.iter().any(|(_, at)| *at == field.offset);
        let added = layout.fields.iter().filter(|field| !was_there(field)).map(|field| field.name).collect();
        let mut lacking = vec![0; layout.size];
        for (_, field, value) in LACKING.iter().filter(|(older, ..)| *older == name) {
            let at = layout.fields.iter().find(|known| known.name == *field)?.offset;
            lacking[at..at + 8].copy_from_slice(&value.to_le_bytes());
        }
        Some(Self { from_size, lacking, added, name: name.to_owned(), fields })
    }

    /// What messages of this layout lack, for people.
    pub(crate) fn text(&self) -> String {
        format!("`{}` has no {}", self.name, self.added.join(", "))
    }

    /// The bytes of this version's message; `None` if there are too many or too few.
    pub(crate) fn convert(&self, bytes: &[u8]) -> Option<Vec<u8>> {
        if bytes.len() != self.from_size {
            return None;
        }
        let mut message = self.lacking.clone();
        for (from, to) in &self.fields {
            message[*to..to + from.len()].copy_from_slice(&bytes[from.clone()]);
        }
        Some(message)
    }
}

#[cfg(test)]
mod tests {
    use wire::{MeasurementMessage, ReplyMessage, ReportMessage, RequestMessage, WireLayout};

    use super::*;

    /// The schemas of version 0.1.0.
    const REQUEST: &str = "# halfstep.Request.v2\nuint64 not_before\nuint32 present\nuint32 intent\nuint32 source\n\
                           uint32 lasting\nfloat64 turn\nfloat64 speed\nfloat64 extension\nfloat64 age_limit\n";
    const REPLY: &str = "# halfstep.Reply.v2\nuint32 verdict\nuint32 reason\nuint64 effect_half_step\nfloat64 turn\n\
                         float64 speed\nfloat64 extension\nuint32 intent\nuint32 known\nuint32 joint\nuint32 source\n\
                         float64 value\nfloat64 limit\nfloat64 remaining\nfloat64 predicted_margin\n";

    #[test]
    fn a_request_of_an_earlier_version_has_no_id_and_does_not_expire() {
        let older = OlderLayout::of(REQUEST, &RequestMessage::layout()).unwrap();
        let mut bytes = 7_u64.to_le_bytes().to_vec();
        bytes.extend([1_u32, 2, 3, 0].map(u32::to_le_bytes).concat());
        bytes.extend([0.1, 1.2, 0.3, 4.5].map(f64::to_le_bytes).concat());
        let request = RequestMessage::decode(&older.convert(&bytes).unwrap()).unwrap();
        let expected = RequestMessage {
            not_before: 7,
            present: 1,
            intent: 2,
            source: 3,
            lasting: 0,
            turn: 0.1,
            speed: 1.2,
            extension: 0.3,
            sidestep: 0.0,
            velocity: [0.0; 3],
            places: [0.0; 72],
            place_count: 0,
            place_kind: 0,
            place_frame: 0,
            place_marks: 0,
            age_limit: 4.5,
            id: 0,
            expires_ns: 0,
        };
        assert_eq!(request, expected);
        assert_eq!(older.convert(&bytes[1..]), None);
    }

    #[test]
    fn a_reply_of_an_earlier_version_names_no_mode_and_no_fault() {
        let older = OlderLayout::of(REPLY, &ReplyMessage::layout()).unwrap();
        let mut bytes = [1_u32, 0].map(u32::to_le_bytes).concat();
        bytes.extend(5_u64.to_le_bytes());
        bytes.extend([0.1, 1.2, 0.0].map(f64::to_le_bytes).concat());
        bytes.extend([1_u32, 1, 0, 0].map(u32::to_le_bytes).concat());
        bytes.extend([0.0; 4].map(f64::to_le_bytes).concat());
        let reply = ReplyMessage::decode(&older.convert(&bytes).unwrap()).unwrap().checked().unwrap();
        assert_eq!((reply.id, reply.mode, reply.latched, reply.effect_half_step), (0, None, None, 5));
        assert_eq!((reply.place, reply.arrival), (None, None));
        assert_eq!((reply.granted.turn, reply.granted.speed), (0.1, 1.2));
    }

    /// This version's layout without what inertial measurement units did not tell before.
    #[test]
    fn a_measurement_of_an_earlier_version_has_no_accelerometer() {
        let layout = MeasurementMessage::layout();
        let mut before = Layout { type_name: "halfstep.Measurement.v2", ..layout.clone() };
        before.fields.retain(|field| !["imu_specific_force", "missing"].contains(&field.name));
        let older = OlderLayout::of(&schema::text(&before), &layout).unwrap();
        let measurement = MeasurementMessage::decode(&older.convert(&[0; 656]).unwrap()).unwrap().measurement();
        assert_eq!(measurement.missing.iter().collect::<Vec<_>>(), [SensorGroup::SpecificForce]);
        assert_eq!(older.text(), "`halfstep.Measurement.v2` has no imu_specific_force, missing");
    }

    /// What reports did not have before the fifth version.
    const ESTIMATES: [&str; 5] = ["capturability", "contact", "external_force", "com_offset", "gyro_bias"];

    #[test]
    fn a_report_of_an_earlier_version_judges_nothing() {
        let layout = ReportMessage::layout();
        let mut before = Layout { type_name: "halfstep.Report.v4", ..layout.clone() };
        before.fields.retain(|field| !ESTIMATES.contains(&field.name));
        let older = OlderLayout::of(&schema::text(&before), &layout).unwrap();
        let report = ReportMessage::decode(&older.convert(&[0; 416]).unwrap()).unwrap().checked().unwrap();
        assert_eq!((report.capturability, report.estimate), (None, interface::StateEstimate::default()));
    }

    /// This version's layout without the fields of destinations, under an earlier name.
    fn before_destinations(layout: &Layout, earlier: &str) -> Layout {
        let is_new = |name: &str| {
            name.starts_with("place")
                || name.starts_with("destination")
                || name == "arrival"
                || ESTIMATES.contains(&name)
        };
        let mut before =
            Layout { type_name: OLDER.into_iter().find(|name| *name == earlier).unwrap(), ..layout.clone() };
        before.fields.retain(|field| !is_new(field.name));
        assert!(before.fields.len() < layout.fields.len());
        before
    }

    #[test]
    fn messages_of_the_version_before_have_no_destination() {
        let of_message = |layout: &Layout, earlier: &str, size: usize| {
            let older = OlderLayout::of(&schema::text(&before_destinations(layout, earlier)), layout).unwrap();
            older.convert(&vec![0; size]).unwrap()
        };
        let request = of_message(&RequestMessage::layout(), "halfstep.Request.v4", 104);
        assert_eq!(RequestMessage::decode(&request).unwrap().checked().unwrap().destination, None);
        let report = of_message(&ReportMessage::layout(), "halfstep.Report.v3", 392);
        assert_eq!(ReportMessage::decode(&report).unwrap().checked().unwrap().destination, None);
        // A reply of zeros has no verdict.
        of_message(&ReplyMessage::layout(), "halfstep.Reply.v4", 168);
    }

    #[test]
    fn other_layouts_are_none_of_an_earlier_version() {
        let layout = RequestMessage::layout();
        for schema in [
            REPLY.to_owned(),
            REQUEST.replace("v2", "v1"),
            REQUEST.replace("float64 turn", "uint64 turn"),
            REQUEST.replace("turn", "roll"),
            schema::text(&layout),
        ] {
            assert!(OlderLayout::of(&schema, &layout).is_none(), "{schema}");
        }
    }
}
