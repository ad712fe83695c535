//! Reading a recording, from its beginning to its end or to where it is truncated.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use mcap::records::Record;

use crate::older_files::move_servos;
use crate::older_layout::OlderLayout;
use crate::record_stream::{RecordStream, Stop};
use crate::schema::{self, HEAD, MESSAGE_ENCODING, SCHEMA_ENCODING};
use crate::{CONTROLLER_FILE, Channel, Metadata, PLANT_FILE, Provenance, RUN_FILE, RecordError, RunEvent};

/// Name of the metadata that says which parts of a merged recording were truncated.
pub(crate) const TRUNCATED: &str = "truncated";

/// A recording while it is read. Channels of other programs are skipped.
pub struct Recording {
    /// Path of the file, for messages.
    path: PathBuf,
    records: RecordStream,
    /// Encoding and text of the schemas, by MCAP's numbers.
    schemas: HashMap<u16, (String, String)>,
    /// The channels, by MCAP's numbers, and the layout of their messages if it is that of an earlier version.
    channels: HashMap<u16, (Channel, Option<OlderLayout>)>,
    /// Whether the end of the file has been read.
    is_whole: bool,
    /// Why the end of the file is missing.
    damage: Option<String>,
    /// What was missing at the end of the parts from which the recording was merged.
    truncated: Option<String>,
    /// Time of the last event that was read (ns).
    time_ns: u64,
}

/// A part of a recording.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// An event of the run.
    Event(Box<TimedEvent>),
    /// A set of keys and values.
    Metadata(Metadata),
    /// Name and text of an attached file.
    File(String, String),
}

/// An event with its time and number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedEvent {
    /// Time of the event in the run (ns).
    pub time_ns: u64,
    /// Number of the event; see the table of the crate.
    pub number: u32,
    /// The event.
    pub event: RunEvent,
}

impl TimedEvent {
    /// Time of the event in the run (s).
    pub fn time(&self) -> f64 {
        self.time_ns as f64 / 1e9
    }
}

/// The files that hold a run: `run` itself if it is a file; in a folder the files of the processes, or without them
/// [`RUN_FILE`], into which they are merged before they are removed.
///
/// # Errors
/// The folder holds none of them.
pub fn files_of(run: &Path) -> Result<Vec<PathBuf>, RecordError> {
    if !run.is_dir() {
        return Ok(vec![run.to_owned()]);
    }
    let whole = run.join(RUN_FILE);
    let parts = [CONTROLLER_FILE, PLANT_FILE].map(|name| run.join(name));
    let present: Vec<_> = parts.into_iter().filter(|part| part.exists()).collect();
    match (whole.exists(), present.is_empty()) {
        (_, false) => Ok(present),
        (true, true) => Ok(vec![whole]),
        (false, true) => {
            let names = format!("{RUN_FILE}, or {CONTROLLER_FILE} and {PLANT_FILE}");
            Err(RecordError::Nothing { folder: run.to_owned(), names })
        }
    }
}

/// The provenance of a run, given by its recording or by the folder that holds it, wherever in the file another program
/// has moved it. Of files with the same name the first is taken. Those of earlier versions are as this one reads them.
///
/// # Errors
/// See [`files_of`] and [`Recording::next_item`]; a file that is empty, or damaged before anything of the run.
pub fn provenance_of(run: &Path) -> Result<Provenance, RecordError> {
    let mut provenance = Provenance::default();
    for file in files_of(run)? {
        let mut recording = Recording::open_without_events(&file)?;
        let mut is_known = false;
        while let Some(item) = recording.next_item()? {
            is_known = true;
            match item {
                Item::Metadata(metadata) => provenance.metadata.push(metadata),
                Item::File(name, text) => provenance.attach(name, text),
                Item::Event(_) => {}
            }
        }
        if let (false, Some(cause)) = (is_known, recording.damage) {
            return Err(RecordError::Unreadable { file, cause });
        }
    }
    move_servos(&mut provenance);
    Ok(provenance)
}

