//! The files that people write, each with its loader.

use std::fs;
use std::path::Path;

use config::Config;
use dialogue::script;
use gait::NominalTable;
use halfstep_tests::repository;
use interchange::import::{NamedText, import};
use model::{Joint, Mechanism};
use node::realtime::RealtimeParameters;
use paper::{Reading, Scenario};
use plant::{Disturbances, PlantParameters};
use synthesis::GaitRecording;

/// What a loader made of a text.
pub(super) enum Loaded {
    Mechanism(Box<Mechanism>),
    Nominal(NominalTable),
    Controller(Box<controller::Parameters>),
    Plant(Box<PlantParameters>),
    Disturbances(Disturbances),
    /// Nothing that walks.
    Other,
}

/// A file that people write.
pub(super) struct File {
    /// Its name in `config/`, or of a file that is made for the test.
    pub name: &'static str,
    /// Its text as committed.
    pub text: String,
    load: fn(&str) -> Result<Loaded, String>,
}

impl File {
    /// Reads a text as this file.
    pub(super) fn load(&self, text: &str) -> Result<Loaded, String> {
        (self.load)(text)
    }
}

/// A loader of TOML.
fn toml<C: Config>(text: &str, file: &str, loaded: impl Fn(C) -> Loaded) -> Result<Loaded, String> {
    C::from_toml(text, file).map(loaded).map_err(|errors| errors.to_string())
}

/// All of them.
pub(super) fn files() -> Vec<File> {
    let committed = |name: &'static str, load| {
        let text = fs::read_to_string(repository().join("config").join(name)).expect("a committed file");
        File { name, text, load }
    };
    vec![
        committed("mechanism.toml", |text| toml(text, "f", |read| Loaded::Mechanism(Box::new(read)))),
        committed("controller.toml", |text| toml(text, "f", |read| Loaded::Controller(Box::new(read)))),
        committed("plant.toml", |text| toml(text, "f", |read| Loaded::Plant(Box::new(read)))),
        committed("realtime.toml", |text| toml::<RealtimeParameters>(text, "f", |_| Loaded::Other)),
        committed("disturbances_demo.toml", |text| toml(text, "f", Loaded::Disturbances)),
        committed("paper.toml", |text| toml::<Reading>(text, "f", |_| Loaded::Other)),
        committed("scenarios/figure_04.toml", |text| toml::<Scenario>(text, "figure_04.toml", |_| Loaded::Other)),
        committed("nominal_half_step.csv", |text| {
            NominalTable::from_csv(text, Path::new("f")).map(Loaded::Nominal).map_err(|error| error.to_string())
        }),
        committed("recorded_leg_shape.csv", |text| {
            GaitRecording::parse(text, Path::new("f")).map(|_| Loaded::Other).map_err(|error| error.to_string())
        }),
        committed("commands_demo.jsonl", |text| match script::Reader::read_all("f", text.as_bytes()) {
            Ok(_) => Ok(Loaded::Other),
            Err(errors) => Err(errors[0].to_string()),
        }),
        File { name: "map.toml", text: map(), load: |text| imported(&urdf(), text) },
        File { name: "robot.urdf", text: urdf(), load: |text| imported(text, &map()) },
    ]
}

fn imported(urdf: &str, map: &str) -> Result<Loaded, String> {
    let (urdf, map) = (NamedText { text: urdf, file: "f" }, NamedText { text: map, file: "f" });
    let imported = import(urdf, Some(map)).map_err(|error| error.to_string())?;
    // What the importer accepts, the loader must take.
    let mechanism =
        Mechanism::from_toml(&imported.text, "f").unwrap_or_else(|error| panic!("{error}\n{}", imported.text));
    Ok(Loaded::Mechanism(Box::new(mechanism)))
}

/// Our robot as a URDF.
fn urdf() -> String {
    interchange::urdf::urdf_text(&halfstep_tests::mechanism()).expect("our robot can be written")
}

/// The map that makes it our robot again.
fn map() -> String {
    let ours = fs::read_to_string(repository().join("config/mechanism.toml")).expect("a committed file");
    let mut map = ours[..ours.find("[joint.").expect("a joint")].to_owned();
    for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
        let name = joint.name();
        let (motor, rate) = if joint >= Joint::RightShoulder { ("arm", 600) } else { ("leg", 500) };
        map += &format!("[joint.{name}]\nurdf = \"{name}\"\nmotor = \"{motor}\"\nrate_max_deg_per_s = {rate}\n");
    }
    map
}
