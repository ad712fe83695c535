//! The path of the swing sole: as in the modified half-step, but from where the foot really stands to a landing on the
//! ground, level and at rest at both ends.
//!
//! The plain sum of joint offsets leaves the sole millimetres above or below the ground when a longer step ends, and
//! lets it land with the heading's share of the robot's speed when a turn ends; either would be a blow.
//!
//! The nominal half-step swings ahead, and nearly stands before it lands. A step back is more than its opposite: the
//! foot goes back in the nominal's own time then, so that it stands as early.

use nalgebra::Vector4;
use signal::smooth_step;

use crate::footprint::SolePose;
use crate::modified_half_step::ModifiedHalfStep;

/// The corrections of one half-step's swing sole, over its progress from 0 to 1. Each is position (m) and yaw (rad).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SwingPath {
    /// Offset of the real lift-off from that of the modified half-step.
    lift_off: Vector4<f64>,
    /// Offset of the planned landing from that of the modified half-step.
    landing: Vector4<f64>,
    /// Rate of the modified half-step at its start, per progress.
    start_rate: Vector4<f64>,
    /// Rate of the modified half-step at its end, per progress.
    end_rate: Vector4<f64>,
    nominal: NominalSwing,
    /// How much further back than the nominal swing the foot goes in the nominal's own time (m).
    back_in_nominal_time: f64,
    redirection: Option<Redirection>,
}

/// How the swing foot of the nominal half-step goes ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
struct NominalSwing {
    /// Where it lifts off (m).
    start: f64,
    /// How far it goes (m).
    length: f64,
    /// Rates at its start and at its end (m per progress).
    rates: [f64; 2],
}

/// What another landing adds to the corrections.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Redirection {
    /// Progress from which on.
    from: f64,
    /// More offset of the landing.
    landing: Vector4<f64>,
    /// More rate at the end, per progress.
    end_rate: Vector4<f64>,
}

/// Step of progress over which rates are differenced.
const RATE_STEP: f64 = 1e-4;
/// Swings back, in nominal ones, between which the foot changes over to the nominal's time (-): turning on the spot
/// takes it back by less.
const BACK: [f64; 2] = [0.2, 0.5];

impl SwingPath {
    /// The path of a half-step.
    ///
    /// * `lift_off` – where the foot stands
    /// * `landing` – where it shall land
    /// * `modified` – the modified half-step at a progress
    pub(crate) fn new(lift_off: &SolePose, landing: &SolePose, modified: impl Fn(f64) -> ModifiedHalfStep) -> Self {
        let [begin, soon, late, end] = [0.0, RATE_STEP, 1.0 - RATE_STEP, 1.0].map(modified);
        let sole = |half_step: &ModifiedHalfStep| vector(&half_step.swing_sole);
        let ahead = [begin, soon, late, end].map(|half_step| half_step.nominal_swing_ahead);
        let nominal = NominalSwing {
            start: ahead[0],
            length: ahead[3] - ahead[0],
            rates: [(ahead[1] - ahead[0]) / RATE_STEP, (ahead[3] - ahead[2]) / RATE_STEP],
        };
        let swing = landing.position.x - lift_off.position.x;
        let goes_back = nominal.length > 0.0 && -swing > BACK[0] * nominal.length;
        let share = (-swing / nominal.length - BACK[0]) / (BACK[1] - BACK[0]);
        let share = if goes_back { smooth_step(share.min(1.0)) } else { 0.0 };
        Self {
            lift_off: vector(lift_off) - sole(&begin),
            landing: vector(landing) - sole(&end),
            start_rate: (sole(&soon) - sole(&begin)) / RATE_STEP,
            end_rate: (sole(&end) - sole(&late)) / RATE_STEP,
            back_in_nominal_time: share * (nominal.length - swing),
            nominal,
            redirection: None,
        }
    }

    /// Whether the landing was changed on the way; it is once at most.
    pub(crate) fn is_redirected(&self) -> bool {
        self.redirection.is_some()
    }

