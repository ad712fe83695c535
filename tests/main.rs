//! Statements about the whole, one file each: the name of a test is the statement that broke.

mod dynamics;
#[cfg(feature = "command-line")]
mod files;
#[cfg(feature = "command-line")]
mod paper;
mod plant;
#[cfg(feature = "command-line")]
mod processes;
#[cfg(feature = "command-line")]
mod python;
mod walking;
