//! Where the ground really pushes: the measured zero-moment point (DESIGN §5.1).

use dynamics::{Kinematics, SupportPolygon, zmp};
use model::{Mechanism, Side, Wrench};
use nalgebra::{Isometry3, Vector2};

use crate::{Sensed, ZmpParameters};

/// Estimates the ZMP from the wrenches on both feet.
#[derive(Clone, Debug)]
pub struct ZmpEstimator {
    parameters: ZmpParameters,
    corners: [nalgebra::Point3<f64>; 4],
    filtered: Option<Vector2<f64>>,
}

/// What the ground does, told in support coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Filtered ZMP [m]; `None` when too little force says where it is.
    pub zmp: Option<Vector2<f64>>,
    /// Signed distance to the edge of what bears [m]; −∞ in the air.
    pub margin: f64,
    /// Vertical force on the bearing and on the swinging foot [N].
    pub loads: [f64; 2],
}

impl ZmpEstimator {
    /// An estimator that has seen nothing yet.
    pub fn new(mechanism: &Mechanism, parameters: ZmpParameters) -> Self {
        Self { parameters, corners: mechanism.sole.corners().map(nalgebra::Point3::from), filtered: None }
    }

    /// Absorbs a measurement, `dt` seconds after the last one.
    pub fn update(&mut self, sensed: &Sensed, kinematics: &Kinematics, mechanism: &Mechanism, dt: f64) -> Ground {
        let loads = [sensed.bearing_foot.force.z, sensed.swinging_foot.force.z];
        let bears = loads.map(|load| load >= self.parameters.force_min);

        // The swinging foot's wrench, told about O.
        let swinging_sole = kinematics.sole_to_world(mechanism, Side::Left);
        let mut total = Wrench::ZERO;
        if bears[0] {
            total = total + sensed.bearing_foot;
        }
        if bears[1] {
            total = total + told_from_origin(&sensed.swinging_foot, &swinging_sole);
        }
        if total.force.z < self.parameters.force_min {
            self.filtered = None;
            return Ground { zmp: None, margin: f64::NEG_INFINITY, loads };
        }

        let measured = zmp(&total);
        self.filtered = match (self.filtered, measured) {
            (Some(filtered), Some(now)) => {
                Some(filtered + (now - filtered) * (dt / (dt + self.parameters.time_constant)))
            }
            (_, now) => now,
        };

        let right = self.corners.iter().filter(|_| bears[0]).map(|corner| corner.coords.xy());
        let left = self.corners.iter().filter(|_| bears[1]).map(|corner| (swinging_sole * corner).coords.xy());
        let polygon = SupportPolygon::hull(right.chain(left));
        let margin = self.filtered.map_or(f64::NEG_INFINITY, |point| polygon.margin(point));
        Ground { zmp: self.filtered, margin, loads }
    }

    /// At a swap the same point is told from the other foot: begins anew rather than smear the jump of coordinates.
    pub fn swap(&mut self) {
        self.filtered = None;
    }
}

/// A wrench about a sole's origin in its axes, told about O in support axes.
fn told_from_origin(wrench: &Wrench, sole: &Isometry3<f64>) -> Wrench {
    let force = sole.rotation * wrench.force;
    Wrench { force, moment: sole.rotation * wrench.moment + sole.translation.vector.cross(&force) }
}
