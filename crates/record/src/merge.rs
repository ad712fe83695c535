//! Merging several recordings into one.

use std::fs;
use std::path::Path;

use crate::reader::TRUNCATED;
use crate::{Item, Metadata, Provenance, RecordError, Recording, RecordingWriter, TimedEvent, set_aside};

/// A recording whose next event has been read already.
struct PeekedRecording {
    /// The recording, read up to the next event.
    recording: Recording,
    /// The next event; `None` at the end.
    next: Option<TimedEvent>,
    /// Metadata read on the way to the next event.
    metadata: Vec<Metadata>,
}

/// Writes one recording with everything in `parts`, in order of time; for equal times, in the order of the parts. Of
/// attachments with the same name the first is taken. Truncated parts are taken as far as they are valid.
///
/// The recording appears under its name when all of it is written: whatever happens before, the parts are all there is.
///
/// # Errors
/// A part cannot be read, or `whole` cannot be written.
pub fn merge<P: AsRef<Path>>(parts: &[P], whole: &Path) -> Result<(), RecordError> {
    let unfinished = whole.with_extension("mcap.unfinished");
    // Left by a merge that was killed.
    let _ = fs::remove_file(&unfinished);
    let merged = write(parts, &unfinished).and_then(|()| {
        set_aside(whole)?;
        fs::rename(&unfinished, whole).map_err(RecordError::io(whole))
    });
    if merged.is_err() {
        let _ = fs::remove_file(&unfinished);
    }
    merged
}

fn write<P: AsRef<Path>>(parts: &[P], whole: &Path) -> Result<(), RecordError> {
    let mut provenance = Provenance::default();
    let mut open = Vec::new();
    for part in parts {
        let mut part = PeekedRecording { recording: Recording::open(part.as_ref())?, next: None, metadata: Vec::new() };
        part.advance(&mut provenance)?;
        provenance.metadata.append(&mut part.metadata);
        open.push(part);
    }
    let mut writer = RecordingWriter::create(whole, &provenance)?;
    let time = |part: &&mut PeekedRecording| part.next.map(|next| next.time_ns);
    while let Some(first) = open.iter_mut().filter(|part| part.next.is_some()).min_by_key(time) {
        if let Some(TimedEvent { time_ns, number, event }) = first.next {
            writer.write(time_ns, number, &event)?;
        }
        // Metadata after events describes how the run ended.
        first.advance(&mut Provenance::default())?;
        for metadata in first.metadata.drain(..) {
            writer.write_metadata(&metadata)?;
        }
    }
    let cuts: Vec<String> = open.iter().filter_map(|part| part.recording.cut()).collect();
    if !cuts.is_empty() {
        writer.write_metadata(&Metadata::new(TRUNCATED, [("parts", cuts.join("; "))]))?;
    }
    writer.finish()
}

impl PeekedRecording {
    /// Reads on to the next event.
    fn advance(&mut self, provenance: &mut Provenance) -> Result<(), RecordError> {
        self.next = loop {
            match self.recording.next_item()? {
                Some(Item::Event(event)) => break Some(*event),
                Some(Item::Metadata(metadata)) => self.metadata.push(metadata),
                Some(Item::File(name, text)) => provenance.attach(name, text),
                None => break None,
            }
        };
        Ok(())
    }
}
