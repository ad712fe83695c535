//! A field of heights from a file.
//!
//! Each cell of the grid is two triangles, divided from its least corner to its greatest. The ground is thereby
//! continuous, goes through every height of the file, and is the same in engines that need plane pieces.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use config::{Table, quoted, read_text};
use nalgebra::{DMatrix, Vector2};

use super::cut::Cut;
use super::floor_extent::FROM_MAX;
use crate::robot_sized::EVEN_HALF_EDGE;

/// Greatest height or depth (m).
const HEIGHT_MAX: f64 = 100.0;

/// A field of heights on a square grid; table `[floor.height_field]` of `config/plant.toml`. Outside it adds nothing.
#[derive(Clone, PartialEq)]
pub struct HeightField {
    /// Name of the file, as in the table.
    pub file: String,
    /// Text of the file.
    pub text: Arc<str>,
    /// Heights (m): rows along y, columns along x.
    heights: Arc<DMatrix<f64>>,
    /// Place of the first height, whose x and y are the least (m).
    origin: Vector2<f64>,
    spacing: f64,
}

/// A place in a cell: which cell, and how far along x and y, 0 to 1.
struct InCell {
    row: usize,
    column: usize,
    along: Vector2<f64>,
}

impl HeightField {
    /// Reads the table `[floor.height_field]` and its file; `None` after noting what is wrong.
    pub(super) fn read(table: &Table) -> Option<Self> {
        let spacing = table.number("spacing_m").between(0.01, 100.0);
        let origin = Vector2::from(table.numbers("origin_m").between(-FROM_MAX, FROM_MAX));
        let file = table.text("file");
        if file.is_empty() {
            return None;
        }
        let path = Path::new(table.file()).with_file_name(file);
        let text =
            read_text(&path).map_err(|error| table.refuse("file", &format!("must be readable: {error}"))).ok()?;
        let read = heights(&text, &path.display().to_string()).and_then(|heights| {
            let field =
                Self { file: file.to_owned(), text: text.as_str().into(), heights: heights.into(), origin, spacing };
            field.check_start(&path.display().to_string()).map(|()| field)
        });
        read.map_err(|error| table.refuse("file", &error)).ok()
    }

    /// The field of heights (m), rows along y and columns along x, from a place on (m), at a spacing (m).
    pub fn new(heights: DMatrix<f64>, origin: Vector2<f64>, spacing: f64) -> Self {
        Self { file: String::new(), text: "".into(), heights: heights.into(), origin, spacing }
    }

    /// Length of a cell's edge (m).
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Height at a place in the world (m).
    pub fn height(&self, place: Vector2<f64>) -> f64 {
        let Some(cell) = self.cell(place) else { return 0.0 };
        let start = self.heights[(cell.row, cell.column)];
        start + self.steps(&cell).dot(&cell.along)
    }

    /// Height per distance along x and y at a place (-).
    pub(super) fn slope(&self, place: Vector2<f64>) -> Vector2<f64> {
        self.cell(place).map_or(Vector2::zeros(), |cell| self.steps(&cell) / self.spacing)
    }

    /// Its border and the edges of its triangles in a square.
    pub(super) fn cuts(&self, centre: Vector2<f64>, half_edge: f64) -> Vec<Cut> {
        let rectangle = self.rectangle();
        let mut cuts = Cut::around(rectangle, 0.0).to_vec();
        let grid = Cut::grid(self.origin, self.spacing, centre, half_edge);
        cuts.extend(grid.into_iter().map(|cut| cut.inside(rectangle)));
        let across = Vector2::new(1.0, -1.0).normalize();
        let [first, middle] = [self.origin, centre].map(|place| place.dot(&across));
        let (spacing, reach) = (self.spacing * across.x, half_edge * std::f64::consts::SQRT_2);
        let [least, greatest] = [middle - reach, middle + reach].map(|at| (at - first) / spacing);
        let diagonals = (least.ceil() as i64..=greatest.floor() as i64)
            .map(|number| Cut::across(across, first + number as f64 * spacing).inside(rectangle));
        cuts.extend(diagonals);
        cuts
    }

    /// Its least and its greatest corner (m).
    fn rectangle(&self) -> [Vector2<f64>; 2] {
        let cells = Vector2::new(self.heights.ncols() - 1, self.heights.nrows() - 1).map(|count| count as f64);
        [self.origin, self.origin + cells * self.spacing]
    }

    fn cell(&self, place: Vector2<f64>) -> Option<InCell> {
        let at = (place - self.origin) / self.spacing;
        let (columns, rows) = (self.heights.ncols() - 1, self.heights.nrows() - 1);
        if !(at.x >= 0.0 && at.y >= 0.0 && at.x < columns as f64 && at.y < rows as f64) {
            return None;
        }
        let (column, row) = (at.x as usize, at.y as usize);
        Some(InCell { row, column, along: at - Vector2::new(column as f64, row as f64) })
    }

    /// How much the triangle of a place rises over a cell's length along x and y (m).
    fn steps(&self, cell: &InCell) -> Vector2<f64> {
        let (row, column) = (cell.row, cell.column);
        let height = |up: usize, ahead: usize| self.heights[(row + up, column + ahead)];
        if cell.along.x >= cell.along.y {
            Vector2::new(height(0, 1) - height(0, 0), height(1, 1) - height(0, 1))
        } else {
            Vector2::new(height(1, 1) - height(1, 0), height(1, 0) - height(0, 0))
        }
    }

