//! Soles need not be as wide on both sides of the ankle: the robot walks on soles that reach 2 cm inward and 5 cm
//! outward, or the other way round, with the zero-moment point between their true edges.

use halfstep_tests::mechanism;
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use interface::{GaitChange, Intent, Mode};
use model::{Mechanism, Side};
use nalgebra::Point3;

/// Our robot with other soles, and where the ground's force acts while it walks.
struct Shifted {
    mechanism: Mechanism,
    walking: Walking,
    /// Least distance to the true edges, in single support (m).
    margin: f64,
    /// Sum and number of the places: outward of the ankle (m).
    outward: (f64, u32),
}

impl Shifted {
    fn new(inside: f64, outside: f64, seed: u64) -> Self {
        let mut mechanism = mechanism();
        (mechanism.sole.inside, mechanism.sole.outside) = (inside, outside);
        let walking = Walking::begin_with(&mechanism, &controller_parameters(), &plant_parameters(), seed);
        Self { mechanism, walking, margin: f64::INFINITY, outward: (0.0, 0) }
    }

    /// Walks on; only a sole that bears alone, away from support changes, counts.
    fn walk(&mut self, seconds: f64, what: &str) {
        let end = self.walking.time() + seconds;
        while self.walking.time() < end {
            let report = self.walking.tick(None).report;
            let truth = self.walking.plant.truth();
            let time = self.walking.time();
            assert!(!truth.has_fallen() && report.mode == Mode::Walking, "{what}: fell at {time:.2} s");
            let side = report.half_step.support;
            let alone = truth.loads[side.other().index()] <= 0.0;
            let Some(zmp) = truth.zmp.filter(|_| alone && (0.15..0.85).contains(&report.half_step.progress)) else {
                continue;
            };
            let in_sole = truth.soles[side.index()].inverse() * Point3::new(zmp.x, zmp.y, 0.0);
            let to_inside = if side == Side::Right { in_sole.y } else { -in_sole.y };
            self.margin = self.margin.min(self.mechanism.sole.margin(in_sole.x, to_inside));
            self.outward = (self.outward.0 - to_inside, self.outward.1 + 1);
        }
    }
}

/// The middle is 35 mm from either edge, the ankle 20 mm from the nearer one. Measured with seeds 1 to 3: least margins
/// of 18 to 19 mm with the long side outward, 13 to 16 mm in turns; 7 to 9 mm with the long side inward, in turns too.
#[test]
fn walks_on_soles_that_reach_farther_to_one_side() {
    for (inside, outside, least) in [(0.02, 0.05, 0.014), (0.05, 0.02, 0.005)] {
        for seed in 1..4 {
            let what = format!("{inside} m inward, {outside} m outward, seed {seed}");
            let mut shifted = Shifted::new(inside, outside, seed);
            shifted.walk(6.0, &what);
            let (sum, count) = shifted.outward;
            let (mean, middle) = (sum / f64::from(count), (outside - inside) / 2.0);
            assert!((mean - middle).abs() < 0.005, "{what}: {mean} m outward on average, not {middle} m");
            assert!(shifted.margin > least, "{what}: {} m to the edge", shifted.margin);

            for (turn, speed, extension) in [(15_f64, 1.2, 4_f64), (-15.0, 0.8, -4.0)] {
                let request = GaitChange {
                    turn: Some(turn.to_radians()),
                    speed: Some(speed),
                    extension: Some(extension.to_radians()),
                    ..GaitChange::NONE
                };
                shifted.walking.ask(request, Some(Intent::Walk));
                shifted.walk(5.0, &what);
            }
            assert!(shifted.margin > 0.0, "{what}: {} m to the edge in turns", shifted.margin);
        }
    }
}

/// Beside each other, the middles of both soles are as far from each ankle: the weight is on both alike.
#[test]
fn feet_may_stand_on_shifted_soles() {
    let mut shifted = Shifted::new(0.02, 0.05, 1);
    shifted.walking.ask(GaitChange::default(), Some(Intent::Stop));
    let truth = shifted.walking.walk(6.0);
    assert!(!truth.has_fallen());
    let [right, left] = truth.loads;
    assert!((right - left).abs() < 0.1 * (right + left), "stands on both alike: {right} N, {left} N");
}
