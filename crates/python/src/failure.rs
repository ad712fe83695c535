//! Errors as Python's exceptions, with the texts that the commands print.

use std::fmt::Display;

use pyo3::{PyErr, import_exception};

import_exception!(halfstep.errors, BadInput);
import_exception!(halfstep.errors, Unstable);

/// Wrong configuration or a wrong argument.
pub(crate) fn bad_input(cause: impl Display) -> PyErr {
    BadInput::new_err(cause.to_string())
}

/// The simulation has become unstable.
pub(crate) fn unstable(cause: impl Display) -> PyErr {
    Unstable::new_err(cause.to_string())
}
