//! The same request gets the same grant whatever the millisecond in which it is made, and what is granted needs no more
//! voltage of any motor than there is: admission finds peaks between the knots of the plan.

use halfstep_tests::mechanism;
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use interface::{GaitChange, Reply, Setpoint, Verdict};
use model::{Joint, Mechanism, Motor};

/// Rounding of the voltage (V).
const ROUNDING: f64 = 1e-6;

/// The largest voltage that a setpoint demands of a motor, less what the motor has (V).
fn excess(mechanism: &Mechanism, setpoint: &Setpoint) -> f64 {
    let joints =
        Joint::ALL.into_iter().filter_map(|joint| Some((joint, *mechanism.links[joint].motor.as_ref()?.dc()?)));
    let excess = joints.map(|(joint, motor)| {
        let torque = setpoint.feed_forward[joint] + Motor::Dc(motor).back_emf_damping() * setpoint.rates[joint];
        torque.abs() / motor.torque_per_volt() - motor.voltage_max
    });
    excess.fold(f64::NEG_INFINITY, f64::max)
}

/// Asks for an extension now.
fn reply(walking: &mut Walking, degrees: f64) -> Reply {
    let change = GaitChange { extension: Some(f64::to_radians(degrees)), ..GaitChange::NONE };
    walking.ask(change, None).reply.expect("a reply within a half-step")
}

#[test]
fn an_extension_gets_one_grant_in_every_millisecond() {
    let mechanism = mechanism();
    for degrees in [10.0, 11.0, 12.0] {
        let mut walking = Walking::begin(0);
        walking.walk(2.0);
        for millisecond in 2000..2200 {
            let mut asked = walking.clone();
            let reply = reply(&mut asked, degrees);
            let granted = reply.granted.extension.to_degrees();
            let is_whole = reply.verdict == Verdict::Accepted && (granted - degrees).abs() < 1e-9;
            assert!(is_whole, "{degrees}° at {millisecond} ms: {reply:?}");
            for _ in 0..if millisecond % 20 == 7 { 3000 } else { 0 } {
                let excess = excess(&mechanism, &asked.tick(None).setpoint);
                assert!(excess < ROUNDING, "{degrees}° at {millisecond} ms: {excess} V too much");
            }
            walking.tick(None);
        }
    }
}

/// With weaker motors not all of it is granted: the same in every millisecond of a knot, but for what the plan differs
/// by from knot to knot.
#[test]
fn weak_motors_get_one_grant_in_every_millisecond() {
    let mut mechanism = mechanism();
    for link in &mut mechanism.links.0 {
        if let Some(Motor::Dc(motor)) = &mut link.motor {
            motor.voltage_max = 26.0;
        }
    }
    let mut walking = Walking::begin_with(&mechanism, &controller_parameters(), &plant_parameters(), 0);
    walking.walk(2.0);
    let mut grants = Vec::new();
    for _ in 0..100 {
        let reply = reply(&mut walking.clone(), 12.0);
        assert_eq!(reply.verdict, Verdict::Limited, "{reply:?}");
        grants.push(reply.granted.extension.to_degrees());
        walking.tick(None);
    }
    let (least, most) = grants.iter().fold((f64::MAX, f64::MIN), |(a, b), grant| (a.min(*grant), b.max(*grant)));
    assert!(most - least < 1e-9, "between {least}° and {most}°");
}
