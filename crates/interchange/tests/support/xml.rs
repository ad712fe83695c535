//! An XML text as elements that tests change and write again.

use nalgebra::Vector3;
use quick_xml::Reader;
use quick_xml::escape::escape;
use quick_xml::events::Event;

/// An element of an XML text.
#[derive(Clone, Debug, Default)]
pub(crate) struct TestElement {
    pub(crate) name: String,
    pub(crate) attributes: Vec<(String, String)>,
    pub(crate) children: Vec<TestElement>,
}

impl TestElement {
    /// Reads the root element of a text that is known to be well made.
    pub(crate) fn parse(text: &str) -> Self {
        let mut reader = Reader::from_str(text);
        let mut open = vec![TestElement::default()];
        loop {
            let event = reader.read_event().expect("XML");
            let (Event::Start(start) | Event::Empty(start)) = &event else {
                match event {
                    Event::End(_) => close(&mut open),
                    Event::Eof => return open.remove(0).children.remove(0),
                    _ => {}
                }
                continue;
            };
            let word = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
            let attributes = start.attributes().map(Result::unwrap);
            let attributes = attributes.map(|a| (word(a.key.as_ref()), a.unescape_value().unwrap().into_owned()));
            let attributes = attributes.collect();
            open.push(TestElement { name: word(start.name().as_ref()), attributes, children: Vec::new() });
            if matches!(event, Event::Empty(_)) {
                close(&mut open);
            }
        }
    }

    /// The element and all within it as XML.
    pub(crate) fn text(&self) -> String {
        let attributes: String =
            self.attributes.iter().map(|(key, value)| format!(" {key}=\"{}\"", escape(value))).collect();
        let children: String = self.children.iter().map(TestElement::text).collect();
        format!("<{0}{attributes}>{children}</{0}>\n", self.name)
    }

    /// All elements of a name within this one.
    pub(crate) fn all<'e>(&'e self, name: &'e str) -> impl Iterator<Item = &'e TestElement> {
        self.children.iter().filter(move |child| child.name == name)
    }

    /// The first element of a name within this one.
    pub(crate) fn child(&self, name: &str) -> &TestElement {
        self.children.iter().find(|child| child.name == name).unwrap_or_else(|| panic!("no <{name}>"))
    }

    /// The first element of a name within this one, to be changed.
    pub(crate) fn child_mut(&mut self, name: &str) -> &mut TestElement {
        self.children.iter_mut().find(|child| child.name == name).unwrap_or_else(|| panic!("no <{name}>"))
    }

    /// The element of a kind with a name of its own, to be changed.
    pub(crate) fn named_mut(&mut self, kind: &str, name: &str) -> &mut TestElement {
        let is_it = |child: &&mut TestElement| child.name == kind && child.get("name") == name;
        self.children.iter_mut().find(is_it).unwrap_or_else(|| panic!("no {kind} {name}"))
    }

    /// Value of an attribute.
    pub(crate) fn get(&self, key: &str) -> &str {
        let found = self.attributes.iter().find(|(own, _)| own == key);
        found.map_or_else(|| panic!("<{}> has no {key}", self.name), |(_, value)| value.as_str())
    }

    /// Gives an attribute that is there another value.
    pub(crate) fn set(&mut self, key: &str, value: impl ToString) {
        let found = self.attributes.iter_mut().find(|(own, _)| own == key);
        found.unwrap_or_else(|| panic!("no {key}")).1 = value.to_string();
    }

    /// An attribute as a number.
    pub(crate) fn number(&self, key: &str) -> f64 {
        self.get(key).parse().unwrap()
    }

    /// An attribute as three numbers.
    pub(crate) fn vector(&self, key: &str) -> Vector3<f64> {
        Vector3::from_iterator(self.get(key).split(' ').map(|number| number.parse().unwrap()))
    }

    /// Gives an attribute three numbers.
    pub(crate) fn set_vector(&mut self, key: &str, value: Vector3<f64>) {
        self.set(key, format!("{} {} {}", value.x, value.y, value.z));
    }
}

/// Puts the last open element into the one around it.
fn close(open: &mut Vec<TestElement>) {
    let element = open.pop().expect("an open element");
    open.last_mut().expect("an element around it").children.push(element);
}
