//! What a tick reports of plan and compensation is what it says it is.
//!
//! The planned centre of mass and its velocity come from kinematics, angle by angle and rate by rate: one must be the
//! time derivative of the other. A walk that nobody compensates has nothing added to it; a planned turn has.

use controller::{Compensation, Tick};
use halfstep_tests::mechanism;
use halfstep_tests::walking::{PERIOD, Walking, controller_parameters, plant_parameters};
use interface::{GaitChange, Intent};
use model::ComState;

/// The reports of a walk that turns from its beginning.
fn reports(compensation: Compensation, seconds: f64) -> Vec<Tick> {
    let mut parameters = controller_parameters();
    parameters.compensation = compensation;
    let mut walking = Walking::begin_with(&mechanism(), &parameters, &plant_parameters(), 0);
    let turn = GaitChange { turn: Some(10_f64.to_radians()), ..GaitChange::default() };
    let first = walking.tick(Some((&turn, None::<Intent>)));
    let rest = (1..(seconds / PERIOD) as u64).map(|_| walking.tick(None));
    std::iter::once(first).chain(rest).collect()
}

#[test]
fn planned_com_velocity_is_the_rate_of_the_planned_com() {
    let reports = reports(Compensation::Preview, 2.0);
    let mut greatest: f64 = 0.0;
    for around in
        reports.windows(3).filter(|around| around[0].report.half_step.index == around[2].report.half_step.index)
    {
        let com = |at: usize| around[at].report.com_planned.expect("a walking robot has a plan");
        let ComState { velocity, .. } = com(1);
        let moved = com(2).position - com(0).position;
        let rate = moved / (2.0 * PERIOD);
        assert!(
            (rate - velocity).norm() < 2e-3,
            "{rate} m/s instead of {velocity} at {:?}",
            around[1].report.half_step
        );
        greatest = greatest.max(velocity.norm());
    }
    assert!(greatest > 0.3, "it walks: {greatest} m/s");
}

#[test]
fn measured_com_is_near_the_plan_and_unknown_in_the_tick_of_a_support_change() {
    let reports = reports(Compensation::Preview, 2.0);
    for pair in reports.windows(2) {
        let changes_support = pair[0].report.half_step.index != pair[1].report.half_step.index;
        assert_eq!(pair[1].report.com_measured.is_none(), changes_support, "{:?}", pair[1].report.half_step);
        assert!(!changes_support || pair[1].report.zmp_in_support.is_none());
        if let Some(sensed) = pair[1].report.com_measured {
            let planned = pair[1].report.com_planned.expect("a walking robot has a plan");
            let error = sensed.divergent_component() - planned.divergent_component();
            assert!(error.norm() < 0.03, "{error} m at {:?}", pair[1].report.half_step);
        }
    }
}

/// A foot that has borne for some time is in contact, also in the tick in which the other foot becomes the support, and
/// with a sample in every fifth tick only; one that has not is none. On tiles a foot may land late.
#[test]
fn the_feet_in_contact_are_those_that_bear() {
    let bearing = 0.4 * mechanism().mass() * model::GRAVITY;
    for every in [1, 5] {
        let mut plant = plant_parameters();
        plant.unevenness.height = 0.01;
        let mut walking = Walking::begin_with(&mechanism(), &controller_parameters(), &plant, 0);
        let (mut borne, mut free) = ([0; 2], [0; 2]);
        let (mut seen, mut changes, mut half_step) = (0, 0, 0);
        for number in 0..6000 {
            let measurement = walking.measurement;
            let sample = (number % every == 0).then_some(&measurement);
            let tick = walking.driver.step(PERIOD, sample, |_| None).tick;
            walking.measurement = walking.plant.step(&tick.setpoint);
            changes += u64::from(std::mem::replace(&mut half_step, tick.report.half_step.index) != half_step);
            for foot in 0..2 {
                let force = measurement.feet[foot].force.z;
                borne[foot] = if force > bearing { borne[foot] + 1 } else { 0 };
                free[foot] = if force < 1.0 { free[foot] + 1 } else { 0 };
                if borne[foot] > 40 {
                    assert!(tick.report.estimate.contact[foot], "tick {number}: {:?}", tick.report.half_step);
                    seen += 1;
                }
                if free[foot] > 40 {
                    assert!(!tick.report.estimate.contact[foot], "tick {number}: {:?}", tick.report.half_step);
                    seen += 1;
                }
            }
        }
        assert!(changes >= 8 && seen > 4000, "{changes} support changes, {seen} ticks compared");
    }
}

#[test]
fn only_preview_adds_angles_to_the_nominal() {
    let greatest = |compensation, seconds| {
        let reports = reports(compensation, seconds);
        let known = reports.iter().filter_map(|report| report.report.added).count();
        assert!(known as f64 > 0.95 * reports.len() as f64, "{known} of {}", reports.len());
        reports
            .iter()
            .filter_map(|report| report.report.added)
            .map(|added| added.ankle.amax())
            .fold(0.0, f64::max)
            .to_degrees()
    };
    // Before it falls.
    assert!(greatest(Compensation::None, 0.6) < 1e-12);
    let planned = greatest(Compensation::Preview, 2.0);
    assert!((0.3..5.0).contains(&planned), "{planned}°");
}
