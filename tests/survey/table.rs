//! A table for the terminal.

/// Prints rows under a header, columns aligned to the right.
pub(crate) fn print(header: &[&str], rows: &[Vec<String>]) {
    let header: Vec<String> = header.iter().map(|&name| name.to_owned()).collect();
    let width = |column: usize| {
        std::iter::once(&header).chain(rows).filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max()
    };
    let widths: Vec<usize> = (0..header.len()).filter_map(width).collect();
    for row in std::iter::once(&header).chain(rows) {
        let cells: Vec<String> = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:>width$}")).collect();
        println!("{}", cells.join("  ").trim_end());
    }
}

/// A length in millimetres.
pub(crate) fn millimetres(metres: f64) -> String {
    format!("{:.1}", metres * 1e3)
}