    /// Lands elsewhere, from a progress on, at which the modified half-step changes smoothly.
    ///
    /// * `landing` – where the foot shall land
    /// * `modified` – the modified half-step at a progress, as changed
    pub(crate) fn redirect(&mut self, from: f64, landing: &SolePose, modified: impl Fn(f64) -> ModifiedHalfStep) {
        let last = vector(&modified(1.0).swing_sole);
        let end_rate = (last - vector(&modified(1.0 - RATE_STEP).swing_sole)) / RATE_STEP;
        self.redirection = Some(Redirection {
            from,
            landing: vector(landing) - last - self.landing,
            end_rate: end_rate - self.end_rate,
        });
    }

    /// The swing sole at `progress`.
    ///
    /// * `modified` – the modified half-step there
    pub(crate) fn at(&self, progress: f64, modified: &ModifiedHalfStep) -> SolePose {
        let s = progress;
        let blend = smooth_step(s);
        let redirected = self.redirection.map_or_else(Vector4::zeros, |redirection| redirection.at(s));
        let mut sole = vector(&modified.swing_sole) + redirected + self.lift_off * (1.0 - blend) + self.landing * blend
            - self.start_rate * leaving(s)
            - self.end_rate * arriving(s);
        if self.back_in_nominal_time != 0.0 {
            sole.x -= self.back_in_nominal_time * (self.nominal.at(s, modified.nominal_swing_ahead) - blend);
        }
        pose(sole)
    }
}

impl NominalSwing {
    /// How much of the way the foot has gone (-), from rest to rest.
    ///
    /// * `ahead` – where it is in the nominal half-step (m)
    fn at(&self, progress: f64, ahead: f64) -> f64 {
        let [start_rate, end_rate] = self.rates;
        let way = ahead - self.start - start_rate * leaving(progress) - end_rate * arriving(progress);
        way / self.length
    }
}

/// A way of no length that leaves at the rate 1 per progress and arrives at rest.
fn leaving(s: f64) -> f64 {
    s * (1.0 - s) * (1.0 - s)
}

/// A way of no length that leaves from rest and arrives at the rate 1 per progress.
fn arriving(s: f64) -> f64 {
    -s * s * (1.0 - s)
}

impl Redirection {
    /// What it adds at a progress: nothing but at the end, and smooth from where it begins.
    fn at(&self, progress: f64) -> Vector4<f64> {
        let span = 1.0 - self.from;
        let u = ((progress - self.from) / span).max(0.0);
        self.landing * smooth_step(u) - self.end_rate * (u * u * u * (u - 1.0) * span)
    }
}

fn vector(pose: &SolePose) -> Vector4<f64> {
    pose.position.push(pose.yaw)
}

