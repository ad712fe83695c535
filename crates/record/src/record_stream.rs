//! The records of an MCAP file, one after the other; those in chunks, unpacked, as if they stood in the file.
//!
//! What a file claims is never believed: a record is read as far as the file goes, and a chunk is unpacked as far as it
//! says, but never beyond a bound. So memory is bounded by what the file holds.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek};
use std::path::{Path, PathBuf};

use mcap::records::{ChunkHeader, Record, op};

use crate::RecordError;

/// First bytes of a file, and its last ones.
const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";
/// Longest record that is read (bytes); ours have a hundredth of it.
const RECORD_MAX: u64 = 256 << 20;
/// Longest unpacked chunk that is read (bytes).
const CHUNK_MAX: u64 = 128 << 20;
/// Kind and length before each record (bytes).
const HEAD: usize = 9;

/// The records of an MCAP file.
pub(crate) struct RecordStream {
    path: PathBuf,
    file: BufReader<File>,
    is_begun: bool,
    /// Whether chunks and indices are passed over, without reading them.
    skips_chunks: bool,
    /// The chunk that is being read, unpacked.
    chunk: Vec<u8>,
    /// The end of what was read of it.
    at: usize,
    /// The record that is being read.
    data: Vec<u8>,
}

/// Why there are no further records.
pub(crate) enum Stop {
    /// The file is truncated or damaged here.
    Damage(String),
    /// The file cannot be read, or must not be taken for a recording.
    Error(RecordError),
}

impl RecordStream {
    /// Opens a file.
    ///
    /// # Errors
    /// The file cannot be opened.
    pub(crate) fn open(path: &Path) -> Result<Self, RecordError> {
        let file = BufReader::new(File::open(path).map_err(RecordError::io(path))?);
        let (chunk, data) = (Vec::new(), Vec::new());
        Ok(Self { path: path.to_owned(), file, is_begun: false, skips_chunks: false, chunk, at: 0, data })
    }

    /// Passes over chunks: what is left are attachments and metadata.
    pub(crate) fn without_chunks(self) -> Self {
        Self { skips_chunks: true, ..self }
    }

