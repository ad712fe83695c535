//! Turned feet land far enough apart: the heel of a long sole turns towards the other foot.

use dynamics::sin_cos;
use model::{LegReach, Mechanism, Side, Sole};
use nalgebra::Vector2;

use crate::footprint::SolePose;

/// Where a sole may land beside the support sole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SoleSpacing {
    sole: Sole,
    /// Least gap between the edges of both soles (m).
    gap: f64,
}

/// Gap that is kept by the paper's robot, a little more than admission control asks for (m).
const GAP: f64 = 0.023;
/// Rounds of the search: each leaves a quarter of the error or less.
const ROUNDS: usize = 6;

impl SoleSpacing {
    /// For a robot. Soles that are nearer when the feet stand side by side need not be further apart when turned.
    pub(crate) fn of(mechanism: &Mechanism) -> Self {
        let sole = mechanism.sole;
        let side_by_side = mechanism.foot_distance() - 2.0 * sole.inside;
        Self { sole, gap: (GAP * LegReach::of(mechanism).scale()).min(side_by_side) }
    }

    /// The landing, or one further out from the support foot, across the heading between both feet.
    pub(crate) fn kept(&self, landing: &SolePose) -> SolePose {
        let lacking = self.lacking(landing);
        if lacking > 0.0 { Self::further_out(landing, lacking) } else { *landing }
    }

    /// How much further out a sole must land (m).
    pub(crate) fn lacking(&self, landing: &SolePose) -> f64 {
        let mut out = 0.0;
        for _ in 0..ROUNDS {
            out += self.short_of_gap(&Self::further_out(landing, out));
        }
        out
    }

    fn further_out(landing: &SolePose, out: f64) -> SolePose {
        let (sine, cosine) = sin_cos(0.5 * landing.yaw);
        let mut further = *landing;
        further.position.x -= sine * out;
        further.position.y += cosine * out;
        further
    }

    /// How much nearer than the gap the nearest corner of a sole is to the support sole, measured across that (m).
    fn short_of_gap(&self, landing: &SolePose) -> f64 {
        let Self { sole, gap } = self;
        let (sine, cosine) = sin_cos(landing.yaw);
        let short = sole.corners(Side::Left).map(|corner| {
            let at = landing.position.xy()
                + Vector2::new(cosine * corner.x - sine * corner.y, sine * corner.x + cosine * corner.y);
            // Past toe or heel less is needed.
            let past = (at.x - sole.ahead).max(-sole.behind - at.x).max(0.0);
            let across = (gap * gap - past * past).max(0.0).sqrt();
            if past < *gap { sole.inside + across - at.y } else { 0.0 }
        });
        short.into_iter().fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use config::Config;
    use nalgebra::Vector3;

    use super::*;

    fn spacing(sole: impl Fn(&mut Sole)) -> (SoleSpacing, f64) {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml");
        let mut mechanism = Mechanism::load(file).unwrap();
        sole(&mut mechanism.sole);
        (SoleSpacing::of(&mechanism), mechanism.foot_distance())
    }

    /// Beside the support foot, both turned by half of `yaw` against the heading between them.
    fn beside(width: f64, yaw: f64) -> SolePose {
        let (sine, cosine) = (0.5 * yaw).sin_cos();
        SolePose { position: Vector3::new(-sine * width, cosine * width, 0.0), yaw }
    }

    /// The oracle: the distance of points on the edges of both soles.
    fn gap_of(spacing: &SoleSpacing, landing: &SolePose) -> f64 {
        let edge = |side: Side| {
            let corners = spacing.sole.corners(side).map(|corner| corner.xy());
            (0..400).map(move |step| {
                let (corner, along) = (step / 100, f64::from(step % 100) / 100.0);
                corners[corner as usize] * (1.0 - along) + corners[(corner as usize + 1) % 4] * along
            })
        };
        let turned = nalgebra::Rotation2::new(landing.yaw);
        let there: Vec<Vector2<f64>> = edge(Side::Left).map(|at| landing.position.xy() + turned * at).collect();
        let here = edge(Side::Right);
        here.flat_map(|here| there.iter().map(move |there| (here - there).norm())).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn large_soles_that_turn_land_with_a_gap_between_them() {
        let (spacing, width) = spacing(|sole| (sole.inside, sole.behind, sole.ahead) = (0.07, 0.12, 0.12));
        for yaw in [0.1, 0.3, 0.5, 0.8] {
            let kept = spacing.kept(&beside(width, yaw));
            let gap = gap_of(&spacing, &kept);
            assert!(gap > spacing.gap - 1e-3, "{yaw} rad: {gap} m");
            let further = SoleSpacing::further_out(&kept, -2e-3);
            assert!(yaw < 0.2 || gap_of(&spacing, &further) < spacing.gap, "{yaw} rad: further than needed");
        }
    }

    #[test]
    fn feet_that_have_room_land_where_they_were_to() {
        let (small, width) = spacing(|_| ());
        for yaw in [-0.3, 0.0, 0.3, 0.8] {
            assert_eq!(small.kept(&beside(width, yaw)), beside(width, yaw), "{yaw} rad");
        }
        // Nor does a robot whose soles are near each other anyway stand wider.
        let (near, width) = spacing(|sole| sole.inside = 0.09);
        assert_eq!(near.kept(&beside(width, 0.0)), beside(width, 0.0));
    }

    #[test]
    fn the_way_out_changes_smoothly_with_the_turn() {
        let (spacing, width) = spacing(|sole| (sole.inside, sole.behind, sole.ahead) = (0.07, 0.12, 0.12));
        let out = |step: i32| spacing.lacking(&beside(width, f64::from(step) * 1e-3));
        for step in -200..800 {
            assert!((out(step + 1) - out(step)).abs() < 2e-3, "{step} mrad: {} and {}", out(step), out(step + 1));
        }
    }
}
