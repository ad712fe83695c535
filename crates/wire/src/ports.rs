//! The ports of an instance's processes: everything through which they exchange messages.

use crate::latest::LatestService;
use crate::{
    ConnectError, Instance, LatestReader, LatestWriter, MeasurementMessage, ReportPublisher, ReportSubscriber,
    RequestClient, RequestServer, SetpointMessage,
};

/// The controller's ports. They may move to different threads: setpoints and measurements to the control loop, requests
/// and reports to a thread beside it.
#[derive(Debug)]
pub struct ControllerPorts {
    /// Setpoints, to the plant.
    pub setpoints: LatestWriter<SetpointMessage>,
    /// Measurements, from the plant.
    pub measurements: LatestReader<MeasurementMessage>,
    /// Requests from operators, and the replies to them.
    pub requests: RequestServer,
    /// Reports, to observers.
    pub reports: ReportPublisher,
}

impl ControllerPorts {
    /// Connects this process as the controller of an instance, for the robot with the fingerprint `mechanism`.
    ///
    /// # Errors
    /// Another controller is running, or a plant of another version or for another mechanism, or the shared memory is
    /// not usable.
    pub fn connect(instance: &Instance, mechanism: u64) -> Result<Self, ConnectError> {
        let lock = instance.connect_lock()?;
        let node = instance.open_node(&lock, "controller")?;
        let setpoint = LatestService::open::<SetpointMessage>(instance, &node, SETPOINT, mechanism)?;
        let measurement = LatestService::open::<MeasurementMessage>(instance, &node, MEASUREMENT, mechanism)?;
        Ok(Self {
            setpoints: setpoint.writer("controller")?,
            measurements: measurement.reader()?,
            reports: ReportPublisher::connect(instance, &node)?,
            // Last: operators take it as the sign that a controller is running.
            requests: RequestServer::connect(instance, &node)?,
        })
    }
}

/// The plant's ports.
#[derive(Debug)]
pub struct PlantPorts {
    /// Setpoints, from the controller.
    pub setpoints: LatestReader<SetpointMessage>,
    /// Measurements, to the controller.
    pub measurements: LatestWriter<MeasurementMessage>,
}

impl PlantPorts {
    /// Connects this process as the plant of an instance, for the robot with the fingerprint `mechanism`.
    ///
    /// # Errors
    /// Another plant is running, or a controller of another version or for another mechanism, or the shared memory is
    /// not usable.
    pub fn connect(instance: &Instance, mechanism: u64) -> Result<Self, ConnectError> {
        let lock = instance.connect_lock()?;
        let node = instance.open_node(&lock, "plant")?;
        let setpoint = LatestService::open::<SetpointMessage>(instance, &node, SETPOINT, mechanism)?;
        let measurement = LatestService::open::<MeasurementMessage>(instance, &node, MEASUREMENT, mechanism)?;
        Ok(Self { measurements: measurement.writer("plant")?, setpoints: setpoint.reader()? })
    }
}

/// An operator's port.
#[derive(Debug)]
pub struct OperatorPorts {
    /// Requests to the controller, and its replies.
    pub requests: RequestClient,
}

impl OperatorPorts {
    /// Connects this process as an operator of an instance.
    ///
    /// # Errors
    /// No controller is running, or one of another version, or too many operators are connected.
    pub fn connect(instance: &Instance) -> Result<Self, ConnectError> {
        let lock = instance.connect_lock()?;
        let node = instance.open_node(&lock, "operator")?;
        Ok(Self { requests: RequestClient::connect(instance, &node)? })
    }
}

/// An observer's port.
#[derive(Debug)]
pub struct ObserverPorts {
    /// Reports, from the controller.
    pub reports: ReportSubscriber,
}

impl ObserverPorts {
    /// Connects this process as an observer of an instance. It also receives the reports of any later controller of the
    /// instance.
    ///
    /// # Errors
    /// No controller is running, or one of another version, or too many observers are connected.
    pub fn connect(instance: &Instance) -> Result<Self, ConnectError> {
        let lock = instance.connect_lock()?;
        let node = instance.open_node(&lock, "observer")?;
        Ok(Self { reports: ReportSubscriber::connect(instance, &node)? })
    }
}

const SETPOINT: &str = "setpoint";
const MEASUREMENT: &str = "measurement";
