//! What a page shows of a walk, whoever walks: processes, a recording, or the page itself.
//!
//! A page gets the robot once ([`RobotDrawing`]), the floor near it where that is no plane ([`FloorCells`]), and then
//! frames ([`ViewFrame`]), each the state of one instant, which a [`FrameAssembler`] makes of reports and measurements.
//! [`ToPage`] and [`FromPage`] are the messages to and from a page; what it draws of them is in `tools/view`.

mod floor_cells;
mod frame_assembler;
mod message;
mod placement;
mod robot_drawing;
mod rounded;
mod view_frame;

pub use floor_cells::{FloorCell, FloorCells, FloorPiece};
pub use frame_assembler::FrameAssembler;
pub use message::{AskedPush, FromPage, RunNote, ToPage};
pub use robot_drawing::RobotDrawing;
pub use rounded::rounded;
pub use view_frame::ViewFrame;

#[cfg(test)]
mod tests {
    use config::Config;
    use interface::{Measurement, Mode, Report};
    use model::{JointVector, Mechanism, Wrench};
    use nalgebra::{Quaternion, Vector3};

    /// The paper's robot.
    pub(crate) fn mechanism() -> Mechanism {
        Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).expect("it loads")
    }

    /// What sensors say of a robot that stands straight.
    pub(crate) fn measured() -> Measurement {
        Measurement {
            sample: 0,
            angles: JointVector::ZERO,
            rates: JointVector::ZERO,
            feet: [Wrench::ZERO; 2],
            orientation: Quaternion::identity(),
            angular_rate: Vector3::zeros(),
            currents: JointVector::ZERO,
            specific_force: Vector3::z() * model::GRAVITY,
            missing: interface::SensorGroups::NONE,
        }
    }

    /// What a controller reports of a robot that stands.
    pub(crate) fn reported() -> Report {
        Report::of(Mode::Standing)
    }
}
