//! Writing a recording.

use std::borrow::Cow;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use mcap::records::MessageHeader;
use mcap::write::NoSeek;
use mcap::{Attachment, WriteOptions, Writer};

use crate::new_file;
use crate::schema::{self, HEAD, MESSAGE_ENCODING, SCHEMA_ENCODING};
use crate::{Channel, Metadata, Provenance, RecordError, RunEvent};

/// Time of the run in a chunk (ns): a killed process loses at most that much.
const CHUNK_NS: u64 = 500_000_000;

/// Writes a recording, chunk by chunk.
pub struct RecordingWriter {
    /// Path of the file, for messages.
    path: PathBuf,
    mcap: Writer<NoSeek<BufWriter<File>>>,
    /// MCAP's numbers of the channels, in the order of [`Channel::ALL`].
    ids: Vec<u16>,
    /// The bytes of the message that is being written.
    bytes: Vec<u8>,
    /// Time of the run at which the present chunk ends (ns).
    chunk_end: u64,
}

impl RecordingWriter {
    /// Creates the file, and writes the provenance of the run. An earlier recording of this name is kept under another
    /// one; see [`set_aside`](crate::set_aside).
    ///
    /// # Errors
    /// The file cannot be written, or another process is writing to it.
    pub fn create(path: &Path, provenance: &Provenance) -> Result<Self, RecordError> {
        let file = new_file::create(path)?;
        let options = WriteOptions::new()
            .compression(None)
            .library(concat!("halfstep ", env!("CARGO_PKG_VERSION")))
            // Chunks end by time, and are written to the file as a whole.
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
        for metadata in &provenance.metadata {
            writer.write_metadata(metadata)?;
        }
        for (name, text) in &provenance.files {
            writer.attach(name, text)?;
        }
        writer.flush()?;
        Ok(writer)
    }

    /// Writes an event.
    ///
    /// * `time_ns` – time of the run (ns); must not decrease
    /// * `number` – number of the event; see the table of the crate
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&mut self, time_ns: u64, number: u32, event: &RunEvent) -> Result<(), RecordError> {
        if time_ns >= self.chunk_end {
            self.flush()?;
            self.chunk_end = (time_ns - time_ns % CHUNK_NS).saturating_add(CHUNK_NS);
        }
        self.bytes.clear();
        self.bytes.extend(HEAD);
        event.encode(&mut self.bytes);
        let channel_id = self.ids[event.channel() as usize];
        let header = MessageHeader { channel_id, sequence: number, log_time: time_ns, publish_time: time_ns };
        self.mcap
            .write_to_known_channel(&header, &self.bytes)
            .map_err(|cause| RecordError::unwritable(&self.path, cause))
    }

    /// Writes metadata.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write_metadata(&mut self, metadata: &Metadata) -> Result<(), RecordError> {
        let record = mcap::records::Metadata { name: metadata.name.clone(), metadata: metadata.entries.clone() };
        self.mcap.write_metadata(&record).map_err(|cause| RecordError::unwritable(&self.path, cause))
    }

    /// Attaches a file.
    ///
    /// # Errors
    /// The file cannot be written.
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

    /// Ends the present chunk: everything written so far can be read even if this process is killed.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn flush(&mut self) -> Result<(), RecordError> {
        self.mcap.flush().map_err(|cause| RecordError::unwritable(&self.path, cause))
    }

    /// Writes the index by which other programs seek in the file, and waits until all of it is on the disk.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn finish(mut self) -> Result<(), RecordError> {
        self.mcap.finish().map_err(|cause| RecordError::unwritable(&self.path, cause))?;
        let file = self.mcap.into_inner().into_inner().into_inner();
        let synced = file.map_err(|error| error.into_error()).and_then(|file| file.sync_all());
        synced.map_err(RecordError::io(&self.path))
    }
}