    /// Refuses a field that is not level where the robot starts.
    fn check_start(&self, file: &str) -> Result<(), String> {
        for (index, height) in self.heights.iter().enumerate() {
            let (column, row) = (index / self.heights.nrows(), index % self.heights.nrows());
            let place = self.origin + Vector2::new(column as f64, row as f64) * self.spacing;
            if place.amax() < EVEN_HALF_EDGE + self.spacing && *height != 0.0 {
                return Err(format!(
                    "must be 0 within {EVEN_HALF_EDGE} m of the origin, where the walk begins, and in the cells \
                     around: {file} has {height} m at x {:.3}, y {:.3} m (row {}, column {}); move origin_m, or level \
                     the file",
                    place.x,
                    place.y,
                    row + 1,
                    column + 1
                ));
            }
        }
        Ok(())
    }
}

/// The heights in a text: a line for each y, numbers with commas between. Lines that are empty or begin with `#` do not
/// count.
fn heights(text: &str, file: &str) -> Result<DMatrix<f64>, String> {
    let mut values = Vec::new();
    let mut columns = None;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    for (number, line) in lines {
        let number = number + 1;
        let mut start = 0;
        let before = values.len();
        for cell in line.split(',') {
            let written = cell.trim();
            let height = written.parse::<f64>().ok().filter(|height| height.abs() <= HEIGHT_MAX);
            let Some(height) = height else {
                let column = line[..start + (cell.len() - cell.trim_start().len())].chars().count() + 1;
                let found = quoted(written);
                return Err(format!(
                    "must hold heights in m between -{HEIGHT_MAX} and {HEIGHT_MAX}: \
                     {file}:{number}:{column} is `{found}`"
                ));
            };
            values.push(height);
            start += cell.len() + 1;
        }
        let found = values.len() - before;
        let expected = *columns.get_or_insert(found);
        if found != expected {
            return Err(format!(
                "must have as many heights in each line: {file}:{number} has {found}, the first line has {expected}"
            ));
        }
    }
    let columns = columns.unwrap_or(0);
    let rows = values.len().checked_div(columns).unwrap_or(0);
    if rows < 2 || columns < 2 {
        return Err(format!("must have at least two lines of two heights: {file} has {rows} of {columns}"));
    }
    Ok(DMatrix::from_row_slice(rows, columns, &values))
}

impl fmt::Debug for HeightField {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (rows, columns) = self.heights.shape();
        write!(out, "HeightField({} × {} at {} m, {})", columns, rows, self.spacing, self.file)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field() -> HeightField {
        let heights = heights("# three by two\n0, 0.1,0.2\n\n0.3,-0.1, 0.05\n", "f.csv").expect("heights");
        HeightField::new(heights, Vector2::new(1.0, 2.0), 0.5)
    }

    #[test]
    fn height_field_goes_through_its_heights_and_is_zero_outside() {
        let field = field();
        for (x, y, height) in [(1.0, 2.0, 0.0), (1.5, 2.0, 0.1), (1.0, 2.49999999, 0.3), (1.75, 2.0, 0.15)] {
            let found = field.height(Vector2::new(x, y));
            assert!((found - height).abs() < 1e-6, "{x} {y}: {found}");
        }
        for (x, y) in [(0.99, 2.1), (2.01, 2.1), (1.5, 1.99), (1.5, 2.51)] {
            assert_eq!(field.height(Vector2::new(x, y)), 0.0);
        }
    }

    #[test]
    fn height_field_is_continuous_and_its_slope_is_its_derivative() {
        let field = field();
        let near = 1e-7;
        for index in 0..4000 {
            let place =
                Vector2::new(1.0 + 0.999 * f64::from(index % 63) / 63.0, 2.001 + 0.498 * f64::from(index / 63) / 64.0);
            for step in [Vector2::x(), Vector2::y()] {
                let (here, there) = (field.height(place), field.height(place + step * near));
                assert!((here - there).abs() < 2.0 * near, "a jump at {place}");
            }
        }
        let place = Vector2::new(1.2, 2.4);
        let along = |step: Vector2<f64>| (field.height(place + step * near) - field.height(place)) / near;
        let derivative = Vector2::new(along(Vector2::x()), along(Vector2::y()));
        assert!((field.slope(place) - derivative).norm() < 1e-6);
    }

    #[test]
    fn wrong_heights_are_told_with_line_and_column() {
        let error = |text: &str| heights(text, "f.csv").unwrap_err();
        assert!(error("0,0\n# x\n0.1, o.2\n").ends_with("f.csv:3:6 is `o.2`"), "{}", error("0,0\n# x\n0.1, o.2\n"));
        assert!(error("0,nan\n0,0").ends_with("f.csv:1:3 is `nan`"));
        assert!(error("0,0\n0,0,0\n").ends_with("f.csv:2 has 3, the first line has 2"));
        assert!(error("0,0\n").ends_with("f.csv has 1 of 2"));
    }
}
