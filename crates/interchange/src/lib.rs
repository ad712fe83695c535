//! Robot descriptions of other programs: export as URDF and MJCF, import from URDF.

mod floor_prism;
pub mod import;
pub mod mjcf;
mod mjcf_bodies;
pub mod scaled_parameters;
mod side_name;
pub mod urdf;
mod xml_lines;

pub use floor_prism::FloorPrism;
