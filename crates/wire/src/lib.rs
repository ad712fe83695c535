//! What crosses the process boundary; the only crate that names iceoryx2.
