//! The controller: what to do in each control period.
//!
//! [`Controller::tick`] takes the period's length and the newest measurement, and returns a setpoint and a report. It
//! never allocates, blocks, logs or fails: bad input becomes a [`Fault`](interface::Fault) in the report, and the same
//! inputs give the same bits. There is no clock here, and no I/O after [`Controller::new`]. [`Driver::step`] is a whole
//! control period with requests: use it rather than the controller's parts.

mod admission_control;
mod admission_job;
mod command_arbiter;
mod controller;
mod destination_admission;
mod drive_deflection;
mod driver;
mod gravity_consistency;
mod joint_limiter;
mod joint_residual;
mod limit_objection;
mod localization;
mod measurement_validator;
mod operating_state;
mod parameters;
mod pattern;
mod plausibility;
mod recovery;
mod rejected_sensors;
mod report;
mod request_schedule;
mod sensor_consistency;
mod validator_parameters;

pub use admission_job::AdmissionJob;
pub use command_arbiter::{ArbiterParameters, CommandArbiter};
pub use controller::Controller;
pub use driver::{AdmissionTiming, AdmissionWorker, Driver, InlineWorker, Step};
pub use joint_limiter::JointLimiter;
pub use measurement_validator::MeasurementValidator;
pub use parameters::Parameters;
pub use pattern::Compensation;
pub use report::Tick;
pub use request_schedule::{DueRequest, RequestAnswer, RequestId, RequestSchedule};
pub use sensor_consistency::ConsistencyParameters;
pub use validator_parameters::ValidatorParameters;
