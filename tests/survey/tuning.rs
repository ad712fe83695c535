//! The pictures of docs/tuning.md: what one sees of a walk in which one parameter is wrong, over the same walk with the
//! committed configuration.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use doctor::RobotSetup;
use doctor::trial::{Moment, TRIALS, Trial};
use halfstep_tests::planted_faults::examined;
use interface::Mode;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Folder for the pictures
    #[arg(long, default_value = "docs/tuning")]
    out: PathBuf,
}

/// A picture: a parameter that is wrong, and the trial that shows it.
struct Picture {
    file: &'static str,
    title: &'static str,
    trial: &'static str,
    change: fn(&mut RobotSetup),
    /// The stretch that is shown (s).
    shown: [f64; 2],
}

const PICTURES: [Picture; 3] = [
    Picture {
        file: "gain_low.svg",
        title: "no feedback (feedback.gain = 0), a small push to the left at 4.7 s",
        trial: "small pushes",
        change: |it| it.controller.stabilizer.feedback.gain = 0.0,
        shown: [4.0, 7.0],
    },
    Picture {
        file: "gain_high.svg",
        title: "feedback.gain = 15",
        trial: "nominal walk",
        change: |it| it.controller.stabilizer.feedback.gain = 15.0,
        shown: [2.0, 5.0],
    },
    Picture {
        file: "delay.svg",
        title: "sensors 12 ms late (sensors.delay_periods = 12)",
        trial: "nominal walk",
        change: |it| it.plant.sensors.delay_periods = 12,
        shown: [0.0, 3.0],
    },
];

/// Width, height of a panel, and margins of a picture (px).
const WIDTH: f64 = 760.0;
const PANEL: f64 = 150.0;
const LEFT: f64 = 60.0;
const TOP: f64 = 40.0;
const GAP: f64 = 34.0;
/// Periods per point of a line.
const EVERY: usize = 8;

/// A line over time.
type Line = Vec<(f64, f64)>;

/// A panel: what it shows, and the unit.
struct Panel {
    label: &'static str,
    value: fn(&Moment) -> Option<f64>,
}

const PANELS: [Panel; 3] = [
    Panel { label: "ZMP aside, off its plan [mm]", value: |it| off_plan(it).map(|off| off[1] * 1e3) },
    Panel { label: "ankle roll by balance [°]", value: |it| Some(it.report.lean.x.to_degrees()) },
    Panel { label: "tilt of the trunk [°]", value: |it| Some(it.truth.trunk_tilt.to_degrees()) },
];

fn off_plan(moment: &Moment) -> Option<[f64; 2]> {
    let off = moment.report.zmp_in_support? - moment.report.zmp_planned?;
    Some([off.x, off.y])
}

pub(crate) fn survey(options: &Options) -> bool {
    let healthy = examined("config");
    if let Err(error) = fs::create_dir_all(&options.out) {
        eprintln!("{}: {error}", options.out.display());
        return false;
    }
    PICTURES.iter().all(|picture| {
        let trial = TRIALS.iter().find(|trial| trial.name == picture.trial).expect("there is one of this name");
        let mut wrong = healthy.setup.clone();
        (picture.change)(&mut wrong);
        let lines = |setup| lines(trial, &healthy, setup, picture.shown);
        let text = svg(picture, &lines(&healthy.setup), &lines(&wrong));
        let file = options.out.join(picture.file);
        let written = fs::write(&file, text);
        println!(
            "{}: {}",
            file.display(),
            written.as_ref().map_or_else(ToString::to_string, |()| picture.title.into())
        );
        written.is_ok()
    })
}

/// The lines of each panel.
fn lines(trial: &Trial, examined: &doctor::ExaminedRobot, setup: &RobotSetup, shown: [f64; 2]) -> Vec<Line> {
    let mut lines = vec![Line::new(); PANELS.len()];
    let (mut count, mut fell) = (0, false);
    let outcome = trial.watch(examined, setup, |moment| {
        count += 1;
        fell |= moment.report.mode == Mode::Fallen;
        if (shown[0]..shown[1]).contains(&moment.time) && count % EVERY == 0 && !fell {
            for (line, panel) in lines.iter_mut().zip(&PANELS) {
                line.extend((panel.value)(moment).map(|value| (moment.time, value)));
            }
        }
    });
    outcome.expect("the nominal walks");
    lines
}

fn svg(picture: &Picture, usual: &[Line], wrong: &[Line]) -> String {
    let height = TOP + PANELS.len() as f64 * (PANEL + GAP);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" font-family=\"sans-serif\" \
         font-size=\"12\"><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/><text x=\"{LEFT}\" y=\"20\" \
         font-size=\"14\">{}</text>\n",
        picture.title
    );
    for (index, panel) in PANELS.iter().enumerate() {
        let top = TOP + index as f64 * (PANEL + GAP);
        let values = usual[index].iter().chain(&wrong[index]).map(|(_, value)| *value);
        let (least, most) = values.fold((0.0_f64, 0.0_f64), |(a, b), value| (a.min(value), b.max(value)));
        let room = 0.05 * (most - least).max(1e-3);
        let (least, most) = (least - room, most + room);
        let x = |time: f64| {
            LEFT + (time - picture.shown[0]) / (picture.shown[1] - picture.shown[0]) * (WIDTH - LEFT - 10.0)
        };
        let y = |value: f64| top + 14.0 + (most - value) / (most - least) * (PANEL - 14.0);
        let (right, bottom) = (WIDTH - 10.0, top + PANEL);
        let _ = writeln!(
            out,
            "<text x=\"{LEFT}\" y=\"{:.0}\">{}</text><path d=\"M{LEFT} {:.1}V{bottom:.1}H{right}\" fill=\"none\" \
             stroke=\"#888\"/>",
            top + 8.0,
            panel.label,
            top + 14.0
        );
        let _ = writeln!(out, "<path d=\"M{LEFT} {:.1}H{right}\" stroke=\"#ccc\"/>", y(0.0));
        for value in [least + room, most - room] {
            let _ = writeln!(
                out,
                "<text x=\"{:.0}\" y=\"{:.1}\" text-anchor=\"end\">{value:.1}</text>",
                LEFT - 4.0,
                y(value) + 4.0
            );
        }
        for second in 0..=((picture.shown[1] - picture.shown[0]) * 2.0) as u32 {
            let time = picture.shown[0] + 0.5 * f64::from(second);
            let _ = writeln!(
                out,
                "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{time} s</text>",
                x(time),
                bottom + 14.0
            );
        }
        for (line, colour) in [(&wrong[index], "#d55e00"), (&usual[index], "#0072b2")] {
            let mut path = String::new();
            let mut last = f64::NEG_INFINITY;
            for (time, value) in line {
                let begins = time - last > 0.05;
                last = *time;
                let _ = write!(path, "{}{:.1} {:.1}", if begins { 'M' } else { 'L' }, x(*time), y(*value));
            }
            let _ = writeln!(out, "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.3\"/>");
        }
    }
    out + "</svg>\n"
}
