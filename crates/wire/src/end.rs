//! Ends: what a process holds of an instance.

use crate::newest::NewestService;
use crate::{
    ConnectError, Instance, MeasurementMessage, NewestReader, NewestWriter, ReportPublisher, ReportSubscriber,
    RequestClient, RequestServer, SetpointMessage,
};

/// What the controller holds. Its parts may go to different threads: setpoints and measurements to the loop, requests
/// and reports beside it.
#[derive(Debug)]
pub struct ControllerEnd {
    /// Tells the plant where the joints shall be.
    pub setpoints: NewestWriter<SetpointMessage>,
    /// Hears from the plant what the sensors say.
    pub measurements: NewestReader<MeasurementMessage>,
    /// Hears what operators ask, and answers.
    pub requests: RequestServer,
    /// Tells observers what happened.
    pub reports: ReportPublisher,
}

impl ControllerEnd {
    /// Becomes the controller of an instance, for the robot with the fingerprint `mechanism`.
    ///
    /// # Errors
    /// Another controller is there, or a plant of another version or for another mechanism, or the shared memory is
    /// not usable.
    pub fn connect(instance: &Instance, mechanism: u64) -> Result<Self, ConnectError> {
        let turn = instance.turn()?;
        let node = instance.join(&turn, "controller")?;
        let setpoint = NewestService::join::<SetpointMessage>(instance, &node, SETPOINT, mechanism)?;
        let measurement = NewestService::join::<MeasurementMessage>(instance, &node, MEASUREMENT, mechanism)?;
        Ok(Self {
            setpoints: setpoint.writer("controller")?,
            measurements: measurement.reader()?,
            reports: ReportPublisher::connect(instance, &node)?,
            // Last: operators take it as the sign that a controller is there.
            requests: RequestServer::connect(instance, &node)?,
        })
    }
}

/// What the plant holds.
#[derive(Debug)]
pub struct PlantEnd {
    /// Hears from the controller where the joints shall be.
    pub setpoints: NewestReader<SetpointMessage>,
    /// Tells the controller what the sensors say.
    pub measurements: NewestWriter<MeasurementMessage>,
}

impl PlantEnd {
    /// Becomes the plant of an instance, for the robot with the fingerprint `mechanism`.
    ///
    /// # Errors
    /// Another plant is there, or a controller of another version or for another mechanism, or the shared memory is
    /// not usable.
    pub fn connect(instance: &Instance, mechanism: u64) -> Result<Self, ConnectError> {
        let turn = instance.turn()?;
        let node = instance.join(&turn, "plant")?;
        let setpoint = NewestService::join::<SetpointMessage>(instance, &node, SETPOINT, mechanism)?;
        let measurement = NewestService::join::<MeasurementMessage>(instance, &node, MEASUREMENT, mechanism)?;
        Ok(Self { measurements: measurement.writer("plant")?, setpoints: setpoint.reader()? })
    }
}

/// What an operator holds.
#[derive(Debug)]
pub struct OperatorEnd {
    /// Asks the controller.
    pub requests: RequestClient,
}

impl OperatorEnd {
    /// Joins an instance to ask its controller.
    ///
    /// # Errors
    /// No controller is there, or one of another version, or there are too many operators already.
    pub fn connect(instance: &Instance) -> Result<Self, ConnectError> {
        let turn = instance.turn()?;
        let node = instance.join(&turn, "operator")?;
        Ok(Self { requests: RequestClient::connect(instance, &node)? })
    }
}

/// What an observer holds.
#[derive(Debug)]
pub struct ObserverEnd {
    /// Hears from the controller what happened.
    pub reports: ReportSubscriber,
}

impl ObserverEnd {
    /// Joins an instance to listen to its controller. If the controller leaves and another one comes, its reports are
    /// heard too.
    ///
    /// # Errors
    /// No controller is there, or one of another version, or there are too many observers already.
    pub fn connect(instance: &Instance) -> Result<Self, ConnectError> {
        let turn = instance.turn()?;
        let node = instance.join(&turn, "observer")?;
        Ok(Self { reports: ReportSubscriber::connect(instance, &node)? })
    }
}

const SETPOINT: &str = "setpoint";
const MEASUREMENT: &str = "measurement";
