//! What a rectangular sole holds by friction: the closed form of Caron, Pham and Nakamura (2015), "Stability of surface
//! contacts for humanoid robots".

use model::{Side, Sole, Wrench};
use nalgebra::Vector3;

/// Friction under one sole.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SoleFriction {
    /// Coefficient of friction.
    coefficient: f64,
    /// Half of the sole's length (m).
    half_length: f64,
    /// Half of the sole's width (m).
    half_width: f64,
    /// Centre of the sole, in the sole frame (m).
    centre: Vector3<f64>,
}

impl SoleFriction {
    /// The right sole on ground with a coefficient of friction.
    pub(crate) fn new(sole: &Sole, coefficient: f64) -> Self {
        Self {
            coefficient,
            half_length: sole.half_size().x,
            half_width: sole.half_size().y,
            centre: sole.centre(Side::Right).push(0.0),
        }
    }

    /// Force along the ground per force into it (-); none where the ground carries nothing.
    ///
    /// * `ground` – wrench of the ground about the origin of the sole frame, in its axes
    pub(crate) fn slip(&self, ground: &Wrench) -> f64 {
        if ground.force.z > 0.0 { ground.force.xy().norm() / ground.force.z } else { 0.0 }
    }

    /// The moment about the normal up to which friction holds besides the forces of a wrench, if the wrench has a
    /// larger one (N·m).
    ///
    /// * `ground` – wrench of the ground about the origin of the sole frame, in its axes
    pub(crate) fn exceeded_yaw_torque(&self, ground: &Wrench) -> Option<f64> {
        let Self { coefficient, half_length, half_width, centre } = *self;
        let force = ground.force;
        // The forces act along the ground: about the centre they have a moment about the normal, too.
        let moment = ground.about(centre).moment;
        let whole = coefficient * (half_length + half_width) * force.z;
        let taken = |sign: f64| {
            (half_width * force.x + sign * coefficient * moment.x).abs()
                + (half_length * force.y + sign * coefficient * moment.y).abs()
        };
        let (min, max) = (taken(-1.0) - whole, whole - taken(1.0));
        let is_held = min > max || (min..=max).contains(&moment.z);
        (!is_held).then(|| moment.z.clamp(min, max) + ground.moment.z - moment.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOLE: Sole = Sole { behind: 0.07, ahead: 0.21, inside: 0.04, outside: 0.04, ankle_height: 0.1 };

    fn friction() -> SoleFriction {
        SoleFriction::new(&SOLE, 0.6)
    }

    /// A vertical force of 700 N at a point of the sole, with a moment about the vertical.
    fn ground(x: f64, y: f64, moment: f64) -> Wrench {
        let force = Wrench::at_point(Vector3::new(0.0, 0.0, 700.0), Vector3::new(x, y, 0.0));
        Wrench { moment: force.moment + Vector3::new(0.0, 0.0, moment), ..force }
    }

    /// The oracle: forces at the four corners, each as large as friction admits and across the arm to the centre in
    /// the friction pyramid, hold `μ·F·(X + Y)`.
    #[test]
    fn a_sole_that_bears_at_its_centre_holds_the_moment_of_its_corners() {
        let bound = 0.6 * 700.0 * (0.14 + 0.04);
        let exceeded = |moment| friction().exceeded_yaw_torque(&ground(0.07, 0.0, moment));
        assert!((exceeded(200.0).unwrap() - bound).abs() < 1e-9);
        assert!((exceeded(-200.0).unwrap() + bound).abs() < 1e-9);
        assert_eq!(exceeded(50.0), None);
    }

    #[test]
    fn a_sole_that_bears_on_its_toe_edge_holds_what_its_width_does() {
        let bound = friction().exceeded_yaw_torque(&ground(0.21, 0.0, 50.0)).unwrap();
        assert!((bound - 0.6 * 700.0 * 0.04).abs() < 1e-9, "{bound}");
    }

    #[test]
    fn forces_along_the_ground_count_per_force_into_it() {
        let force = Vector3::new(30.0, -40.0, 100.0);
        assert_eq!(friction().slip(&Wrench { force, moment: Vector3::zeros() }), 0.5);
        let pulled = Vector3::new(30.0, -40.0, -1.0);
        assert_eq!(friction().slip(&Wrench { force: pulled, moment: Vector3::zeros() }), 0.0);
    }
}
