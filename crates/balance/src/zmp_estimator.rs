//! Where the ground really pushes: the measured zero-moment point (DESIGN §5.1).

use dynamics::{Kinematics, SupportPolygon, zmp};
use model::{Mechanism, Side, Sole, Wrench};
use nalgebra::{Isometry3, Point3, Vector2};

use crate::{Sensed, ZmpParameters};

/// Estimates the ZMP from the wrenches on both feet. The wrenches are filtered, not the point: so the point always lies
/// in the polygon of what bears, also while the weight goes from foot to foot.
#[derive(Clone, Debug)]
pub struct ZmpEstimator {
    parameters: ZmpParameters,
    corners: [Point3<f64>; Sole::CORNERS],
    /// Filtered wrenches on the bearing and on the swinging foot, each about its sole's origin in sole axes.
    feet: Option<[Wrench; 2]>,
}

/// What the ground does, told in support coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Filtered ZMP [m]; `None` when too little force says where it is.
    pub zmp: Option<Vector2<f64>>,
    /// Signed distance to the edge of what bears [m]; −∞ in the air.
    pub margin: f64,
    /// Vertical force on the bearing and on the swinging foot, filtered [N].
    pub loads: [f64; 2],
    /// Whether the bearing and the swinging foot bear enough to count.
    pub bears: [bool; 2],
}

impl ZmpEstimator {
    /// An estimator that has seen nothing yet.
    pub fn new(mechanism: &Mechanism, parameters: ZmpParameters) -> Self {
        Self { parameters, corners: mechanism.sole.corners().map(Point3::from), feet: None }
    }

    /// Absorbs a measurement, `dt` seconds after the last one.
    pub fn update(&mut self, sensed: &Sensed, kinematics: &Kinematics, mechanism: &Mechanism, dt: f64) -> Ground {
        let now = [sensed.bearing_foot, sensed.swinging_foot];
        let share = dt / (dt + self.parameters.time_constant);
        let feet = self.feet.map_or(now, |feet| [0, 1].map(|foot| feet[foot] + (now[foot] - feet[foot]) * share));
        self.feet = Some(feet);
        let loads = feet.map(|foot| foot.force.z);
        let bears = loads.map(|load| load >= self.parameters.force_min);

        let swinging_sole = kinematics.sole_to_world(mechanism, Side::Left);
        let mut total = Wrench::ZERO;
        if bears[0] {
            total = total + feet[0];
        }
        if bears[1] {
            total = total + told_from_origin(&feet[1], &swinging_sole);
        }
        let Some(point) = zmp(&total) else { return Ground { zmp: None, margin: f64::NEG_INFINITY, loads, bears } };

        let right = self.corners.iter().filter(|_| bears[0]).map(|corner| corner.coords.xy());
        let left = self.corners.iter().filter(|_| bears[1]).map(|corner| (swinging_sole * corner).coords.xy());
        let margin = SupportPolygon::hull(right.chain(left)).margin(point);
        Ground { zmp: Some(point), margin, loads, bears }
    }

    /// The other foot bears: the same wrenches, told from there.
    pub fn swap(&mut self) {
        self.feet = self.feet.map(|[bearing, swinging]| [swinging.mirrored(), bearing.mirrored()]);
    }
}

/// A wrench about a sole's origin in its axes, told about O in support axes.
fn told_from_origin(wrench: &Wrench, sole: &Isometry3<f64>) -> Wrench {
    let force = sole.rotation * wrench.force;
    Wrench { force, moment: sole.rotation * wrench.moment + sole.translation.vector.cross(&force) }
}
