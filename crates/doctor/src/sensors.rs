//! The sensors: whether the controller can tell their noise, delay and errors from faults.

use model::{GRAVITY, Joint};

use crate::examined_robot::ExaminedRobot;
use crate::finding::{Finding, Remedy};

const CHECK: &str = "sensors";
/// Standard deviations that noise exceeds once in a million samples.
const SIGMAS: f64 = 5.0;
/// Time over which the controller averages how far joints are from their setpoints (s).
const BIAS_WINDOW: f64 = 0.3;
/// Largest bias of a gyro that the attitude estimator can learn (rad/s), and tilt of the inertial unit with which the
/// controller lets the robot set out (rad).
const GYRO_BIAS_MAX: f64 = 0.0524;
const TILT_MAX: f64 = 0.0227;
/// Share of the sole's width that the noise of the zero-moment point may take.
const ZMP_NOISE_MAX: f64 = 0.1;

/// A figure that must stay below a bound, and the keys that decide about both.
struct Bound {
    what: &'static str,
    value: f64,
    most: f64,
    unit: &'static str,
    key: &'static str,
    threshold: Option<&'static str>,
}

/// Checks noise, delay, resolution and mounting against what the controller tolerates.
pub fn check(examined: &ExaminedRobot) -> Finding {
    let bounds = bounds(examined);
    let delay = f64::from(examined.setup.plant.sensors.delay_periods) * examined.period;
    let nearest = bounds.iter().map(|bound| bound.value / bound.most).fold(0.0, f64::max);
    let figure = format!("{:.1} ms late; the nearest threshold is used by {:.0} %", delay * 1e3, nearest * 100.0);
    let Some(bound) = bounds.iter().find(|bound| bound.value > bound.most) else {
        return Finding::good(CHECK, figure);
    };
    let Bound { what, value, most, unit, key, threshold } = bound;
    let wrong = format!("{what}: {value:.4} {unit}, must be at most {most:.4} {unit}");
    let mut remedies =
        vec![Remedy { file: "plant.toml", key: (*key).to_owned(), advice: "a better sensor".to_owned() }];
    remedies.extend(threshold.map(|key| Remedy {
        file: "controller.toml",
        key: key.to_owned(),
        advice: "a looser threshold, which notices faults later".to_owned(),
    }));
    Finding::bad(CHECK, figure, wrong, remedies)
}

fn bounds(examined: &ExaminedRobot) -> Vec<Bound> {
    let (sensors, watch) = (&examined.setup.plant.sensors, &examined.setup.controller.validator);
    let (mechanism, consistency) = (&examined.setup.mechanism, &watch.consistency);
    let delay = f64::from(sensors.delay_periods + sensors.every_periods - 1) * examined.period;
    let bound = |what, value, most, unit, key, threshold| Bound { what, value, most, unit, key, threshold };
    let weight = mechanism.mass() * GRAVITY;
    let width = mechanism.sole.half_size().y * 2.0;
    vec![
        bound(
            "joints seem to lag by the delay of their sensors",
            delay * fastest_on_average(examined),
            consistency.tracking_bias_max,
            "rad",
            "sensors.delay_periods",
            Some("watch.tracking_bias_max_rad"),
        ),
        bound(
            "the noise of the orientation looks like a contradiction",
            SIGMAS * sensors.orientation_noise,
            consistency.orientation_error_max,
            "rad",
            "sensors.orientation_noise_deg",
            Some("watch.orientation_error_max_rad"),
        ),
        bound(
            "the noise of the gyro looks like a jump",
            SIGMAS * 2f64.sqrt() * sensors.angular_rate_noise,
            watch.trunk_rate_jump_max,
            "rad/s",
            "sensors.angular_rate_noise_deg_per_s",
            Some("watch.trunk_rate_jump_max_rad_per_s"),
        ),
        bound(
            "a step of the encoders looks like a contradiction",
            sensors.angle_resolution,
            consistency.rate_error_max,
            "rad",
            "sensors.angle_resolution_deg",
            Some("watch.rate_error_max_rad"),
        ),
        bound(
            "noise makes a foot in the air seem to bear",
            SIGMAS * sensors.force_noise,
            examined.setup.controller.stabilizer.zmp.force_min,
            "N",
            "sensors.force_noise_n",
            Some("zmp.force_min_n"),
        ),
        bound(
            "the zero-moment point jitters",
            sensors.moment_noise / weight,
            ZMP_NOISE_MAX * width,
            "m",
            "sensors.moment_noise_n_m",
            None,
        ),
        bound(
            "the inertial unit is mounted askew, which looks like a slope",
            sensors.mounting.xy().norm(),
            TILT_MAX,
            "rad",
            "sensors.imu_mounting_deg",
            None,
        ),
        bound(
            "the gyro drifts faster than can be learnt",
            sensors.gyro_bias.amax(),
            GYRO_BIAS_MAX,
            "rad/s",
            "sensors.gyro_bias_deg_per_s",
            None,
        ),
    ]
}

/// Greatest mean rate of a joint over the time in which the controller averages, in the half-step (rad/s).
fn fastest_on_average(examined: &ExaminedRobot) -> f64 {
    let (nominal, window) = (&examined.nominal, BIAS_WINDOW / examined.nominal.duration);
    let starts = (0..=20).map(|part| f64::from(part) / 20.0 * (1.0 - window).max(0.0));
    let moved = starts.map(|start| {
        let (from, to) = (nominal.at(start).angles, nominal.at((start + window).min(1.0)).angles);
        Joint::ALL.into_iter().map(|joint| (to[joint] - from[joint]).abs()).fold(0.0, f64::max)
    });
    moved.fold(0.0, f64::max) / (window.min(1.0) * nominal.duration)
}
