//! Where the walk is: dead reckoning over the soles that bear, with the heading of the inertial measurement unit.
//!
//! A sole that bears stands still. The next one is where the measured joints put it when it takes over. Headings would
//! drift by the slip of every turn; the inertial measurement unit tells them without.

use dynamics::{Kinematics, atan2, pose_in_frame_of, pose_seen_from, sin_cos};
use interface::{Odometry, WalkPose, WalkVelocity};
use model::{Mechanism, Side};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

/// Time constant with which the heading of the support sole follows the measured one (s): shorter than a half-step,
/// longer than noise.
const HEADING_TIME_CONSTANT: f64 = 0.05;

/// Dead reckoning of the walk. Everything is in physical coordinates: nothing is mirrored.
#[derive(Clone, Debug)]
pub struct WalkOdometry {
    support: Side,
    /// The support sole in the walk frame.
    sole: WalkPose,
    /// The swing sole in the frame of the support sole.
    swing_in_support: WalkPose,
    /// Heading of the trunk in the walk frame less that of the inertial measurement unit (rad), once one was measured.
    heading_offset: Option<f64>,
    /// The pose at the last support changes, the newest first, with the time since each (s).
    changes: [Option<(WalkPose, f64)>; 3],
    /// Mean velocity over the last full step.
    velocity: WalkVelocity,
}

impl WalkOdometry {
    /// At the start.
    ///
    /// * `kinematics` – of the first posture, in support coordinates of the foot on `support`
    pub fn new(mechanism: &Mechanism, kinematics: &Kinematics, support: Side) -> Self {
        let swing_in_support = swing_sole(mechanism, kinematics, support);
        let mut odometry = Self {
            support,
            sole: WalkPose::default(),
            swing_in_support,
            heading_offset: None,
            changes: [None; 3],
            velocity: WalkVelocity::default(),
        };
        // The middle between the feet is the origin.
        let middle = odometry.pose();
        odometry.sole.heading = -middle.heading;
        let turned = odometry.pose();
        (odometry.sole.x, odometry.sole.y) = (-turned.x, -turned.y);
        odometry
    }

    /// Absorbs a period.
    ///
    /// * `support` – the support foot
    /// * `kinematics` – of the joint angles, measured or else commanded, in support coordinates
    /// * `orientation` – of the trunk as the inertial measurement unit has it, if there is a valid sample
    /// * `dt` – length of the period (s)
    pub fn update(
        &mut self,
        mechanism: &Mechanism,
        support: Side,
        kinematics: &Kinematics,
        orientation: Option<&UnitQuaternion<f64>>,
        dt: f64,
    ) {
        self.support_on(support);
        self.swing_in_support = swing_sole(mechanism, kinematics, self.support);
        for (_, since) in self.changes.iter_mut().flatten() {
            *since += dt;
        }
        self.forget_velocity();
        let Some(orientation) = orientation else { return };
        let over_sole = self.support.lateral_sign() * heading_of(&kinematics.rotation[Mechanism::TRUNK]);
        let sensed = heading_of(orientation.to_rotation_matrix().matrix());
        let offset = *self.heading_offset.get_or_insert(self.sole.heading + over_sole - sensed);
        let difference = wrapped(sensed + offset - over_sole - self.sole.heading);
        self.sole.heading += difference * dt / (HEADING_TIME_CONSTANT + dt);
    }

    /// The foot on `support` bears from now on, if it does not yet.
    pub fn support_on(&mut self, support: Side) {
        if support == self.support {
            return;
        }
        let pose = self.pose();
        let before = self.sole;
        self.sole = pose_in_frame_of(&before, &self.swing_in_support);
        self.swing_in_support = pose_seen_from(&self.sole, &before);
        self.support = support;
        self.changes.rotate_right(1);
        self.changes[0] = Some((pose, 0.0));
        if let Some((earlier, since)) = self.changes[2] {
            let between = WalkPose { heading: (pose.heading + earlier.heading) / 2.0, ..earlier };
            let seen = pose_seen_from(&between, &pose);
            let turned = pose.heading - earlier.heading;
            self.velocity = WalkVelocity { ahead: seen.x / since, left: seen.y / since, turn: turned / since };
        }
    }

    /// Once no step follows the last one for longer than a full step has taken, the robot does not move.
    fn forget_velocity(&mut self) {
        if let [Some((_, since)), _, Some((_, earlier))] = self.changes
            && since > earlier - since
        {
            self.changes = [None; 3];
            self.velocity = WalkVelocity::default();
        }
    }

    /// The middle between both soles.
    fn pose(&self) -> WalkPose {
        let WalkPose { x, y, heading } = self.swing_in_support;
        pose_in_frame_of(&self.sole, &WalkPose { x: x / 2.0, y: y / 2.0, heading: heading / 2.0 })
    }

    /// Where the walk is.
    ///
    /// * `landings` – of the swing foot and of the support foot after it, in the frame of the support sole
    pub fn report(&self, landings: &[WalkPose; 2]) -> Odometry {
        let landings = landings.map(|landing| pose_in_frame_of(&self.sole, &landing));
        Odometry { pose: self.pose(), velocity: self.velocity, support_sole: self.sole, landings }
    }
}

/// The swing sole in the frame of the support sole, not mirrored.
fn swing_sole(mechanism: &Mechanism, kinematics: &Kinematics, support: Side) -> WalkPose {
    let sole = kinematics.sole_to_world(mechanism, Side::Left);
    let (place, side) = (sole.translation.vector, support.lateral_sign());
    let heading = heading_of(sole.rotation.to_rotation_matrix().matrix());
    WalkPose { x: place.x, y: side * place.y, heading: side * heading }
}

/// Where the x axis of a rotated frame points (rad).
fn heading_of(rotation: &Matrix3<f64>) -> f64 {
    let ahead: Vector3<f64> = rotation.column(0).into();
    atan2(ahead.y, ahead.x)
}

/// An angle between −π and π (rad).
fn wrapped(angle: f64) -> f64 {
    let (sine, cosine) = sin_cos(angle);
    atan2(sine, cosine)
}