    /// The next record; [`Record::Footer`] is the last.
    ///
    /// # Errors
    /// Why there is none.
    pub(crate) fn next(&mut self) -> Result<Record<'static>, Stop> {
        if !self.is_begun {
            self.begin()?;
            self.is_begun = true;
        }
        loop {
            if self.at < self.chunk.len() {
                return self.next_of_chunk();
            }
            let mut head = [0; HEAD];
            match self.fill(&mut head)? {
                0 => return Err(Stop::Damage("it ends without an index".to_owned())),
                HEAD => {}
                _ => return Err(Stop::Damage("it ends inside a record".to_owned())),
            }
            let (kind, length) = split_head(head);
            if length > RECORD_MAX {
                return Err(Stop::Damage(format!("it has a record of {length} bytes; the longest have {RECORD_MAX}")));
            }
            if self.skips_chunks && matches!(kind, op::CHUNK | op::MESSAGE | op::MESSAGE_INDEX | op::CHUNK_INDEX) {
                self.file.seek_relative(length as i64).map_err(self.io())?;
                let whole = self.file.get_ref().metadata().map_err(self.io())?.len();
                if self.file.stream_position().map_err(self.io())? > whole {
                    return Err(Stop::Damage("it ends inside a chunk".to_owned()));
                }
                continue;
            }
            self.data.clear();
            self.file.by_ref().take(length).read_to_end(&mut self.data).map_err(self.io())?;
            if (self.data.len() as u64) < length {
                let what = if kind == op::CHUNK { "a chunk" } else { "a record" };
                return Err(Stop::Damage(format!("it ends inside {what}")));
            }
            match parsed(kind, &self.data)? {
                Record::Chunk { header, data } => {
                    self.chunk = unpacked(&self.path, &header, &data)?;
                    self.at = 0;
                }
                record => return Ok(record.into_owned()),
            }
        }
    }

    /// Reads the first bytes.
    fn begin(&mut self) -> Result<(), Stop> {
        let mut magic = [0; MAGIC.len()];
        let length = self.fill(&mut magic)?;
        if magic[..length] != MAGIC[..length] {
            return Err(Stop::Error(RecordError::NotMcap { file: self.path.clone() }));
        }
        match length {
            0 => Err(Stop::Damage("it is empty".to_owned())),
            length if length < MAGIC.len() => Err(Stop::Damage("it ends inside its first bytes".to_owned())),
            _ => Ok(()),
        }
    }

    fn next_of_chunk(&mut self) -> Result<Record<'static>, Stop> {
        let rest = &self.chunk[self.at..];
        let outside = || Stop::Damage("a record reaches beyond its chunk".to_owned());
        let (head, rest) = rest.split_first_chunk::<HEAD>().ok_or_else(outside)?;
        let (kind, length) = split_head(*head);
        let data = usize::try_from(length).ok().and_then(|length| rest.get(..length)).ok_or_else(outside)?;
        self.at += HEAD + data.len();
        if kind == op::CHUNK {
            return Err(Stop::Damage("a chunk lies in another".to_owned()));
        }
        Ok(parsed(kind, data)?.into_owned())
    }

    /// Reads until the buffer is full or the file ends; how many bytes it got.
    fn fill(&mut self, buffer: &mut [u8]) -> Result<usize, Stop> {
        let mut filled = 0;
        while filled < buffer.len() {
            match self.file.read(&mut buffer[filled..]) {
                Ok(0) => break,
                Ok(count) => filled += count,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(self.io()(error)),
            }
        }
        Ok(filled)
    }

    fn io(&self) -> impl Fn(io::Error) -> Stop + use<> {
        let path = self.path.clone();
        move |error| Stop::Error(RecordError::io(&path)(error))
    }
}

fn split_head(head: [u8; HEAD]) -> (u8, u64) {
    let [kind, length @ ..] = head;
    (kind, u64::from_le_bytes(length))
}

fn parsed(kind: u8, data: &[u8]) -> Result<Record<'_>, Stop> {
    mcap::parse_record(kind, data).map_err(|error| Stop::Damage(error.to_string()))
}

/// The records of a chunk. A damaged one yields nothing.
fn unpacked(path: &Path, header: &ChunkHeader, packed: &[u8]) -> Result<Vec<u8>, Stop> {
    let size = header.uncompressed_size;
    if size > CHUNK_MAX {
        return Err(Stop::Damage(format!("it has a chunk of {size} bytes; the longest have {CHUNK_MAX}")));
    }
    let mut chunk = Vec::new();
    // One byte more than it should have shows that it has too many.
    let read = match header.compression.as_str() {
        "" => packed.take(size + 1).read_to_end(&mut chunk),
        "lz4" => lz4_flex::frame::FrameDecoder::new(packed).take(size + 1).read_to_end(&mut chunk),
        "zstd" => ruzstd::decoding::StreamingDecoder::new(packed)
            .map_err(|error| Stop::Damage(format!("a chunk cannot be unpacked: {error}")))?
            .take(size + 1)
            .read_to_end(&mut chunk),
        other => {
            let (file, compression) = (path.to_owned(), other.to_owned());
            return Err(Stop::Error(RecordError::UnknownCompression { file, compression }));
        }
    };
    read.map_err(|error| Stop::Damage(format!("a chunk cannot be unpacked: {error}")))?;
    let is_damaged = header.uncompressed_crc != 0 && crc32fast::hash(&chunk) != header.uncompressed_crc;
    if chunk.len() as u64 != size || is_damaged {
        return Err(Stop::Damage("a chunk is damaged".to_owned()));
    }
    Ok(chunk)
}
