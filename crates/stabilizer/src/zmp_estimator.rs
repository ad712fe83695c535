//! Estimates the zero-moment point (ZMP) and the contacts of the feet from the measured ground reaction.

use dynamics::{Kinematics, SupportPolygon, zmp};
use model::{Mechanism, Mirror, Mirrored, Side, Sole, Wrench};
use nalgebra::{Isometry3, Point3, Vector2};
use signal::LowPass;

use crate::support_frame_measurement::SupportFrameMeasurement;

/// Estimates the ZMP from the wrenches on both feet. The wrenches are filtered, not the ZMP: so the ZMP always lies in
/// the support polygon, also while the weight shifts from foot to foot.
#[derive(Clone, Debug)]
pub struct ZmpEstimator {
    parameters: ZmpParameters,
    /// Of the support and of the swing sole, each in its frame.
    corners: [[Point3<f64>; Sole::CORNERS]; 2],
    /// Wrenches on the support and on the swing foot, each about the origin of its sole in sole axes.
    feet: Option<[LowPass<Wrench>; 2]>,
}

/// Parameters of [`ZmpEstimator`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZmpParameters {
    /// Vertical force from which a foot counts as in contact (N). Less does not show where it acts.
    pub force_min: f64,
    /// Time constant of the low-pass filter of the wrenches (s). Longer is smoother and later.
    pub time_constant: f64,
}

/// The ground reaction, in support coordinates. Pairs hold the support foot first, then the swing foot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactEstimate {
    /// Filtered ZMP (m); `None` when too little force acts to show where.
    pub zmp: Option<Vector2<f64>>,
    /// Signed distance of the ZMP to the edge of the support polygon (m); −∞ in the air.
    pub margin: f64,
    /// Filtered vertical force on each foot (N).
    pub loads: [f64; 2],
    /// Whether each foot carries enough to count as in contact.
    pub in_contact: [bool; 2],
}

impl ContactEstimate {
    /// No foot touches the ground.
    pub const AIRBORNE: Self = Self { zmp: None, margin: f64::NEG_INFINITY, loads: [0.0; 2], in_contact: [false; 2] };

    /// The support foot carries the weight (N), as planned, where its sensors do not tell.
    pub fn unknown(weight: f64) -> Self {
        Self { loads: [weight, 0.0], in_contact: [true, false], ..Self::AIRBORNE }
    }

    /// The other foot supports from now on. Where the ground pushes is known in its frame from the next sample on.
    pub fn change_support(&mut self) {
        self.loads.reverse();
        self.in_contact.reverse();
        self.zmp = None;
    }

    /// Share of the load on the swing foot (-); 0 in the air.
    pub fn swing_share(&self) -> f64 {
        let [support, swing] = [0, 1].map(|foot| if self.in_contact[foot] { self.loads[foot] } else { 0.0 });
        if swing > 0.0 { swing / (support + swing) } else { 0.0 }
    }
}

impl ZmpEstimator {
    /// An estimator without any measurement yet.
    pub fn new(mechanism: &Mechanism, parameters: ZmpParameters) -> Self {
        let corners = Side::BOTH.map(|side| mechanism.sole.corners(side).map(Point3::from));
        Self { parameters, corners, feet: None }
    }

    /// Absorbs a measurement.
    ///
    /// * `kinematics` – of the measured joint angles
    /// * `dt` – time since the last measurement (s)
    pub fn update(
        &mut self,
        measurement: &SupportFrameMeasurement,
        kinematics: &Kinematics,
        mechanism: &Mechanism,
        dt: f64,
    ) -> ContactEstimate {
        let now = [measurement.support_foot, measurement.swing_foot];
        let feet = match &mut self.feet {
            Some(feet) => [0, 1].map(|foot| feet[foot].update(now[foot], dt)),
            None => {
                self.feet = Some(now.map(|foot| LowPass::new(self.parameters.time_constant, foot)));
                now
            }
        };
        let loads = feet.map(|foot| foot.force.z);
        let in_contact = loads.map(|load| load >= self.parameters.force_min);

        let swing_sole = kinematics.sole_to_world(mechanism, Side::Left);
        let mut total = Wrench::ZERO;
        if in_contact[0] {
            total = total + feet[0];
        }
        if in_contact[1] {
            total = total + about_origin(&feet[1], &swing_sole);
        }
        let Some(point) = zmp(&total) else {
            return ContactEstimate { loads, in_contact, ..ContactEstimate::AIRBORNE };
        };

        let [right, left] = &self.corners;
        let right = right.iter().filter(|_| in_contact[0]).map(|corner| corner.coords.xy());
        let left = left.iter().filter(|_| in_contact[1]).map(|corner| (swing_sole * corner).coords.xy());
        let margin = SupportPolygon::hull(right.chain(left)).margin(point);
        ContactEstimate { zmp: Some(point), margin, loads, in_contact }
    }

