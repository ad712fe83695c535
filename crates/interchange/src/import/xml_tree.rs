//! The elements of an XML text with their lines, within limits. No robot comes near the limits; a file that was made to
//! hurt is refused before it costs time or memory.

use quick_xml::Reader;
use quick_xml::errors::{Error, SyntaxError};
use quick_xml::events::{BytesStart, Event};

/// Longest text (bytes).
const LENGTH_MAX: usize = 4 << 20;
/// Deepest nesting of elements; that of a URDF is five.
const DEPTH_MAX: usize = 32;
/// Most elements, and most links and joints among them.
const ELEMENTS_MAX: usize = 50_000;
const LINKS_MAX: usize = 1000;

/// An element of an XML text.
#[derive(Clone, Debug, Default)]
pub(super) struct Element {
    /// Name with its prefix: `xacro:macro`.
    pub name: String,
    /// Line at which its tag begins, from 1.
    pub line: usize,
    /// Names and values of its attributes.
    pub attributes: Vec<(String, String)>,
    /// The elements within it.
    pub children: Vec<Element>,
}

impl Element {
    /// Value of an attribute.
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    /// The first element of a name within this one.
    pub(super) fn child(&self, name: &str) -> Option<&Element> {
        self.children.iter().find(|child| child.name == name)
    }

    /// All elements of a name within this one.
    pub(super) fn children<'e>(&'e self, name: &'e str) -> impl Iterator<Item = &'e Element> {
        self.children.iter().filter(move |child| child.name == name)
    }

    /// The first element anywhere within whose name begins so.
    pub(super) fn first_that_begins(&self, prefix: &str) -> Option<&Element> {
        let own = self.name.starts_with(prefix).then_some(self);
        own.or_else(|| self.children.iter().find_map(|child| child.first_that_begins(prefix)))
    }
}

/// Reads the root element of a text.
///
/// # Errors
/// One sentence about the text: no XML, where it breaks off, or beyond which limit it is.
pub(super) fn root_element(text: &str) -> Result<Element, String> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.len() > LENGTH_MAX {
        return Err(format!("it has {} bytes, and may have {LENGTH_MAX}", text.len()));
    }
    let mut reader = Reader::from_str(text);
    let mut lines = LineCounter { text, at: 0, line: 1 };
    let mut open: Vec<Element> = Vec::new();
    let mut root = None;
    let (mut elements, mut links) = (0, 0);
    loop {
        let begins = usize::try_from(reader.buffer_position()).unwrap_or(usize::MAX);
        let event = match reader.read_event() {
            Ok(event) => event,
            // All of them but one: something is not closed before the text ends.
            Err(Error::Syntax(error)) if error != SyntaxError::InvalidBangMarkup => {
                let line = lines.line_at(begins);
                return Err(broken_off(&open, text.get(begins..).unwrap_or_default(), line, text));
            }
            Err(error) => {
                let line = lines.line_at(usize::try_from(reader.error_position()).unwrap_or(0));
                return Err(format!("line {line}: it is no well-formed XML: {error}"));
            }
        };
        let line = lines.line_at(begins);
        let finished = match event {
            Event::Eof if open.is_empty() => return root.ok_or_else(|| "it has no XML elements".to_string()),
            Event::Eof => return Err(broken_off(&open, "", line, text)),
            Event::DocType(_) => return Err(format!("line {line}: it must have no <!DOCTYPE>")),
            Event::Start(start) => {
                (elements, links) = (elements + 1, links + usize::from(is_link_or_joint(&start)));
                open.push(element(&start, line)?);
                None
            }
            Event::Empty(start) => {
                (elements, links) = (elements + 1, links + usize::from(is_link_or_joint(&start)));
                Some(element(&start, line)?)
            }
            Event::End(_) => open.pop(),
            _ => None,
        };
        let beyond = [
            (open.len(), DEPTH_MAX, "elements within each other"),
            (elements, ELEMENTS_MAX, "elements"),
            (links, LINKS_MAX, "links and joints"),
        ];
        if let Some((_, max, what)) = beyond.iter().find(|(count, max, _)| count > max) {
            return Err(format!("line {line}: it has more than {max} {what}"));
        }
        if let Some(finished) = finished {
            match (open.last_mut(), &root) {
                (Some(around), _) => around.children.push(finished),
                (None, None) => root = Some(finished),
                (None, Some(_)) => {
                    return Err(format!("line {line}: it has a second root element, <{}>", finished.name));
                }
            }
        }
    }
}

fn is_link_or_joint(start: &BytesStart) -> bool {
    matches!(start.name().as_ref(), b"link" | b"joint")
}

fn element(start: &BytesStart, line: usize) -> Result<Element, String> {
    let name = String::from_utf8_lossy(start.name().as_ref()).into_owned();
    let mut attributes = Vec::new();
    for attribute in start.attributes() {
        let attribute = attribute.map_err(|error| format!("line {line}: <{name}>: {error}"))?;
        let key = String::from_utf8_lossy(attribute.key.as_ref()).into_owned();
        let value = attribute.unescape_value().map_err(|error| format!("line {line}: <{name} {key}>: {error}"))?;
        attributes.push((key, value.into_owned()));
    }
    Ok(Element { name, line, attributes, children: Vec::new() })
}

/// Tells where a text breaks off: within which element, or within a tag, of which `rest` is there from `line` on.
fn broken_off(open: &[Element], rest: &str, line: usize, text: &str) -> String {
    let word = rest.split_whitespace().next().filter(|word| word.len() > 1 && word.starts_with('<'));
    let tag = word.map(|word| format!("within the tag {} of line {line}", config::quoted(word)));
    let element = open.last().map(|element| {
        let name = element.attribute("name").map_or(String::new(), |name| format!(" name=\"{name}\""));
        format!("within <{}{name}> of line {}", element.name, element.line)
    });
    let within = tag.into_iter().chain(element).collect::<Vec<_>>().join(", ");
    format!("it breaks off at line {}, {within}: a part of the file is missing", text.lines().count())
}

/// Counts lines once through a text.
struct LineCounter<'t> {
    text: &'t str,
    at: usize,
    line: usize,
}

impl LineCounter<'_> {
    /// Line of what stands at a byte or after the white space there; bytes must come in order.
    fn line_at(&mut self, byte: usize) -> usize {
        let bytes = self.text.as_bytes();
        let byte = byte.min(bytes.len());
        if byte > self.at {
            self.line += bytes[self.at..byte].iter().filter(|byte| **byte == b'\n').count();
            self.at = byte;
        }
        self.line
    }
}
