//! Strict reading of TOML files: every mistake of a file is reported at once, with its place and what would be right.
//!
//! A loader asks a [`Table`] for each key by name and says what values are right. Nothing fails on the way: a key that
//! is missing or wrong is noted, and its place is taken by a value with which no later comparison is true (`NaN`).
//! [`Document::finish`] adds every key that nobody asked for and gives the loaded value only when nothing was noted.
//!
//! ```
//! use model::config::{ConfigErrors, Document};
//!
//! struct Lean { gain: f64, angle_max: f64 }
//!
//! fn lean(text: &str, file: &str) -> Result<Lean, ConfigErrors> {
//!     let document = Document::parse(text, file)?;
//!     let lean = document.root().table("lean");
//!     let lean = Lean {
//!         gain: lean.number("gain").positive(),
//!         angle_max: lean.angle("angle_max_deg").between(0.0, 10.0), // degrees in the file, radians here
//!     };
//!     document.finish(lean)
//! }
//!
//! assert!(lean("[lean]\ngain = 3\nangle_max_deg = 5.0", "lean.toml").is_ok());
//! let errors = lean("[lean]\ngain = -3\nangle_max = 5.0", "lean.toml").err().unwrap();
//! assert_eq!(
//!     errors.to_string(),
//!     "lean.toml:2:8: lean.gain = -3: must be greater than 0\n\
//!      lean.toml:3:1: lean.angle_max = 5.0: unknown key, write `angle_max_deg`"
//! );
//! ```

mod document;
mod error;
mod number;
mod table;
mod unknown_keys;

pub use document::Document;
pub use error::{ConfigError, ConfigErrors, read};
pub use number::{Number, Numbers};
pub use table::Table;
