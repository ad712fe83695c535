//! The ports of an instance's processes: everything through which they exchange messages.

use iceoryx2::prelude::Node;

use crate::connect_lock::ConnectLock;
use crate::latest::LatestService;
use crate::leftovers::{clean_up, sweep_others};
use crate::shared_memory::Role;
use crate::{
    ConnectError, Instance, Ipc, LatestReader, LatestWriter, MeasurementMessage, PushServer, ReportPublisher,
    ReportSubscriber, RequestClient, RequestServer, SetpointMessage, TruePoseMessage,
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
    /// Another controller is running, or a plant of another version, for another mechanism, or with another rate, clock
    /// or start posture, or the shared memory is not usable or has no room.
    pub fn connect(instance: &Instance, mechanism: u64) -> Result<Self, ConnectError> {
        sweep_others(instance);
        let lock = instance.connect_lock()?;
        let node = join(instance, &lock, Role::Controller)?;
        let setpoint = LatestService::open::<SetpointMessage>(instance, &node, SETPOINT, mechanism)?;
        let measurement = LatestService::open::<MeasurementMessage>(instance, &node, MEASUREMENT, mechanism)?;
        check_start(&setpoint)?;
        let ports = Self {
            setpoints: setpoint.writer(Role::Controller)?,
            measurements: measurement.reader()?,
            reports: ReportPublisher::connect(instance, &node)?,
            // Last: operators take it as the sign that a controller is running.
            requests: RequestServer::connect(instance, &node)?,
        };
        instance.take_room(&lock, Role::Controller)?;
        Ok(ports)
    }
}

/// Joins an instance that no killed process has left half-made.
fn join(instance: &Instance, lock: &ConnectLock, role: Role) -> Result<Node<Ipc>, ConnectError> {
    clean_up(instance, lock)?;
    instance.open_node(lock, role)
}

/// Compares the start posture of both sides as long as no controller has moved the robot.
fn check_start(setpoint: &LatestService) -> Result<(), ConnectError> {
    if setpoint.reader::<SetpointMessage>()?.latest().is_none() { setpoint.check_start() } else { Ok(()) }
}

/// The plant's ports.
#[derive(Debug)]
pub struct PlantPorts {
    /// Setpoints, from the controller.
    pub setpoints: LatestReader<SetpointMessage>,
    /// Measurements, to the controller.
    pub measurements: LatestWriter<MeasurementMessage>,
    /// Requests to push the simulated robot, and the replies to them.
    pub pushes: PushServer,
    /// Where the simulated robot truly is, to anyone.
    pub true_poses: LatestWriter<TruePoseMessage>,
}

impl PlantPorts {
    /// Connects this process as the plant of an instance, for the robot with the fingerprint `mechanism`.
    ///
    /// # Errors
    /// Another plant is running, or a controller of another version, for another mechanism, or with another rate, clock
    /// or start posture, or the shared memory is not usable or has no room.
    pub fn connect(instance: &Instance, mechanism: u64) -> Result<Self, ConnectError> {
        sweep_others(instance);
        let lock = instance.connect_lock()?;
        let node = join(instance, &lock, Role::Plant)?;
        let setpoint = LatestService::open::<SetpointMessage>(instance, &node, SETPOINT, mechanism)?;
        let measurement = LatestService::open::<MeasurementMessage>(instance, &node, MEASUREMENT, mechanism)?;
        check_start(&setpoint)?;
        let true_pose = LatestService::open::<TruePoseMessage>(instance, &node, TRUE_POSE, mechanism)?;
        let ports = Self {
            measurements: measurement.writer(Role::Plant)?,
            setpoints: setpoint.reader()?,
            pushes: PushServer::connect(instance, &node)?,
            true_poses: true_pose.writer(Role::Plant)?,
        };
        instance.take_room(&lock, Role::Plant)?;
        Ok(ports)
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
        let lock = instance.connect_lock_if_there()?;
        let node = join(instance, &lock, Role::Operator)?;
        let ports = Self { requests: RequestClient::connect(instance, &node)? };
        instance.take_room(&lock, Role::Operator)?;
        Ok(ports)
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
        let lock = instance.connect_lock_if_there()?;
        let node = join(instance, &lock, Role::Observer)?;
        let ports = Self { reports: ReportSubscriber::connect(instance, &node)? };
        instance.take_room(&lock, Role::Observer)?;
        Ok(ports)
    }
}

/// The ports of a process that looks on: what the controller reports, and what its plant measures.
#[derive(Debug)]
pub struct SpectatorPorts {
    /// Reports, from the controller.
    pub reports: ReportSubscriber,
    /// Measurements, from the plant.
    pub measurements: LatestReader<MeasurementMessage>,
    /// Fingerprint of the robot that joint numbers refer to.
    pub mechanism: u64,
    /// Whether controller and plant wait for each other, so that their periods have no length by the wall clock.
    pub is_lockstep: bool,
}

impl SpectatorPorts {
    /// Connects this process as a spectator of an instance, whatever its robot, rate and clock. It also receives what
    /// any later controller and plant of the instance send.
    ///
    /// # Errors
    /// No controller is running, or one of another version, or too many observers are connected.
    pub fn connect(instance: &Instance) -> Result<Self, ConnectError> {
        let lock = instance.connect_lock_if_there()?;
        let node = join(instance, &lock, Role::Observer)?;
        let (measurements, mechanism, is_lockstep) = LatestService::watch(instance, &node, MEASUREMENT)?;
        let reports = ReportSubscriber::connect(instance, &node)?;
        let ports = Self { reports, measurements, mechanism, is_lockstep };
        instance.take_room(&lock, Role::Observer)?;
        Ok(ports)
    }
}

/// Where a simulated robot truly is.
#[derive(Debug)]
pub struct TruePoses {
    /// The poses, from the plant.
    pub poses: LatestReader<TruePoseMessage>,
}

impl TruePoses {
    /// Connects this process to the simulated plant of an instance; to a plant that knows no true pose there is no
    /// connection.
    ///
    /// # Errors
    /// No plant is running that tells where its robot is, or one of another version, or the shared memory has no room.
    pub fn connect(instance: &Instance) -> Result<Self, ConnectError> {
        let lock = instance.connect_lock_if_there()?;
        let node = join(instance, &lock, Role::Observer)?;
        let (poses, ..) = LatestService::watch(instance, &node, TRUE_POSE)?;
        instance.take_room(&lock, Role::Observer)?;
        Ok(Self { poses })
    }
}

const SETPOINT: &str = "setpoint";
const MEASUREMENT: &str = "measurement";
const TRUE_POSE: &str = "true-pose";
