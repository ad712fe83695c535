//! HTML pages with pictures.

pub use quick_xml::escape::escape;

/// An SVG as a data URL, so that ids in one picture cannot collide with those in another.
pub fn data_url(svg: &str) -> String {
    let mut url = "data:image/svg+xml,".to_owned();
    for character in svg.chars() {
        match character {
            '"' => url += "%22",
            '#' => url += "%23",
            '%' => url += "%25",
            '<' => url += "%3C",
            '>' => url += "%3E",
            '&' => url += "%26",
            '\n' => url += "%0A",
            other => url.push(other),
        }
    }
    url
}
