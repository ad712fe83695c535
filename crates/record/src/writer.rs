//! Writing a recording.

use std::borrow::Cow;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use mcap::records::MessageHeader;
use mcap::write::{Metadata, NoSeek};
use mcap::{Attachment, WriteOptions, Writer};

use crate::schema::{self, HEAD, MESSAGE_ENCODING, SCHEMA_ENCODING};
use crate::{Channel, Event, Note, Origin, RecordError};

/// How much of the run is in a chunk [ns]: whoever is killed loses no more.
const CHUNK_NS: u64 = 500_000_000;

/// Writes a recording, a chunk at a time.
pub struct RecordingWriter {
    path: PathBuf,
    mcap: Writer<NoSeek<BufWriter<File>>>,
    /// MCAP's numbers of our channels, in their order.
    ids: Vec<u16>,
    bytes: Vec<u8>,
    /// When the present chunk is to end [ns].
    chunk_end: u64,
}

impl RecordingWriter {
    /// Creates the file, or empties it, and writes what the run began with.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn create(path: &Path, origin: &Origin) -> Result<Self, RecordError> {
        let file = File::create(path).map_err(RecordError::io(path))?;
        let options = WriteOptions::new()
            .compression(None)
            .library(concat!("halfstep ", env!("CARGO_PKG_VERSION")))
            // Chunks end by time, and reach the file whole.
            .chunk_size(None)
            .disable_seeking(true);
        let wrong = |cause| RecordError::unwritable(path, cause);
        let mut mcap = options.create(NoSeek::new(BufWriter::new(file))).map_err(wrong)?;
        let mut ids = Vec::new();
        for channel in Channel::ALL {
            let layout = channel.layout();
            let text = schema::text(&layout);
            let id = mcap.add_schema(&schema::name(&layout), SCHEMA_ENCODING, text.as_bytes()).map_err(wrong)?;
            ids.push(mcap.add_channel(id, channel.topic(), MESSAGE_ENCODING, &Default::default()).map_err(wrong)?);
        }
        let mut writer = Self { path: path.to_owned(), mcap, ids, bytes: Vec::new(), chunk_end: CHUNK_NS };
        for note in &origin.notes {
            writer.note(note)?;
        }
        for (name, text) in &origin.files {
            writer.attach(name, text)?;
        }
        writer.flush()?;
        Ok(writer)
    }

    /// Writes an event.
    ///
    /// * `time_ns` – of the run; must not decrease
    /// * `number` – see the crate's table
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&mut self, time_ns: u64, number: u32, event: &Event) -> Result<(), RecordError> {
        if time_ns >= self.chunk_end {
            self.flush()?;
            self.chunk_end = time_ns - time_ns % CHUNK_NS + CHUNK_NS;
        }
        self.bytes.clear();
        self.bytes.extend(HEAD);
        event.put(&mut self.bytes);
        let channel_id = self.ids[event.channel() as usize];
        let header = MessageHeader { channel_id, sequence: number, log_time: time_ns, publish_time: time_ns };
        self.mcap
            .write_to_known_channel(&header, &self.bytes)
            .map_err(|cause| RecordError::unwritable(&self.path, cause))
    }

    /// Writes a note.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn note(&mut self, note: &Note) -> Result<(), RecordError> {
        let metadata = Metadata { name: note.name.clone(), metadata: note.words.clone() };
        self.mcap.write_metadata(&metadata).map_err(|cause| RecordError::unwritable(&self.path, cause))
    }

    /// Attaches a file.
    ///
    /// # Errors
    /// It cannot be written.
    pub(crate) fn attach(&mut self, name: &str, text: &str) -> Result<(), RecordError> {
        let attachment = Attachment {
            log_time: 0,
            create_time: 0,
            name: name.to_owned(),
            media_type: "text/plain".to_owned(),
            data: Cow::Borrowed(text.as_bytes()),
        };
        self.mcap.attach(&attachment).map_err(|cause| RecordError::unwritable(&self.path, cause))
    }

    /// Ends the present chunk: all that was written can be read from now on, whatever happens to this process.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn flush(&mut self) -> Result<(), RecordError> {
        self.mcap.flush().map_err(|cause| RecordError::unwritable(&self.path, cause))
    }

    /// Writes the index with which others find their way in it.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn finish(mut self) -> Result<(), RecordError> {
        self.mcap.finish().map_err(|cause| RecordError::unwritable(&self.path, cause))?;
        self.mcap.into_inner().into_inner().flush().map_err(RecordError::io(&self.path))
    }
}
