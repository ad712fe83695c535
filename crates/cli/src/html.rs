//! Pieces of pages.

/// An SVG as an address, so that no picture's names get in another one's way.
pub fn as_address(svg: &str) -> String {
    let mut address = "data:image/svg+xml,".to_owned();
    for character in svg.chars() {
        match character {
            '"' => address += "%22",
            '#' => address += "%23",
            '%' => address += "%25",
            '<' => address += "%3C",
            '>' => address += "%3E",
            '&' => address += "%26",
            '\n' => address += "%0A",
            other => address.push(other),
        }
    }
    address
}

/// A text that is no markup.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
