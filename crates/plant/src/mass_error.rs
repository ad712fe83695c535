//! Errors of mass: the links of the plant weigh something else than those of the controller's model.

use model::{Body, Mechanism, UnlumpedMechanism};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Number of the random stream: another one than the sensors', so that an error of mass leaves their noise as it is.
const STREAM: u64 = 1;

/// The mechanism with every link's mass, and independently its inertia, wrong by a share drawn evenly from ±`error`.
/// The same seed draws the same shares; with an error of 0 nothing changes.
pub fn with_mass_error(mechanism: &Mechanism, error: f64, seed: u64) -> Mechanism {
    let (mut mechanism, mut factor) = (mechanism.clone(), factors(error, seed));
    mechanism.links.0.iter_mut().for_each(|link| link.body = wrong(link.body, &mut factor));
    mechanism
}

/// The robot with the same errors of mass, and held links with others of their own.
pub(crate) fn unlumped_with_mass_error(robot: UnlumpedMechanism, error: f64, seed: u64) -> UnlumpedMechanism {
    let (mut robot, mut factor) = (robot, factors(error, seed));
    robot.mechanism.links.0.iter_mut().for_each(|link| link.body = wrong(link.body, &mut factor));
    robot.held.iter_mut().for_each(|link| link.body = wrong(link.body, &mut factor));
    robot
}

/// Factors of right values, drawn evenly from 1 ± `error`.
fn factors(error: f64, seed: u64) -> impl FnMut() -> f64 {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(STREAM);
    move || 1.0 + error * random.random_range(-1.0..=1.0)
}

fn wrong(body: Body, mut factor: impl FnMut() -> f64) -> Body {
    let Body { mass, inertia, .. } = body;
    Body { mass: mass * factor(), inertia: inertia * factor(), ..body }
}

#[cfg(test)]
mod tests {
    use config::Config;
    use model::Joint;

    use super::*;

    fn mechanism() -> Mechanism {
        Mechanism::load(format!("{}/../../config/mechanism.toml", env!("CARGO_MANIFEST_DIR")))
            .expect("the committed file")
    }

    #[test]
    fn mass_errors_depend_on_the_seed_alone_and_an_error_of_zero_changes_nothing() {
        let mechanism = mechanism();
        assert_eq!(with_mass_error(&mechanism, 0.0, 3), mechanism);
        assert_eq!(with_mass_error(&mechanism, 0.05, 3), with_mass_error(&mechanism, 0.05, 3));
        assert_ne!(with_mass_error(&mechanism, 0.05, 3), with_mass_error(&mechanism, 0.05, 4));
    }

    /// Shares stay within the error, fill it, are one for all three moments of a link, and right is not left.
    #[test]
    fn mass_errors_of_links_are_independent_and_fill_their_range() {
        let mechanism = mechanism();
        let mut shares = Vec::new();
        for seed in 0..50 {
            let wrong = with_mass_error(&mechanism, 0.05, seed);
            for (link, truth) in wrong.links.0.iter().zip(&mechanism.links.0).filter(|(_, truth)| truth.body.mass > 0.0)
            {
                shares.push(link.body.mass / truth.body.mass - 1.0);
                let ratio = link.body.inertia.component_div(&truth.body.inertia);
                assert!((ratio - nalgebra::Vector3::repeat(ratio.x)).norm() < 1e-12);
                shares.push(ratio.x - 1.0);
            }
            assert_ne!(wrong.links[Joint::RightKnee].body.mass, wrong.links[Joint::LeftHipPitch].body.mass);
        }
        let (least, most) = shares.iter().fold((0.0_f64, 0.0_f64), |(min, max), s| (min.min(*s), max.max(*s)));
        assert!((-0.05 - 1e-12..-0.045).contains(&least) && (0.045..0.05 + 1e-12).contains(&most), "{least} {most}");
        let mean = shares.iter().sum::<f64>() / shares.len() as f64;
        assert!(mean.abs() < 0.004, "1200 shares have the mean {mean}");
    }
}