fn pose(vector: Vector4<f64>) -> SolePose {
    SolePose { position: vector.xyz(), yaw: vector.w }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};

    use super::*;

    /// A modified half-step of which the swing sole is given, and where it is in the nominal one.
    fn half_step(swing_sole: SolePose, nominal_swing_ahead: f64) -> ModifiedHalfStep {
        ModifiedHalfStep { pelvis: Matrix3::identity(), nominal_pelvis_height: 0.9, nominal_swing_ahead, swing_sole }
    }

    /// A swing sole that goes ahead by `length` in the nominal's time, which is early.
    fn early(length: f64) -> impl Fn(f64) -> f64 {
        move |s| length * (smooth_step((1.1 * s).min(1.0)) - 0.5)
    }

    #[test]
    fn swing_sole_leaves_and_lands_at_rest_where_planned() {
        // A modified half-step that starts and ends elsewhere, and moves at both ends.
        let modified = |s: f64| {
            let sole = SolePose { position: Vector3::new(0.4 * s - 0.2, 0.19, 0.05 * s), yaw: 0.3 * s };
            half_step(sole, 0.4 * s)
        };
        let lift_off = SolePose { position: Vector3::new(-0.21, 0.18, 0.0), yaw: 0.0 };
        let landing = SolePose { position: Vector3::new(0.25, 0.2, 0.0), yaw: 0.25 };
        let path = SwingPath::new(&lift_off, &landing, modified);
        let at = |s: f64| vector(&path.at(s, &modified(s)));
        assert!((at(0.0) - vector(&lift_off)).norm() < 1e-12);
        assert!((at(1.0) - vector(&landing)).norm() < 1e-12);
        let h = 1e-6;
        assert!(((at(h) - at(0.0)) / h).norm() < 1e-4);
        assert!(((at(1.0) - at(1.0 - h)) / h).norm() < 1e-4);
    }

    /// The modified half-step changes at 0.4, smoothly, by what lands elsewhere and at another rate.
    #[test]
    fn a_redirected_swing_sole_goes_on_smoothly_and_lands_at_rest_where_planned() {
        let from = 0.4;
        let before = |s: f64| {
            let sole = SolePose { position: Vector3::new(0.4 * s - 0.2, 0.19, 0.05 * s), yaw: 0.3 * s };
            half_step(sole, 0.4 * s)
        };
        let after = |s: f64| {
            let more = (s - from).max(0.0).powi(3);
            let position = before(s).swing_sole.position + Vector3::new(0.5, -0.2, 0.1) * more;
            half_step(SolePose { position, yaw: 0.3 * s + 0.4 * more }, 0.4 * s)
        };
        let lift_off = SolePose { position: Vector3::new(-0.21, 0.18, 0.0), yaw: 0.0 };
        let planned = SolePose { position: Vector3::new(0.21, 0.2, 0.0), yaw: 0.25 };
        let elsewhere = SolePose { position: Vector3::new(0.33, 0.14, 0.0), yaw: 0.4 };
        let first = SwingPath::new(&lift_off, &planned, before);
        let mut path = first;
        path.redirect(from, &elsewhere, after);
        let at = |s: f64| vector(&path.at(s, &after(s)));
        assert!((at(1.0) - vector(&elsewhere)).norm() < 1e-12);
        let h = 1e-5;
        assert!(((at(1.0) - at(1.0 - h)) / h).norm() < 1e-2, "{}", (at(1.0) - at(1.0 - h)) / h);
        // Rate and acceleration where it begins are those of the path before.
        let old = |s: f64| vector(&first.at(s, &before(s)));
        assert_eq!(at(from), old(from));
        let rates = |at: &dyn Fn(f64) -> Vector4<f64>| [(at(from + h) - at(from)) / h, (at(from) - at(from - h)) / h];
        let ([new_after, _], [old_after, _]) = (rates(&at), rates(&old));
        assert!((new_after - old_after).norm() < 1e-6, "{}", new_after - old_after);
    }

    /// The legs swing back by a ramp that ends with the half-step, while the nominal swings ahead.
    #[test]
    fn a_foot_that_goes_back_stands_as_early_as_one_that_goes_ahead() {
        let ahead = early(0.5);
        let sole = |x: f64| SolePose { position: Vector3::new(x, 0.19, 0.0), yaw: 0.0 };
        for swing in [-0.25, -0.4, -0.6] {
            let modified = |s: f64| half_step(sole(ahead(s) + (swing - 0.5) * smooth_step(s)), ahead(s));
            let path = SwingPath::new(&sole(-0.25), &sole(swing - 0.25), modified);
            let at = |s: f64| path.at(s, &modified(s)).position.x;
            for s in [0.0, 0.2, 0.5, 0.8, 0.93, 1.0] {
                let expected = swing / 0.5 * (ahead(s) + 0.25) - 0.25;
                assert!((at(s) - expected).abs() < 1e-7, "{swing} m at {s}: {} instead of {expected}", at(s));
            }
        }
    }

    #[test]
    fn a_swing_changes_smoothly_from_ahead_to_back() {
        let ahead = early(0.5);
        let sole = |x: f64| SolePose { position: Vector3::new(x, 0.19, 0.0), yaw: 0.0 };
        let at_middle = |swing: f64| {
            let modified = |s: f64| half_step(sole(ahead(s) + (swing - 0.5) * smooth_step(s)), ahead(s));
            let path = SwingPath::new(&sole(-0.25), &sole(swing - 0.25), modified);
            path.at(0.6, &modified(0.6)).position.x
        };
        let steps: Vec<f64> = (-60..60).map(|swing| at_middle(f64::from(swing) * 0.01)).collect();
        for pair in steps.windows(2) {
            assert!((0.0..0.02).contains(&(pair[1] - pair[0])), "{pair:?}");
        }
    }
}