impl Recording {
    /// Opens a file.
    ///
    /// # Errors
    /// The file cannot be opened. Its content is checked as it is read.
    pub fn open(path: &Path) -> Result<Self, RecordError> {
        Ok(Self::of(path, RecordStream::open(path)?))
    }

    /// Opens a file without its events: what is left is found without reading all of it.
    fn open_without_events(path: &Path) -> Result<Self, RecordError> {
        Ok(Self::of(path, RecordStream::open(path)?.without_chunks()))
    }

    fn of(path: &Path, records: RecordStream) -> Self {
        let (schemas, channels) = (HashMap::new(), HashMap::new());
        Self {
            path: path.to_owned(),
            records,
            schemas,
            channels,
            is_whole: false,
            damage: None,
            truncated: None,
            time_ns: 0,
        }
    }

    /// The next part of the recording; `None` at the end, or where the file is truncated or damaged: see
    /// [`cut`](Self::cut).
    ///
    /// # Errors
    /// The file cannot be read, or is not a recording of this version.
    pub fn next_item(&mut self) -> Result<Option<Item>, RecordError> {
        while !self.is_whole && self.damage.is_none() {
            match self.records.next() {
                Ok(record) => {
                    if let Some(item) = self.item(record)? {
                        return Ok(Some(item));
                    }
                }
                Err(Stop::Damage(damage)) => self.damage = Some(damage),
                Err(Stop::Error(error)) => return Err(error),
            }
        }
        Ok(None)
    }

    /// The next event; `None` as for [`next_item`](Self::next_item).
    ///
    /// # Errors
    /// See [`next_item`](Self::next_item).
    pub fn next_event(&mut self) -> Result<Option<TimedEvent>, RecordError> {
        loop {
            match self.next_item()? {
                Some(Item::Event(event)) => return Ok(Some(*event)),
                Some(_) => {}
                None => return Ok(None),
            }
        }
    }

    /// After reading: why and from which time on the end of the recording is missing; `None` if it is complete.
    pub fn cut(&self) -> Option<String> {
        let seconds = self.time_ns as f64 * 1e-9;
        let Some(damage) = &self.damage else { return self.truncated.clone() };
        Some(format!("{}: truncated, valid up to {seconds:.3} s: {damage}", self.path.display()))
    }

    /// What the messages read so far lack because an earlier version wrote them; one text for each kind of message.
    pub fn lacking(&self) -> Vec<String> {
        let mut lacking: Vec<_> =
            self.channels.values().filter_map(|(_, older)| Some(older.as_ref()?.text())).collect();
        lacking.sort();
        lacking
    }

    /// The part of the recording in an MCAP record, if it is one.
    fn item(&mut self, record: Record) -> Result<Option<Item>, RecordError> {
        match record {
            Record::Schema { header, data } => {
                self.schemas.insert(header.id, (header.encoding, String::from_utf8_lossy(&data).into_owned()));
            }
            Record::Channel(channel) => {
                let ours = Channel::ALL.iter().find(|ours| ours.topic() == channel.topic);
                if let Some(&ours) = ours {
                    let older = self.check(ours, channel.schema_id, &channel.message_encoding)?;
                    self.channels.insert(channel.id, (ours, older));
                }
            }
            Record::Message { header, data } => {
                let Some((channel, older)) = self.channels.get(&header.channel_id) else { return Ok(None) };
                let event = data.strip_prefix(&HEAD).and_then(|bytes| match older {
                    Some(older) => older.convert(bytes).and_then(|bytes| channel.decode(&bytes)),
                    None => channel.decode(bytes),
                });
                let event = event.ok_or_else(|| RecordError::WrongSize {
                    file: self.path.clone(),
                    topic: channel.topic().to_owned(),
                    number: header.sequence,
                    size: data.len(),
                })?;
                self.time_ns = header.log_time;
                return Ok(Some(Item::Event(Box::new(TimedEvent {
                    time_ns: header.log_time,
                    number: header.sequence,
                    event,
                }))));
            }
            Record::Metadata(record) => {
                let metadata = Metadata { name: record.name, entries: record.metadata };
                if metadata.name == TRUNCATED {
                    self.truncated = Some(metadata.entries.into_values().collect::<Vec<_>>().join("; "));
                    return Ok(None);
                }
                return Ok(Some(Item::Metadata(metadata)));
            }
            Record::Attachment { header, data, .. } => {
                return Ok(Some(Item::File(header.name, String::from_utf8_lossy(&data).into_owned())));
            }
            Record::Footer(_) => self.is_whole = true,
            _ => {}
        }
        Ok(None)
    }

