//! The lines of an input that may be anything: bytes that are no UTF-8, lines without end.

use std::fmt;
use std::io::{self, BufRead};

/// Longest line (bytes): longer than any command.
pub const LINE_MAX: usize = 64 * 1024;
/// The mark with which some programs begin a file in UTF-8.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// Reads an input line by line, without the ends of the lines. A line that cannot be used does not end the input.
#[derive(Debug)]
pub struct InputLines<R> {
    input: R,
    is_first: bool,
}

/// A line that cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BadLine {
    /// The byte in this column, from 1, belongs to no character of UTF-8.
    NotUtf8 {
        /// Column of the first such byte.
        column: usize,
    },
    /// It is longer than [`LINE_MAX`].
    TooLong,
}

impl<R: BufRead> InputLines<R> {
    /// The lines of an input.
    pub fn new(input: R) -> Self {
        Self { input, is_first: true }
    }

    /// Reads the bytes of a line with its end, at most `LINE_MAX + 1` of them; whether there was anything to read.
    fn read_bytes(&mut self, line: &mut Vec<u8>) -> io::Result<bool> {
        let mut is_end = true;
        loop {
            let bytes = match self.input.fill_buf() {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                bytes => bytes?,
            };
            if bytes.is_empty() {
                return Ok(!is_end);
            }
            is_end = false;
            let end = bytes.iter().position(|&byte| byte == b'\n');
            let taken = end.map_or(bytes.len(), |at| at + 1);
            let kept = taken.min(LINE_MAX + 1 - line.len().min(LINE_MAX + 1));
            line.extend_from_slice(&bytes[..kept]);
            self.input.consume(taken);
            if end.is_some() {
                return Ok(true);
            }
        }
    }
}

impl<R: BufRead> Iterator for InputLines<R> {
    /// A line, or what is wrong with it; an error if the input cannot be read.
    type Item = io::Result<Result<String, BadLine>>;

    fn next(&mut self) -> Option<Self::Item> {
        let mut line = Vec::new();
        match self.read_bytes(&mut line) {
            Ok(true) => {}
            Ok(false) => return None,
            Err(error) => return Some(Err(error)),
        }
        let is_first = std::mem::replace(&mut self.is_first, false);
        if line.len() > LINE_MAX {
            return Some(Ok(Err(BadLine::TooLong)));
        }
        let text = String::from_utf8(line).map_err(|error| {
            let column = error.utf8_error().valid_up_to() + 1;
            BadLine::NotUtf8 { column }
        });
        Some(Ok(text.map(|text| {
            let text = text.trim_end_matches(['\n', '\r']);
            (if is_first { text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text) } else { text }).to_owned()
        })))
    }
}

impl fmt::Display for BadLine {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        match self {
            BadLine::NotUtf8 { column } => write!(out, "not UTF-8 (byte {column} of the line)"),
            BadLine::TooLong => write!(out, "longer than {LINE_MAX} bytes"),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::{BufReader, Read};

    use super::*;

    fn lines(input: impl Read) -> Vec<Result<String, BadLine>> {
        // A small buffer, so that lines cross its end.
        InputLines::new(BufReader::with_capacity(7, input)).map(Result::unwrap).collect()
    }

    #[test]
    fn a_bad_byte_spoils_its_line_only() {
        let read = lines(&b"{\"speed\":1}\r\nab\xff\n\nlast"[..]);
        let bad = BadLine::NotUtf8 { column: 3 };
        let good = |text: &str| Ok(text.to_owned());
        assert_eq!(read, [good("{\"speed\":1}"), Err(bad), good(""), good("last")]);
    }

    #[test]
    fn a_line_without_end_is_refused_and_takes_no_memory() {
        let endless = io::repeat(b'a').take(50_000_000).chain(&b"\nnext\n"[..]);
        let mut lines = InputLines::new(BufReader::new(endless));
        let mut line = Vec::new();
        assert!(lines.read_bytes(&mut line).unwrap());
        assert_eq!(line.len(), LINE_MAX + 1);
        assert_eq!(lines.next().unwrap().unwrap().as_deref(), Ok("next"));
        let longest = format!("{}\n", "a".repeat(LINE_MAX - 1));
        assert!(InputLines::new(longest.as_bytes()).next().unwrap().unwrap().is_ok());
        let longer = format!("a{longest}\n");
        assert_eq!(InputLines::new(longer.as_bytes()).next().unwrap().unwrap(), Err(BadLine::TooLong));
    }

    #[test]
    fn a_byte_order_mark_is_skipped_at_the_beginning_only() {
        assert_eq!(lines("\u{feff}a\n\u{feff}b".as_bytes()), [Ok("a".to_owned()), Ok("\u{feff}b".to_owned())]);
        assert_eq!(lines(&b""[..]), []);
    }
}
