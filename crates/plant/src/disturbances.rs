//! What happens to the robot while it walks: pushes and sensor faults, from a script.
//!
//! ```toml
//! [[push]]
//! at_s = 3.0
//! lasts_s = 0.1
//! impulse_n_s = [0, 6, 0] # ahead, left, up
//! link = "trunk"          # which is also what is pushed if nothing is said
//!
//! [[sensor_fault]]
//! at_s = 5.0
//! lasts_s = 0.02
//! kind = "spike"          # or "freeze", "nan", "drop_out", "delay"
//! values = "rates"
//! joint = "left_knee"
//! size_deg_per_s = 900
//! ```

use std::path::Path;

use model::config::{self, ConfigErrors, Document, Table};
use model::{Joint, Side};

use crate::robot::TRUNK;
use crate::{Push, SensedValues, SensorFault, SensorFaultKind, Sensors};

/// All that happens. Empty by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Disturbances {
    /// Forces.
    pub pushes: Vec<Push>,
    /// Faults; those at the same time act in this order.
    pub sensor_faults: Vec<SensorFault>,
}

/// Latest time of a script [s]; what is later is a mistake of unit.
const TIME_MAX: f64 = 1e6;
/// Largest component of an impulse [N·s]: it would throw the robot as far as a house.
const IMPULSE_MAX: f64 = 1e4;
/// Every group of sensed values by its name.
const VALUES: [(&str, SensedValues); 7] = [
    ("all", SensedValues::All),
    ("angles", SensedValues::Angles(None)),
    ("rates", SensedValues::Rates(None)),
    ("currents", SensedValues::Currents(None)),
    ("feet", SensedValues::Feet(None)),
    ("orientation", SensedValues::Orientation),
    ("angular_rate", SensedValues::AngularRate),
];

/// What a script can say that a sensor fault is.
#[derive(Clone, Copy)]
enum Kind {
    Freeze,
    NotANumber,
    Spike,
    DropOut,
    Delay,
}

impl Disturbances {
    /// Reads a script.
    ///
    /// # Errors
    /// When the file cannot be read, and every key that is unknown, missing or out of range.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, ConfigErrors> {
        let path = path.as_ref();
        Self::from_toml(&config::read(path)?, &path.display().to_string())
    }

    /// Reads the text of a script; `file` is its name for messages.
    ///
    /// # Errors
    /// Every key that is unknown, missing or out of range.
    pub fn from_toml(text: &str, file: &str) -> Result<Self, ConfigErrors> {
        let document = Document::parse(text, file)?;
        let root = document.root();
        let disturbances = Self {
            pushes: root.tables("push").iter().map(push).collect(),
            sensor_faults: root.tables("sensor_fault").iter().filter_map(sensor_fault).collect(),
        };
        document.finish(disturbances)
    }
}

fn push(table: &Table) -> Push {
    let links = || Joint::ALL.into_iter().filter_map(|joint| Some((joint.link_name()?, joint)));
    let must = format!("each must lie between -{IMPULSE_MAX} and {IMPULSE_MAX}");
    let in_reach = |impulse: &[f64; 3]| impulse.iter().all(|component| component.abs() <= IMPULSE_MAX);
    Push {
        link: if table.has("link") { table.choice("link", links()).unwrap_or(TRUNK) } else { TRUNK },
        impulse: table.numbers("impulse_n_s").that(in_reach, &must).into(),
        start: table.number("at_s").between(0.0, TIME_MAX),
        duration: table.duration("lasts_s").as_secs_f64(),
    }
}

fn sensor_fault(table: &Table) -> Option<SensorFault> {
    let (start, duration) = (table.number("at_s").between(0.0, TIME_MAX), table.duration("lasts_s").as_secs_f64());
    let kinds = [
        ("freeze", Kind::Freeze),
        ("nan", Kind::NotANumber),
        ("spike", Kind::Spike),
        ("drop_out", Kind::DropOut),
        ("delay", Kind::Delay),
    ];
    let kind = table.choice("kind", kinds).and_then(|kind| fault_kind(table, kind));
    if kind.is_none() {
        // What goes with an unknown kind cannot be judged.
        for key in ["values", "joint", "foot", "size_deg", "size_deg_per_s", "size_n", "size_a", "delay_periods"] {
            table.has(key);
        }
    }
    Some(SensorFault { start, duration, kind: kind? })
}

fn fault_kind(table: &Table, kind: Kind) -> Option<SensorFaultKind> {
    Some(match kind {
        Kind::Freeze => SensorFaultKind::Freeze(values(table)?),
        Kind::NotANumber => SensorFaultKind::NotANumber(values(table)?),
        Kind::Spike => {
            let values = values(table)?;
            SensorFaultKind::Spike { values, size: size(table, values) }
        }
        Kind::DropOut => SensorFaultKind::DropOut,
        Kind::Delay => SensorFaultKind::Delay(table.integer("delay_periods", 1, Sensors::DELAY_MAX as u64) as u32),
    })
}

/// Which values: all of them, unless the script says less.
fn values(table: &Table) -> Option<SensedValues> {
    let group = if table.has("values") { table.choice("values", VALUES)? } else { SensedValues::All };
    let joint = || {
        let joints = Joint::ALL.into_iter().map(|joint| (joint.name(), joint));
        table.has("joint").then(|| table.choice("joint", joints)).flatten()
    };
    let foot = || {
        let feet = [("right", Side::Right), ("left", Side::Left)];
        table.has("foot").then(|| table.choice("foot", feet)).flatten()
    };
    Some(match group {
        SensedValues::Angles(_) => SensedValues::Angles(joint()),
        SensedValues::Rates(_) => SensedValues::Rates(joint()),
        SensedValues::Currents(_) => SensedValues::Currents(joint()),
        SensedValues::Feet(_) => SensedValues::Feet(foot()),
        whole => whole,
    })
}

/// How large a spike is, in the unit of its values.
fn size(table: &Table, values: SensedValues) -> f64 {
    match values {
        SensedValues::Angles(_) | SensedValues::Orientation => table.angle("size_deg").any(),
        SensedValues::Rates(_) | SensedValues::AngularRate => table.angle("size_deg_per_s").any(),
        SensedValues::Feet(_) => table.number("size_n").any(),
        SensedValues::Currents(_) => table.number("size_a").any(),
        SensedValues::All => {
            table.refuse("values", "must say which values a spike is in: \"all\" have no unit in common");
            f64::NAN
        }
    }
}
