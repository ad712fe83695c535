//! The zero-moment point (ZMP) over a half-step, in two independent ways: by inverse dynamics of every instant, and by
//! the `c²` law, which needs none.
//!
//! A half-step's path fixes two wrenches at every instant: one carries the weight, the other drives the motion at
//! nominal speed. The same path at speed `c` leaves the first and multiplies the second by `c²`, so the ZMP at any
//! speed is two sums and a division. The nominal table holds both wrenches; for a path modified by turn, extension or
//! lean [`GroundSplit::of_motion`] computes them once, for all speeds.

use dynamics::{NewtonEuler, Tree, wrench_at_speed, zmp};
use model::{Motion, Sole, Wrench};
use nalgebra::Vector2;

/// The wrench of the ground about O at one instant, in support axes, split by its dependence on speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundSplit {
    /// The part that carries the weight, at any speed.
    pub gravity: Wrench,
    /// The part that drives the motion at nominal speed; grows with `c²`.
    pub dynamic: Wrench,
}

impl GroundSplit {
    /// Splits the wrench of a motion at nominal speed.
    pub fn of_motion(inverse: &mut NewtonEuler, tree: &Tree, at_nominal_speed: &Motion) -> Self {
        inverse.compute_fixed_base(tree, &Motion::at_rest(at_nominal_speed.angles));
        let gravity = inverse.ground;
        inverse.compute_with_gravity(tree, at_nominal_speed, 0.0);
        Self { gravity, dynamic: inverse.ground }
    }

    /// The ZMP at constant `speed` `c`, relative to O (m); infinitely far away if the ground would have to pull.
    #[inline]
    pub fn zmp(&self, speed: f64) -> Vector2<f64> {
        point(&wrench_at_speed(&self.gravity, &self.dynamic, speed))
    }
}

/// The ZMP path at constant `speed` `c` by the `c²` law, relative to O (m).
pub fn zmp_by_speed_law(splits: &[GroundSplit], speed: f64) -> impl Iterator<Item = Vector2<f64>> {
    splits.iter().map(move |split| split.zmp(speed))
}

/// The ZMP path of motions by inverse dynamics of their real rates and accelerations, relative to O (m).
pub fn zmp_by_newton_euler(tree: &Tree, motions: &[Motion]) -> impl Iterator<Item = Vector2<f64>> {
    let mut inverse = NewtonEuler::default();
    motions.iter().map(move |motion| {
        inverse.compute_fixed_base(tree, motion);
        point(&inverse.ground)
    })
}

/// The extents of a ZMP path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZmpExtents {
    /// Least x and y, relative to O (m).
    pub min: Vector2<f64>,
    /// Greatest x and y, relative to O (m).
    pub max: Vector2<f64>,
    /// Least signed distance to the sole's edge (m): negative when some point lies outside.
    pub margin: f64,
}

impl ZmpExtents {
    /// The extents of a path under the support sole. An empty path has an infinite margin.
    pub fn of_path(path: impl IntoIterator<Item = Vector2<f64>>, sole: &Sole) -> Self {
        let nothing = Self {
            min: Vector2::repeat(f64::INFINITY),
            max: Vector2::repeat(f64::NEG_INFINITY),
            margin: f64::INFINITY,
        };
        path.into_iter().fold(nothing, |extents, point| Self {
            min: extents.min.inf(&point),
            max: extents.max.sup(&point),
            margin: extents.margin.min(sole.margin(point.x, point.y)),
        })
    }

    /// Whether every point lies inside the sole.
    pub fn is_inside(&self) -> bool {
        self.margin > 0.0
    }
}

/// Where a wrench acts; infinitely far away if no ground reaction is needed.
#[inline]
pub(crate) fn point(ground: &Wrench) -> Vector2<f64> {
    zmp(ground).unwrap_or(Vector2::repeat(f64::INFINITY))
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    const SOLE: Sole = Sole { behind: 0.07, ahead: 0.21, inside: 0.04, outside: 0.04, ankle_height: 0.07 };

    #[test]
    fn zmp_path_is_outside_the_sole_when_one_point_is() {
        let path = [Vector2::new(0.1, 0.0), Vector2::new(-0.08, 0.01), Vector2::new(0.0, -0.03)];
        let extents = ZmpExtents::of_path(path, &SOLE);
        assert_eq!((extents.min, extents.max), (Vector2::new(-0.08, -0.03), Vector2::new(0.1, 0.01)));
        assert!((extents.margin + 0.01).abs() < 1e-15 && !extents.is_inside());
        assert!(ZmpExtents::of_path(path[..1].iter().copied(), &SOLE).is_inside());
    }

    #[test]
    fn zmp_is_infinitely_far_when_the_ground_would_have_to_pull() {
        let gravity = Wrench { force: Vector3::new(0.0, 0.0, 700.0), moment: Vector3::zeros() };
        let split = GroundSplit { gravity, dynamic: gravity * -1.0 };
        assert!(ZmpExtents::of_path([split.zmp(0.5)], &SOLE).is_inside());
        assert_eq!(ZmpExtents::of_path([split.zmp(2.0)], &SOLE).margin, f64::NEG_INFINITY);
    }
}
