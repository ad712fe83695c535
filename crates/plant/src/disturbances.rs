//! Disturbances of a run, from a script: pushes and sensor faults.
//!
//! ```toml
//! [[push]]
//! at_s = 3.0
//! lasts_s = 0.1
//! impulse_n_s = [0, 6, 0] # ahead, left, up
//! link = "trunk"          # the default
//!
//! [[sensor_fault]]
//! at_s = 5.0
//! lasts_s = 0.02
//! kind = "spike"          # config/disturbances_demo.toml names the others
//! values = "rates"
//! joint = "left_knee"
//! size_deg_per_s = 900
//! ```

use config::{Config, Table};
use model::{Joint, Mechanism, Side};

use crate::{Push, SensedValues, SensorFault, SensorFaultKind, Sensors};

/// The disturbances of a run. None by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Disturbances {
    /// Pushes on links of the robot.
    pub pushes: Vec<Push>,
    /// Faults of the sensors; simultaneous ones act in this order.
    pub sensor_faults: Vec<SensorFault>,
}

/// Latest time in a script (s); a later one is a mistake of unit.
const TIME_MAX: f64 = 1e6;
/// Shortest disturbance (s), shorter than a step of the plant at any rate.
const LASTS_MIN: f64 = 1e-6;
/// Largest component of an impulse (N·s), far more than fells any robot; a larger one is a mistake of unit.
const IMPULSE_MAX: f64 = 1e4;
/// The groups of sensed values by their names in a script.
const VALUES: [(&str, SensedValues); 8] = [
    ("all", SensedValues::All),
    ("angles", SensedValues::Angles(None)),
    ("rates", SensedValues::Rates(None)),
    ("currents", SensedValues::Currents(None)),
    ("feet", SensedValues::Feet(None)),
    ("orientation", SensedValues::Orientation),
    ("angular_rate", SensedValues::AngularRate),
    ("specific_force", SensedValues::SpecificForce),
];

/// The kinds of sensor fault by which a script names them, before their parameters are read.
#[derive(Clone, Copy)]
enum Kind {
    Freeze,
    NotANumber,
    Missing,
    Spike,
    Drift,
    Saturate,
    Reverse,
    Swap,
    DropOut,
    HalfRate,
    Delay,
}

impl Disturbances {
    /// Most pushes of a run at a time, those of the script that are still to come included, beyond which none is added
    /// while it runs.
    pub const PUSHES_MAX: usize = 64;

    /// Makes room for pushes that are added while the run goes on, so that adding one allocates nothing.
    pub fn make_room(&mut self) {
        self.pushes.reserve(Self::PUSHES_MAX);
    }

    /// Adds a push, in place of those that are over. Whether there was room.
    pub(crate) fn add(&mut self, push: Push) -> bool {
        self.pushes.retain(|earlier| earlier.start + earlier.duration > push.start);
        let has_room = self.pushes.len() < Self::PUSHES_MAX;
        if has_room {
            self.pushes.push(push);
        }
        has_room
    }
}

impl Config for Disturbances {
    fn read(root: &Table) -> Self {
        Self {
            pushes: root.tables("push").iter().map(push).collect(),
            sensor_faults: root.tables("sensor_fault").iter().filter_map(sensor_fault).collect(),
        }
    }
}

fn push(table: &Table) -> Push {
    let links = || Joint::ALL.into_iter().filter_map(|joint| Some((joint.link_name()?, joint)));
    let must = format!("each must lie between -{IMPULSE_MAX} and {IMPULSE_MAX}");
    let in_reach = |impulse: &[f64; 3]| impulse.iter().all(|component| component.abs() <= IMPULSE_MAX);
    Push {
        link: if table.has("link") {
            table.choice("link", links()).unwrap_or(Mechanism::TRUNK)
        } else {
            Mechanism::TRUNK
        },
        impulse: table.numbers("impulse_n_s").that(in_reach, &must).into(),
        start: table.number("at_s").between(0.0, TIME_MAX),
        duration: table.duration("lasts_s", LASTS_MIN, TIME_MAX).as_secs_f64(),
    }
}

fn sensor_fault(table: &Table) -> Option<SensorFault> {
    let (start, duration) =
        (table.number("at_s").between(0.0, TIME_MAX), table.duration("lasts_s", LASTS_MIN, TIME_MAX).as_secs_f64());
    let kinds = [
        ("freeze", Kind::Freeze),
        ("nan", Kind::NotANumber),
        ("missing", Kind::Missing),
        ("spike", Kind::Spike),
        ("drift", Kind::Drift),
        ("saturate", Kind::Saturate),
        ("reverse", Kind::Reverse),
        ("swap", Kind::Swap),
        ("drop_out", Kind::DropOut),
        ("half_rate", Kind::HalfRate),
        ("delay", Kind::Delay),
    ];
    let kind = table.choice("kind", kinds).and_then(|kind| fault_kind(table, kind));
    if kind.is_none() {
        // The parameters of an unknown kind cannot be checked: none of them is an unknown key.
        for key in [
            "values",
            "joint",
            "foot",
            "size_deg",
            "size_deg_per_s",
            "size_m_per_s2",
            "size_n",
            "size_a",
            "delay_periods",
        ] {
            table.has(key);
        }
    }
    Some(SensorFault { start, duration, kind: kind? })
}

fn fault_kind(table: &Table, kind: Kind) -> Option<SensorFaultKind> {
    Some(match kind {
        Kind::Freeze => SensorFaultKind::Freeze(values(table)?),
        Kind::NotANumber => SensorFaultKind::NotANumber(values(table)?),
        Kind::Missing => SensorFaultKind::Missing(values(table)?),
        Kind::Spike => {
            let values = values(table)?;
            SensorFaultKind::Spike { values, size: size(table, values) }
        }
        Kind::Drift => {
            let values = values(table)?;
            SensorFaultKind::Drift { values, rate: size(table, values) }
        }
        Kind::Saturate => {
            let values = values(table)?;
            SensorFaultKind::Saturate { values, limit: size(table, values) }
        }
        Kind::Reverse => SensorFaultKind::Reverse(values(table)?),
        Kind::Swap => SensorFaultKind::Swap(values(table)?),
        Kind::DropOut => SensorFaultKind::DropOut,
        Kind::HalfRate => SensorFaultKind::HalfRate,
        Kind::Delay => SensorFaultKind::Delay(table.integer("delay_periods", 1, Sensors::DELAY_MAX as u64) as u32),
    })
}

/// The values that a fault affects: all of them, unless the script names some.
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

/// Size of a spike, of a drift within a second, or of the range of a saturated sensor, in the unit of its values.
fn size(table: &Table, values: SensedValues) -> f64 {
    match values {
        SensedValues::Angles(_) | SensedValues::Orientation => table.angle("size_deg").between(-360.0, 360.0),
        SensedValues::Rates(_) | SensedValues::AngularRate => table.angle("size_deg_per_s").between(-1e6, 1e6),
        SensedValues::SpecificForce => table.number("size_m_per_s2").between(-1e6, 1e6),
        SensedValues::Feet(_) => table.number("size_n").between(-1e7, 1e7),
        SensedValues::Currents(_) => table.number("size_a").between(-1e6, 1e6),
        SensedValues::All => {
            table.refuse("values", "must say which values have the size: \"all\" have no unit in common");
            f64::NAN
        }
    }
}
