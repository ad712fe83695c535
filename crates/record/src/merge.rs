//! Making one recording of several.

use std::path::Path;

use crate::{Item, Note, Origin, RecordError, Recording, RecordingWriter, Stamped};

/// A recording of which the next event is known.
struct Part {
    recording: Recording,
    next: Option<Stamped>,
    /// Notes met on the way there.
    notes: Vec<Note>,
}

/// Writes one recording of all that stands in `parts`, in order of time; of the same time the first part's comes first. Of
/// attachments with the same name the first is taken. Parts that were cut off are taken as far as they are whole.
///
/// # Errors
/// A part cannot be read, or `whole` not be written.
pub fn merge<P: AsRef<Path>>(parts: &[P], whole: &Path) -> Result<(), RecordError> {
    let mut origin = Origin::default();
    let mut open = Vec::new();
    for part in parts {
        let mut part = Part { recording: Recording::open(part.as_ref())?, next: None, notes: Vec::new() };
        part.advance(&mut origin)?;
        origin.notes.append(&mut part.notes);
        open.push(part);
    }
    let mut writer = RecordingWriter::create(whole, &origin)?;
    let time = |part: &&mut Part| part.next.map(|next| next.time_ns);
    while let Some(first) = open.iter_mut().filter(|part| part.next.is_some()).min_by_key(time) {
        if let Some(Stamped { time_ns, number, event }) = first.next {
            writer.write(time_ns, number, &event)?;
        }
        // What follows events are notes of how it ended.
        first.advance(&mut Origin::default())?;
        for note in first.notes.drain(..) {
            writer.note(&note)?;
        }
    }
    writer.finish()
}

impl Part {
    /// Goes on to the next event.
    fn advance(&mut self, origin: &mut Origin) -> Result<(), RecordError> {
        self.next = loop {
            match self.recording.next_item()? {
                Some(Item::Event(event)) => break Some(*event),
                Some(Item::Note(note)) => self.notes.push(note),
                Some(Item::File(name, text)) => origin.attach(name, text),
                None => break None,
            }
        };
        Ok(())
    }
}
