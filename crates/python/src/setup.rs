//! What a walk begins with: the robot, and options of the run.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use config::Config;
use dialogue::script::Reader;
use interchange::import::NamedText;
use interface::{Rate, Request};
use lockstep::{LockstepOptions, LockstepWalk, WalkableRobot};
use plant::Disturbances;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use robots::{BuiltInRobot, ImportedRobot};

use crate::failure::bad_input;

/// Everything but the seed.
#[derive(Clone, Debug)]
pub(crate) struct Setup {
    robot: WalkableRobot,
    requests: Vec<Request>,
    disturbances: Disturbances,
    from_stand: bool,
    rate: Rate,
}

/// Where the robot comes from.
pub(crate) enum RobotSource {
    InTheBox(String),
    Folder(PathBuf),
    Urdf(PathBuf, Option<PathBuf>),
}

/// Texts of a configuration, each by the name of its file.
type Texts = BTreeMap<String, String>;

impl RobotSource {
    /// The one source that is given; the paper's robot if none is.
    pub(crate) fn of(
        robot: Option<String>,
        config: Option<PathBuf>,
        urdf: Option<PathBuf>,
        map: Option<PathBuf>,
    ) -> PyResult<Self> {
        match (robot, config, urdf, map) {
            (None, None, Some(urdf), map) => Ok(Self::Urdf(urdf, map)),
            (_, _, _, Some(map)) => Err(bad_input(format!("map = {}: goes with urdf only", map.display()))),
            (None, Some(folder), None, None) => Ok(Self::Folder(folder)),
            (Some(name), None, None, None) => Ok(Self::InTheBox(name)),
            (None, None, None, None) => Ok(Self::InTheBox(BuiltInRobot::of_the_paper().name.to_owned())),
            _ => Err(bad_input("robot, config, urdf: give one of them")),
        }
    }

    /// The folder of the files: paths in them are relative to it.
    pub(crate) fn folder(&self) -> &Path {
        match self {
            Self::InTheBox(_) | Self::Urdf(..) => Path::new(""),
            Self::Folder(folder) => folder,
        }
    }

    /// Reads the files.
    pub(crate) fn texts(&self) -> PyResult<Texts> {
        match self {
            Self::InTheBox(name) => {
                let robot =
                    BuiltInRobot::named(name).map_err(|known| bad_input(format!("robot = \"{name}\": {known}")))?;
                Ok(robot.files.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect())
            }
            Self::Folder(folder) => {
                let read =
                    |name: &str| Ok((name.to_owned(), config::read_text(&folder.join(name)).map_err(bad_input)?));
                WalkableRobot::FILES.into_iter().map(read).collect()
            }
            Self::Urdf(urdf, map) => {
                let read = |file: &Path| -> PyResult<[String; 2]> {
                    Ok([config::read_text(file).map_err(bad_input)?, file.display().to_string()])
                };
                let (urdf, map) = (read(urdf)?, map.as_deref().map(read).transpose()?);

                let imported = ImportedRobot::new(named(&urdf), map.as_ref().map(named)).map_err(bad_input)?;
                Ok(imported.files.into_iter().map(|(name, text)| (name.to_owned(), text)).collect())
            }
        }
    }
}

impl Setup {
    /// Reads a robot's texts, with other values for some keys, such as `{"plant.contact.friction": 0.4}`.
    pub(crate) fn new(
        source: &RobotSource,
        texts: &Texts,
        parameters: Option<&Bound<'_, PyDict>>,
        options: &Options,
    ) -> PyResult<Self> {
        let mut texts = texts.clone();
        for (key, value) in parameters.into_iter().flatten() {
            set(&mut texts, &key.extract::<String>()?, &value)?;
        }
        let texts: Vec<(&str, &str)> = texts.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
        let rate = Rate::new(options.rate_hz).ok_or_else(|| {
            let (least, most) = (Rate::HZ_MIN, Rate::HZ_MAX);
            bad_input(format!("rate_hz = {}: must be {least} to {most}", options.rate_hz))
        })?;
        let disturbances = options.disturbances.as_ref().map(Disturbances::load).transpose().map_err(bad_input)?;
        Ok(Self {
            robot: WalkableRobot::read(source.folder(), &texts).map_err(bad_input)?,
            requests: options.commands.as_deref().map_or(Ok(Vec::new()), |file| requests(file, rate))?,
            disturbances: disturbances.unwrap_or_default(),
            from_stand: options.from_stand,
            rate,
        })
    }

    /// A walk with the noise and the mass errors of a seed.
    pub(crate) fn walk(&self, seed: u64) -> PyResult<LockstepWalk> {
        let options = LockstepOptions { seed, rate: self.rate, from_stand: self.from_stand };
        let disturbances = self.disturbances.clone();
        LockstepWalk::new(&self.robot, &options, self.requests.iter().copied(), disturbances).map_err(bad_input)
    }
}

fn named([text, file]: &[String; 2]) -> NamedText<'_> {
    NamedText { text, file }
}

/// Options of a run.
pub(crate) struct Options {
    pub(crate) rate_hz: u32,
    pub(crate) from_stand: bool,
    pub(crate) commands: Option<PathBuf>,
    pub(crate) disturbances: Option<PathBuf>,
}

/// The requests of a script, each for its tick.
fn requests(file: &Path, rate: Rate) -> PyResult<Vec<Request>> {
    let text = config::read_text(file).map_err(bad_input)?;
    let steps = Reader::read_all(file.display().to_string(), text.as_bytes());
    let steps =
        steps.map_err(|wrong| bad_input(wrong.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")))?;
    Ok(steps.iter().map(|step| Request { not_before: step.tick(rate), ..step.request }).collect())
}

/// Sets a key such as `plant.contact.friction` in the text of `plant.toml`.
fn set(texts: &mut Texts, key: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
    let mut names = key.split('.');
    let file = format!("{}.toml", names.next().unwrap_or_default());
    let path: Vec<&str> = names.collect();
    let (Some((last, tables)), Some(text)) = (path.split_last(), texts.get_mut(&file)) else {
        return Err(bad_input(format!(
            "parameters: \"{key}\" must begin with controller, plant or mechanism, such as plant.contact.friction"
        )));
    };
    let mut document: toml::Table = text.parse().map_err(|error| bad_input(format!("{file}: {error}")))?;
    let mut table = &mut document;
    for name in tables {
        let inner = table.entry(*name).or_insert_with(|| toml::Value::Table(toml::Table::new()));
        let toml::Value::Table(inner) = inner else {
            return Err(bad_input(format!("parameters: \"{key}\": `{name}` is no table of {file}")));
        };
        table = inner;
    }
    table.insert((*last).to_owned(), toml_value(key, value)?);
    *text = document.to_string();
    Ok(())
}

fn toml_value(key: &str, value: &Bound<'_, PyAny>) -> PyResult<toml::Value> {
    if let Ok(flag) = value.cast::<pyo3::types::PyBool>() {
        return Ok(flag.is_true().into());
    }
    if let Ok(number) = value.extract::<i64>() {
        return Ok(number.into());
    }
    if let Ok(number) = value.extract::<f64>() {
        return Ok(number.into());
    }
    if let Ok(text) = value.extract::<String>() {
        return Ok(text.into());
    }
    if let Ok(list) = value.extract::<Vec<Bound<'_, PyAny>>>() {
        return list.iter().map(|item| toml_value(key, item)).collect::<PyResult<Vec<_>>>().map(toml::Value::Array);
    }
    Err(bad_input(format!("parameters: \"{key}\" must be a flag, a number, a text, or a list of these")))
}