    /// Checks that the messages of a channel can be read. Returns their layout if it is that of an earlier version.
    fn check(&self, channel: Channel, schema: u16, encoding: &str) -> Result<Option<OlderLayout>, RecordError> {
        let expected = schema::text(&channel.layout());
        let none = (String::new(), String::new());
        let (schema_encoding, text) = self.schemas.get(&schema).unwrap_or(&none);
        let is_ours = schema_encoding == SCHEMA_ENCODING && encoding == MESSAGE_ENCODING;
        if is_ours && *text == expected {
            return Ok(None);
        }
        if let Some(older) = OlderLayout::of(text, &channel.layout()).filter(|_| is_ours) {
            return Ok(Some(older));
        }
        let line = |text: &str| text.lines().next().unwrap_or("nothing known").trim_start_matches("# ").to_owned();
        Err(RecordError::OtherVersion {
            file: self.path.clone(),
            topic: channel.topic().to_owned(),
            found: line(text),
            expected: line(&expected),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::fs::File;

    use wire::{SetpointMessage, WireLayout};

    use super::*;
    use crate::RecordingWriter;

    /// The result of reading a file with one channel of another program.
    fn foreign(topic: &str, encoding: &str, schema: &str) -> Result<Option<TimedEvent>, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("foreign.mcap");
        let mut mcap = mcap::Writer::new(File::create(&path).unwrap()).unwrap();
        let id = mcap.add_schema("halfstep/msg/Setpoint", SCHEMA_ENCODING, schema.as_bytes()).unwrap();
        let channel_id = mcap.add_channel(id, topic, encoding, &BTreeMap::new()).unwrap();
        let header = mcap::records::MessageHeader { channel_id, sequence: 7, log_time: 1, publish_time: 1 };
        mcap.write_to_known_channel(&header, &[0, 1, 0, 0, 5]).unwrap();
        mcap.finish().unwrap();
        let mut recording = Recording::open(&path).unwrap();
        let read = recording.next_event();
        assert_eq!(recording.cut(), None);
        read.map_err(|error| error.to_string().replace(&*folder.path().to_string_lossy(), "folder"))
    }

    #[test]
    fn messages_of_another_layout_are_refused() {
        let own = schema::text(&SetpointMessage::layout());
        let older = own.replace("v1", "v0").replace("float64[20] rates\n", "");
        let expected = "folder/foreign.mcap: /setpoints was written by another version: its messages are \
                        `halfstep.Setpoint.v0`, those of this version `halfstep.Setpoint.v1`";
        assert_eq!(foreign("/setpoints", MESSAGE_ENCODING, &older), Err(expected.to_owned()));
        assert!(foreign("/setpoints", "json", &own).is_err());
        let short = foreign("/setpoints", MESSAGE_ENCODING, &own).unwrap_err();
        assert_eq!(short, "folder/foreign.mcap: message 7 of /setpoints has 5 bytes, which its schema does not allow");
    }

    #[test]
    fn channels_of_other_programs_are_skipped() {
        assert_eq!(foreign("/camera", "json", "{}"), Ok(None));
    }

    #[test]
    fn a_folder_of_a_run_is_read_whole_or_in_parts() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        assert!(files_of(folder.path()).unwrap_err().to_string().contains("holds no recording; it must hold run.mcap"));
        for name in [PLANT_FILE, CONTROLLER_FILE] {
            let files = vec![(name.to_owned(), "text".to_owned()), ("both".to_owned(), name.to_owned())];
            let provenance = Provenance { metadata: vec![Metadata::new(name, [("key", "value".to_owned())])], files };
            RecordingWriter::create(&file(name), &provenance).unwrap().finish().unwrap();
        }
        let parts = files_of(folder.path()).unwrap();
        assert_eq!(parts, [file(CONTROLLER_FILE), file(PLANT_FILE)]);
        let provenance = provenance_of(folder.path()).unwrap();
        assert_eq!((provenance.files.len(), provenance.file("both")), (3, Some(CONTROLLER_FILE)));

        crate::merge(&parts, &file(RUN_FILE)).unwrap();
        assert_eq!(files_of(folder.path()).unwrap(), parts, "until they are removed");
        parts.iter().for_each(|part| std::fs::remove_file(part).unwrap());
        assert_eq!(files_of(folder.path()).unwrap(), [file(RUN_FILE)]);
        assert_eq!(provenance_of(folder.path()).unwrap(), provenance);
        assert_eq!(provenance.entry(PLANT_FILE, "key"), Some("value"));
    }

    /// A small recording of every kind of event, with metadata and attachments.
    fn small() -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("small.mcap");
        let metadata = vec![Metadata::new("controller", [("clock", "lockstep".to_owned())])];
        let files = vec![("mechanism.toml".to_owned(), "name = \"robot\"".to_owned())];
        let mut writer = RecordingWriter::create(&file, &Provenance { metadata, files }).unwrap();
        for number in 0..20 {
            for channel in Channel::ALL {
                let event = channel.decode(&vec![number as u8; channel.layout().size]).unwrap();
                writer.write(u64::from(number) * 100_000_000, number, &event).unwrap();
            }
        }
        writer.write_metadata(&Metadata::new("controller end", [("lost", "0".to_owned())])).unwrap();
        writer.finish().unwrap();
        std::fs::read(file).unwrap()
    }

