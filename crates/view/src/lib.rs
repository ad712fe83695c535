//! A page in a browser that shows the robot and drives it.
//!
//! [`ViewServer`] serves one page on an address of this computer. It shows a robot that is running, or recorded runs
//! ([`Shown`]). Either way the page gets the same frames ([`ViewFrame`]), each the state of one instant; what it draws
//! of them is in `tools/view`.
//!
//! * A running robot is observed through its reports and measurements: neither controller nor plant waits for a page.
//! * One page at a time drives. Its commands are a stream of the client library `operator`, and stay in effect while
//!   the page shows signs of life. Any page may stop the robot.
//! * A socket is opened only by a page of this server and with the token that it prints.

mod access;
mod error;
mod fall_watch;
mod frame_assembler;
mod live_feed;
mod live_pages;
mod message;
mod placement;
mod pusher;
mod recorded_requests;
mod recorded_run;
mod robot_drawing;
mod rounded;
mod server;
mod socket;
mod teleoperation;
mod view_frame;

pub use error::ViewError;
pub use recorded_run::RecordedRun;
pub use robot_drawing::RobotDrawing;
pub use server::{RunningRobot, Shown, ViewServer};
pub use view_frame::ViewFrame;

#[cfg(test)]
mod tests {
    use config::Config;
    use interface::{Faults, HalfStep, Measurement, Mode, Odometry, Report};
    use model::{JointVector, Mechanism, Side, Wrench};
    use nalgebra::{Quaternion, Vector2, Vector3};

    use crate::ViewFrame;

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
        Report {
            mode: Mode::Standing,
            half_step: HalfStep::first(Side::Right),
            speed: 1.0,
            turn: 0.0,
            extension: 0.0,
            sidestep: 0.0,
            zmp_in_support: None,
            zmp_planned: None,
            margin: None,
            lean: Vector2::zeros(),
            added: None,
            com_planned: None,
            com_measured: None,
            odometry: Odometry::default(),
            destination: None,
            capturability: None,
            estimate: interface::StateEstimate::default(),
            faults: Faults::default(),
        }
    }

    /// A frame of a robot that stands.
    pub(crate) fn frame_at(t: f64) -> ViewFrame {
        ViewFrame {
            t,
            mode: "standing",
            support: 0,
            half_step: 0,
            progress: 0.0,
            gait: [1.0, 0.0, 0.0, 0.0],
            base: [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
            angles: [0.0; model::Joint::COUNT],
            zmp: None,
            zmp_planned: None,
            dcm: None,
            dcm_planned: None,
            margin: None,
            lean: [0.0; 2],
            added: None,
            pose: [0.0; 3],
            velocity: [0.0; 3],
            support_sole: [0.0; 3],
            landings: [[0.0; 3]; 2],
            destination: None,
            loads: [0.0; 2],
            capturability: "",
            faults: Vec::new(),
            missed: 0,
            compute_us: 0.0,
            jitter_us: 0.0,
        }
    }
}
