//! The drives: whether the ankles are stiff enough to hold the robot up, follow fast enough, and are strong enough for
//! the half-step.

use model::{GRAVITY, Joint};

use crate::body::standing_height;
use crate::examined_robot::ExaminedRobot;
use crate::finding::{Finding, Remedy};

const CHECK: &str = "drives";
/// Least stiffness of an ankle per `m·g·h`, with which the weight would tip the robot over a springy ankle: usual are
/// 5 to 6. At 1 it falls however it is balanced.
const STIFFNESS_MIN: f64 = 2.0;
/// Least corner frequency of a drive, stiffness per damping, per that of the inverted pendulum: usual are 10. A slower
/// drive follows balance too late.
const CORNER_MIN: f64 = 3.0;
/// Greatest share of its limit that a joint's torque may take in the half-step. Short peaks are held by the servos.
const LOAD_MAX: f64 = 1.15;

/// Checks stiffness, damping and strength.
pub fn check(examined: &ExaminedRobot) -> Finding {
    let mechanism = &examined.setup.mechanism;
    let servo = mechanism.servos.legs_and_waist;
    let height = standing_height(mechanism);
    let tipping = mechanism.mass() * GRAVITY * height;
    let stiffness = servo.stiffness / tipping;
    let corner = servo.stiffness / servo.damping / (GRAVITY / height).sqrt();
    let (joint, load) = largest_load(examined);
    let figure = format!(
        "ankles {stiffness:.1} times as stiff as the weight tips, drives {corner:.1} times as fast as the robot falls, \
         at most {:.0} % of the torque of {} in the half-step",
        load * 100.0,
        joint.name()
    );
    let usual = examined.usual.mechanism.servos.legs_and_waist;
    let remedy = |key: &str, advice: String| Remedy { file: "mechanism.toml", key: key.to_owned(), advice };
    if stiffness < STIFFNESS_MIN {
        let wrong = format!(
            "an ankle yields more than it holds: {:.0} N·m/rad, where the weight tips by {tipping:.0} N·m/rad",
            servo.stiffness
        );
        let advice = format!("{} is usual for this mass and leg", usual.stiffness);
        return Finding::bad(CHECK, figure, wrong, vec![remedy("servo.legs_and_waist.stiffness_n_m_per_rad", advice)]);
    }
    if corner < CORNER_MIN {
        let wrong = format!("the drives creep: they take {:.2} s to follow", servo.damping / servo.stiffness);
        let advice = format!("{} is usual for this mass and leg", usual.damping);
        return Finding::bad(CHECK, figure, wrong, vec![remedy("servo.legs_and_waist.damping_n_m_s_per_rad", advice)]);
    }
    if load > LOAD_MAX {
        let wrong = format!("{} is too weak for the half-step", joint.name());
        let advice = "a stronger motor, or a slower and shorter half-step from `halfstep synthesize`".to_owned();
        return Finding::bad(CHECK, figure, wrong, vec![remedy(&format!("joint.{}.motor", joint.name()), advice)]);
    }
    Finding::good(CHECK, figure)
}

/// The joint that is nearest to its torque in the half-step, and the share of it that it takes.
fn largest_load(examined: &ExaminedRobot) -> (Joint, f64) {
    let links = &examined.setup.mechanism.links;
    let loads = Joint::ALL.into_iter().filter_map(|joint| {
        let motor = links[joint].motor?;
        let torques = examined.nominal.rows.iter().map(|row| row.torque_gravity[joint] + row.torque_dynamic[joint]);
        Some((joint, torques.fold(0.0, |most: f64, torque| most.max(torque.abs())) / motor.torque_max()))
    });
    loads.fold((Joint::FIRST_POWERED, 0.0), |most, load| if load.1 > most.1 { load } else { most })
}