    proptest::proptest! {
        /// A record must not be longer than the file: else a few bytes would take all memory.
        #[test]
        fn any_file_is_read_or_refused(
            changes in proptest::collection::vec((0.0..1.0, 0..4, proptest::num::u64::ANY), 0..6),
            kept in 0.0..1.3,
        ) {
            let mut bytes = small();
            for (place, kind, number) in changes {
                let place = (place * (bytes.len() - 8) as f64) as usize;
                let number = if kind == 0 { number } else { number % (1_u64 << (8 * kind)) };
                bytes[place..place + 8].copy_from_slice(&number.to_le_bytes());
            }
            bytes.truncate((kept * bytes.len() as f64) as usize);
            let folder = tempfile::tempdir().unwrap();
            let file = folder.path().join("spoilt.mcap");
            std::fs::write(&file, &bytes).unwrap();
            let (mut recording, mut items) = (Recording::open(&file).unwrap(), 0);
            while let Ok(Some(_)) = recording.next_item() {
                items += 1;
            }
            assert!(items <= bytes.len());
            assert!(recording.cut().is_none_or(|cut| !cut.is_empty()));
            let _ = provenance_of(&file);
        }
    }

    #[test]
    fn a_record_that_claims_to_be_long_costs_what_the_file_holds() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("claims.mcap");
        for claim in [1_u64 << 20, 1 << 27, 1 << 30, 1 << 40, u64::MAX] {
            let mut bytes = b"\x89MCAP0\r\n\x0c".to_vec();
            bytes.extend(claim.to_le_bytes());
            bytes.extend([0; 100]);
            std::fs::write(&file, bytes).unwrap();
            let mut recording = Recording::open(&file).unwrap();
            assert_eq!(recording.next_item().unwrap(), None);
            assert!(recording.cut().unwrap().contains(if claim > 1 << 28 { "a record of" } else { "inside a record" }));
        }
    }
}
