//! `halfstep._halfstep`: controller and plant within a Python process, the compiled part of the package `halfstep`.
//!
//! `Walk` is one walk, `Batch` many at once on all cores; both release Python's lock while they walk. States come
//! as rows of numbers (`columns.rs`), which Python views without copies. Documentation and types for users are in
//! `tools/python/halfstep`.

mod batch;
mod columns;
mod failure;
mod one_walk;
mod setup;
mod walk;

use pyo3::prelude::*;

/// The compiled part of the package `halfstep`.
#[pymodule]
mod _halfstep {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::batch::PythonBatch;
    use crate::columns::COLUMNS;
    #[pymodule_export]
    use crate::walk::{PythonWalk, Snapshot};

    /// Names and widths of the columns of a state.
    #[pyfunction]
    fn columns() -> Vec<(&'static str, usize)> {
        COLUMNS.to_vec()
    }

    /// Names of the robots in the box.
    #[pyfunction]
    fn robots() -> Vec<&'static str> {
        ::robots::ROBOTS.iter().map(|robot| robot.name).collect()
    }
}
