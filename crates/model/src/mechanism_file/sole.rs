//! The sole: `[sole]`, as wide on both sides of the ankle (`width_m`) or not (`inside_m`, `outside_m`).

use config::Table;

use crate::Sole;

/// Smallest and largest distance of an edge from the ankle, and largest width (m).
const EDGE: (f64, f64) = (1e-3, 2.0);

impl Sole {
    /// Reads a table `[sole]`, noting what is wrong.
    pub fn read(table: &Table) -> Self {
        let edge = |key| table.number(key).between(EDGE.0, EDGE.1);
        let [inside, outside] = if table.has("inside_m") || table.has("outside_m") {
            if table.has("width_m") {
                table.refuse("width_m", "must be left out: inside_m and outside_m tell both edges");
            }
            ["inside_m", "outside_m"].map(edge)
        } else {
            [edge("width_m") / 2.0; 2]
        };
        Self {
            behind: edge("behind_m"),
            ahead: edge("ahead_m"),
            inside,
            outside,
            ankle_height: table.number("ankle_height_m").between(0.0, 1.0),
        }
    }

    /// Keys and values of the table `[sole]`.
    pub fn keys(&self) -> Vec<(&'static str, f64)> {
        let aside = if self.inside == self.outside {
            vec![("width_m", self.inside + self.outside)]
        } else {
            vec![("inside_m", self.inside), ("outside_m", self.outside)]
        };
        let along = [("behind_m", self.behind), ("ahead_m", self.ahead)];
        along.into_iter().chain(aside).chain([("ankle_height_m", self.ankle_height)]).collect()
    }
}
