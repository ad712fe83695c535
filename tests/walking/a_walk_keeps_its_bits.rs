//! Whatever is rearranged in the code, a walk keeps its bits: every setpoint, mode and verdict of four walks is what it
//! was when the digests below were taken.
//!
//! Method: FNV-1a over the bits of all setpoints and the numbers of all modes and verdicts. Who changes the walk on
//! purpose takes new digests, which the failure prints, and says in the commit why they changed.

use config::Config;
use controller::{Compensation, Tick};
use halfstep_tests::mechanism;
use halfstep_tests::walking::{Walking, controller_parameters, first_range, plant_parameters};
use interface::{GaitChange, Intent, Mode, Verdict};

/// FNV-1a, 64 bits.
struct Digest(u64);

impl Digest {
    fn add(&mut self, value: u64) {
        for byte in value.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn add_report(&mut self, report: &Tick) {
        let setpoint = &report.setpoint;
        for joints in [&setpoint.angles, &setpoint.rates, &setpoint.feed_forward] {
            joints.0.iter().for_each(|value| self.add(value.to_bits()));
        }
        self.add(match report.report.mode {
            Mode::Walking => 0,
            Mode::Holding => 1,
            Mode::Fallen => 2,
            Mode::Starting => 3,
            Mode::Standing => 4,
            Mode::Stopping => 5,
            Mode::Faulted => 6,
            Mode::InPlace => 7,
        });
        self.add(report.reply.map_or(0, |answer| match answer.verdict {
            Verdict::Accepted => 1,
            Verdict::Limited => 2,
            Verdict::Refused => 3,
        }));
    }
}

/// The digest of so many ticks, with what is asked in some of them.
fn digest(walking: &mut Walking, ticks: u64, asked: &[(u64, GaitChange, Option<Intent>)]) -> String {
    let mut digest = Digest(0xcbf2_9ce4_8422_2325);
    for tick in 0..ticks {
        let asked = asked.iter().find(|(at, ..)| *at == tick).map(|(_, request, intent)| (request, *intent));
        digest.add_report(&walking.tick(asked));
    }
    format!("{:#018x}", digest.0)
}

fn change(turn: f64, speed: f64, extension: f64) -> GaitChange {
    GaitChange { turn: Some(turn), speed: Some(speed), extension: Some(extension), ..GaitChange::NONE }
}

const NOTHING: GaitChange = GaitChange::NONE;

fn begin(seed: u64) -> Walking {
    let mut parameters = controller_parameters();
    parameters.gait.limits = first_range();
    Walking::begin_with(&mechanism(), &parameters, &plant_parameters(), seed)
}

#[test]
fn turns_speeds_and_extensions_keep_their_bits() {
    let asked = [
        (700, change(0.1, 1.1, 0.05), None),
        (2500, change(-0.3, 0.8, -0.05), None),
        (4500, change(0.5, 1.5, 0.2), None),
        (7000, change(f64::NAN, 1.0, 0.0), None),
        (7500, change(9.0, 9.0, 9.0), None),
        (9000, change(0.0, 1.0, 0.0), None),
    ];
    assert_eq!(digest(&mut begin(7), 10_000, &asked), "0x0f495e518f37a0f2");
}

#[test]
fn starts_and_stops_keep_their_bits() {
    let asked = [
        (500, NOTHING, Some(Intent::Stop)),
        (3000, change(0.1, 1.0, 0.0), Some(Intent::Walk)),
        (5000, NOTHING, Some(Intent::Hold)),
        (7500, NOTHING, Some(Intent::Stop)),
        (10_000, change(0.2, 1.0, 0.0), Some(Intent::InPlace)),
        (13_000, NOTHING, Some(Intent::Walk)),
        (14_000, NOTHING, Some(Intent::Stop)),
        (14_300, NOTHING, Some(Intent::Walk)),
    ];
    assert_eq!(digest(&mut begin(8), 16_000, &asked), "0x726ef39e6a41ffcc");
}

/// A push that the ankle holds, one that is stepped after, broken sensors, a fall, a reset that is refused.
#[test]
fn disturbed_walks_keep_their_bits() {
    let script = "[[push]]\nat_s = 1.0\nlasts_s = 0.1\nimpulse_n_s = [8, 0, 0]\n\
                  [[push]]\nat_s = 4.0\nlasts_s = 0.1\nimpulse_n_s = [20, 0, 0]\n\
                  [[sensor_fault]]\nat_s = 6.0\nlasts_s = 0.01\nkind = \"nan\"\n\
                  [[sensor_fault]]\nat_s = 7.0\nlasts_s = 0.1\nkind = \"delay\"\ndelay_periods = 10\n\
                  [[push]]\nat_s = 9.0\nlasts_s = 0.1\nimpulse_n_s = [0, 300, 0]\n";
    let mut walking = begin(9);
    walking.plant.disturbances = plant::Disturbances::from_toml(script, "script").expect("it is good");
    let asked = [(3000, change(0.1, 1.1, 0.0), None), (11_500, NOTHING, Some(Intent::Reset))];
    assert_eq!(digest(&mut walking, 12_000, &asked), "0x7875f112155ee1ae");
}

/// Without compensation, brought to a stand in stride.
#[test]
fn uncompensated_walks_keep_their_bits() {
    let parameters = controller::Parameters { compensation: Compensation::None, ..controller_parameters() };
    let mut walking = Walking::begin_with(&mechanism(), &parameters, &plant_parameters(), 10);
    let asked = [
        (700, change(0.05, 1.0, 0.02), None),
        (3000, NOTHING, Some(Intent::Hold)),
        (5000, NOTHING, Some(Intent::Walk)),
    ];
    assert_eq!(digest(&mut walking, 6000, &asked), "0xa46efe376b4efcd9");
}
