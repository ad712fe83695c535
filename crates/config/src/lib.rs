//! Strict reading of TOML files: every mistake of a file is reported at once, with its place and what would be right.
//!
//! A loader looks up each key of a [`Table`] by name and states which values are right. Nothing fails on the way: a
//! missing or wrong value is noted and replaced by one with which no later comparison is true (`NaN`). At the end every
//! key that was never looked up is an error too, and the loaded value is returned only when nothing was noted.
//!
//! ```
//! use config::{Config, Table};
//!
//! struct Lean { gain: f64, angle_max: f64 }
//!
//! impl Config for Lean {
//!     fn read(root: &Table) -> Self {
//!         let lean = root.table("lean");
//!         Lean {
//!             gain: lean.number("gain").between(0.0, 20.0),
//!             angle_max: lean.angle("angle_max_deg").between(0.0, 10.0), // degrees in the file, radians here
//!         }
//!     }
//! }
//!
//! assert!(Lean::from_toml("[lean]\ngain = 3\nangle_max_deg = 5.0", "lean.toml").is_ok());
//! let errors = Lean::from_toml("[lean]\ngain = -3\nangle_max = 5.0", "lean.toml").err().unwrap();
//! assert_eq!(
//!     errors.to_string(),
//!     "lean.toml:2:8: lean.gain = -3: must lie between 0 and 20\n\
//!      lean.toml:3:1: lean.angle_max = 5.0: unknown key; write `angle_max_deg`"
//! );
//! ```

mod config;
mod document;
mod error;
mod number;
mod place;
mod source;
mod table;
mod text;
mod unknown_keys;

pub use config::Config;
pub use document::Document;
pub use error::{ConfigError, ConfigErrors};
pub use number::{Number, Numbers};
pub use source::quoted;
pub use table::Table;
pub use text::{bounded_text, read_text};
