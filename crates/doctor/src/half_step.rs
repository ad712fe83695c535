//! The nominal half-step: whether its zero-moment point is well inside the sole, and its joints within their rates.

use dynamics::zmp;
use model::Joint;

use crate::examined_robot::ExaminedRobot;
use crate::finding::{Finding, Remedy};

const CHECK: &str = "nominal half-step";
/// Least distance of the zero-moment point from the edge of the sole, as a share of the sole's width.
const MARGIN_MIN: f64 = 0.15;
/// Greatest share of its limit that a joint's rate may take.
const RATE_MAX: f64 = 0.98;

/// Checks the half-step.
pub fn check(examined: &ExaminedRobot) -> Finding {
    let mechanism = &examined.setup.mechanism;
    let margins = examined.nominal.rows.iter().map(|row| {
        let zmp = zmp(&(row.ground_gravity + row.ground_dynamic));
        zmp.map_or(f64::NEG_INFINITY, |zmp| mechanism.sole.margin(zmp.x, zmp.y))
    });
    let margin = margins.fold(f64::INFINITY, f64::min);
    let (joint, share) = fastest(examined);
    let figure = format!(
        "ZMP at least {:.0} mm inside the sole, {} at {:.0} % of its rate",
        margin * 1e3,
        joint.name(),
        share * 100.0
    );
    let width = mechanism.sole.half_size().y * 2.0;
    let made_anew = |key: &str, advice: &str| Remedy {
        file: "nominal_half_step.csv",
        key: key.to_owned(),
        advice: advice.to_owned(),
    };
    if margin < MARGIN_MIN * width {
        let wrong = format!("the ZMP must keep {:.0} mm from the edge of the sole", MARGIN_MIN * width * 1e3);
        let remedy =
            made_anew("(the table)", "make it anew with `halfstep synthesize`; check [sole] of mechanism.toml");
        return Finding::bad(CHECK, figure, wrong, vec![remedy]);
    }
    if share > RATE_MAX {
        let wrong = format!("{} has no rate left for anything but the nominal walk", joint.name());
        let remedy = made_anew("(the table)", "make it anew with a shorter step or a longer duration");
        return Finding::bad(CHECK, figure, wrong, vec![remedy]);
    }
    Finding::good(CHECK, figure)
}

/// The joint that is nearest to its limit of rate, and the share of it that it takes.
fn fastest(examined: &ExaminedRobot) -> (Joint, f64) {
    let links = &examined.setup.mechanism.links;
    let shares = Joint::ALL.into_iter().filter_map(|joint| {
        let limit = links[joint].limits?.rate_max;
        let rates = examined.nominal.rows.iter().map(|row| row.motion.rates[joint].abs());
        Some((joint, rates.fold(0.0, f64::max) / limit))
    });
    shares.fold((Joint::FIRST_POWERED, 0.0), |most, share| if share.1 > most.1 { share } else { most })
}