    /// Expresses the filtered wrenches in support coordinates of the other foot, which supports from now on.
    pub fn change_support(&mut self, mirror: &Mirror) {
        self.feet =
            self.feet.map(|[support, swing]| [swing, support].map(|foot| foot.map(|wrench| wrench.mirrored(mirror))));
    }
}

/// Expresses a wrench about the origin of a sole, in its axes, as one about O in support axes.
fn about_origin(wrench: &Wrench, sole: &Isometry3<f64>) -> Wrench {
    let force = sole.rotation * wrench.force;
    Wrench { force, moment: sole.rotation * wrench.moment + sole.translation.vector.cross(&force) }
}

#[cfg(test)]
mod tests {
    use config::Config;
    use dynamics::Tree;
    use model::JointVector;
    use nalgebra::Vector3;

    use super::*;

    const PARAMETERS: ZmpParameters = ZmpParameters { force_min: 50.0, time_constant: 0.0 };

    fn mechanism() -> Mechanism {
        Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap()
    }

    /// A straight robot whose feet carry two vertical forces (N), each at a point ahead of its ankle (m).
    fn measurement(forces: [f64; 2], ahead: [f64; 2]) -> SupportFrameMeasurement {
        let [support_foot, swing_foot] = [0, 1]
            .map(|foot| Wrench::at_point(Vector3::new(0.0, 0.0, forces[foot]), Vector3::new(ahead[foot], 0.0, 0.0)));
        SupportFrameMeasurement {
            angles: JointVector::ZERO,
            rates: JointVector::ZERO,
            support_foot,
            swing_foot,
            up_in_trunk: Vector3::z(),
            trunk_rate: None,
            specific_force: None,
        }
    }

    fn estimate(forces: [f64; 2], ahead: [f64; 2]) -> ContactEstimate {
        let mechanism = mechanism();
        let kinematics = Kinematics::fixed_base(&Tree::new(&mechanism), &JointVector::ZERO);
        let measurement = measurement(forces, ahead);
        ZmpEstimator::new(&mechanism, PARAMETERS).update(&measurement, &kinematics, &mechanism, 1e-3)
    }

    /// The oracle: the mean of the points of both forces, weighted by the forces. The soles stand 0.19 m apart.
    #[test]
    fn zmp_on_both_feet_is_the_weighted_mean_of_both_points() {
        let estimate = estimate([300.0, 100.0], [0.02, 0.1]);
        let expected = Vector2::new(0.75 * 0.02 + 0.25 * 0.1, 0.25 * 0.19);
        assert!((estimate.zmp.unwrap() - expected).norm() < 1e-9, "{estimate:?}");
        assert_eq!(estimate.in_contact, [true, true]);
    }

    #[test]
    fn zmp_margin_on_one_foot_is_the_distance_to_its_edge() {
        let estimate = estimate([700.0, 20.0], [0.05, 0.1]);
        assert_eq!(estimate.in_contact, [true, false]);
        assert!((estimate.margin - 0.04).abs() < 1e-9, "{estimate:?}");
    }

    #[test]
    fn robot_in_the_air_has_no_zmp() {
        let estimate = estimate([20.0, 10.0], [0.0, 0.0]);
        assert_eq!((estimate.zmp, estimate.margin), (None, f64::NEG_INFINITY));
    }
}
