//! Many walks at once for Python, on all cores.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::thread::available_parallelism;

use model::{Joint, PerJoint};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::WIDTH;
use crate::failure::bad_input;
use crate::one_walk::{OneWalk, link};
use crate::setup::{Options, RobotSource, Setup};
use crate::walk::Snapshot;

/// Walks of one robot, each with its own seed, parameters and disturbances.
#[pyclass(name = "Batch", module = "halfstep._halfstep")]
pub(crate) struct PythonBatch {
    setups: Vec<Setup>,
    seeds: Vec<u64>,
    walks: Vec<OneWalk>,
    /// Why a walk is at its end, if it is: it steps no more.
    ended: Vec<Option<String>>,
    threads: usize,
}

#[pymethods]
impl PythonBatch {
    #[new]
    #[pyo3(signature = (robot, seeds, *, config=None, urdf=None, map=None, from_stand=true, rate_hz=1000,
        parameters=None, commands=None, disturbances=None, threads=None))]
    #[expect(clippy::too_many_arguments, reason = "they are named in Python")]
    fn new(
        robot: Option<String>,
        seeds: Vec<u64>,
        config: Option<PathBuf>,
        urdf: Option<PathBuf>,
        map: Option<PathBuf>,
        from_stand: bool,
        rate_hz: u32,
        parameters: Option<Vec<Bound<'_, PyDict>>>,
        commands: Option<PathBuf>,
        disturbances: Option<Vec<Option<PathBuf>>>,
        threads: Option<NonZeroUsize>,
    ) -> PyResult<Self> {
        let count = seeds.len();
        let wrong = |name: &str, given: usize| {
            bad_input(format!("{name}: one for each of the {count} walks, but there are {given}"))
        };
        if let Some(given) = parameters.as_ref().map(Vec::len).filter(|given| *given != count) {
            return Err(wrong("parameters", given));
        }
        if let Some(given) = disturbances.as_ref().map(Vec::len).filter(|given| *given != count) {
            return Err(wrong("disturbances", given));
        }
        let source = RobotSource::of(robot, config, urdf, map)?;
        let texts = source.texts()?;
        let setup = |place: usize| {
            let disturbances = disturbances.as_ref().and_then(|files| files[place].clone());
            let options = Options { rate_hz, from_stand, commands: commands.clone(), disturbances };
            Setup::new(&source, &texts, parameters.as_ref().map(|each| &each[place]), &options)
        };
        let setups = if parameters.is_none() && disturbances.is_none() && count > 0 {
            vec![setup(0)?; count]
        } else {
            (0..count).map(setup).collect::<PyResult<_>>()?
        };
        let walks = setups.iter().zip(&seeds).map(|(setup, seed)| Ok(OneWalk::new(setup.walk(*seed)?)));
        let walks = walks.collect::<PyResult<Vec<_>>>()?;
        let threads = threads.or_else(|| available_parallelism().ok()).map_or(1, NonZeroUsize::get);
        Ok(Self { ended: vec![None; count], setups, seeds, walks, threads })
    }

    fn __len__(&self) -> usize {
        self.walks.len()
    }

    /// All walk on by so many control periods. One whose simulation becomes unstable ends.
    #[pyo3(signature = (periods=1))]
    fn step(&mut self, py: Python<'_>, periods: u64) {
        let Self { walks, ended, threads, .. } = self;
        py.detach(|| {
            let share = walks.len().div_ceil(*threads).max(1);
            std::thread::scope(|scope| {
                for (walks, ended) in walks.chunks_mut(share).zip(ended.chunks_mut(share)) {
                    scope.spawn(move || {
                        for (walk, ended) in walks.iter_mut().zip(ended).filter(|(_, ended)| ended.is_none()) {
                            *ended = walk.steps(periods).err();
                        }
                    });
                }
            });
        });
    }

    /// The present states, a row each.
    fn rows<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let mut numbers = vec![0.0; self.walks.len() * WIDTH];
        for (walk, row) in self.walks.iter().zip(numbers.chunks_exact_mut(WIDTH)) {
            walk.write(row);
        }
        PyArray1::from_vec(py, numbers).reshape([self.walks.len(), WIDTH])
    }

    /// Asks each walk for what its line of JSON says, from the next period on; those without a line for nothing.
    fn ask(&mut self, lines: Vec<Option<String>>) -> PyResult<()> {
        if lines.len() != self.walks.len() {
            return Err(bad_input(format!("{} requests for {} walks", lines.len(), self.walks.len())));
        }
        let asked = self.walks.iter_mut().zip(lines);
        asked.filter_map(|(walk, line)| Some((walk, line?))).try_for_each(|(walk, line)| walk.ask(&line))
    }

    /// The replies to the newest requests as JSON, where there are any yet.
    fn replies(&self) -> Vec<Option<String>> {
        self.walks.iter().map(OneWalk::reply).collect()
    }

    /// Pushes a link of each: impulses ahead, to the left and up (N·s), a row each. A row of zeros is no push.
    #[pyo3(signature = (impulses, lasts=0.1, name="trunk"))]
    fn push(&mut self, impulses: PyReadonlyArray2<'_, f64>, lasts: f64, name: &str) -> PyResult<()> {
        if impulses.shape() != [self.walks.len(), 3] {
            let ([rows, columns], walks) = ([impulses.shape()[0], impulses.shape()[1]], self.walks.len());
            return Err(bad_input(format!("impulses: must be {walks} × 3, but are {rows} × {columns}")));
        }
        let link = link(name)?;
        for (walk, impulse) in self.walks.iter_mut().zip(impulses.as_array().rows()) {
            let impulse = [impulse[0], impulse[1], impulse[2]];
            if impulse != [0.0; 3] {
                walk.push(impulse, lasts, link)?;
            }
        }
        Ok(())
    }

    /// Adds an angle to each joint's setpoint of each walk from the next period on (rad), a row each.
    fn residuals(&mut self, angles: PyReadonlyArray2<'_, f64>) -> PyResult<()> {
        if angles.shape() != [self.walks.len(), Joint::COUNT] {
            let ([rows, columns], walks) = ([angles.shape()[0], angles.shape()[1]], self.walks.len());
            let joints = Joint::COUNT;
            return Err(bad_input(format!("angles: must be {walks} × {joints}, but are {rows} × {columns}")));
        }
        for (walk, angles) in self.walks.iter_mut().zip(angles.as_array().rows()) {
            walk.walk.set_joint_residual(&PerJoint::from_fn(|joint| angles[joint.index()]));
        }
        Ok(())
    }

    /// Begins one of them anew, with another seed if one is given.
    #[pyo3(signature = (place, seed=None))]
    fn reset_one(&mut self, place: usize, seed: Option<u64>) -> PyResult<()> {
        self.check(place)?;
        self.seeds[place] = seed.unwrap_or(self.seeds[place]);
        self.walks[place] = OneWalk::new(self.setups[place].walk(self.seeds[place])?);
        self.ended[place] = None;
        Ok(())
    }

    /// One of them as it is now.
    fn save(&self, place: usize) -> PyResult<Snapshot> {
        self.check(place)?;
        Ok(Snapshot(self.walks[place].clone()))
    }

    /// One of them goes on from there.
    fn restore(&mut self, place: usize, snapshot: &Snapshot) -> PyResult<()> {
        self.check(place)?;
        self.walks[place] = snapshot.0.clone();
        self.ended[place] = None;
        Ok(())
    }

    /// Why walks are at their end, where they are.
    #[getter]
    fn ended(&self) -> Vec<Option<String>> {
        self.ended.clone()
    }

    /// The seeds.
    #[getter]
    fn seeds(&self) -> Vec<u64> {
        self.seeds.clone()
    }

    /// Control periods per second.
    #[getter]
    fn rate_hz(&self) -> Option<u32> {
        self.walks.first().map(|walk| walk.walk.rate().hz())
    }

    /// For each walk, one number for all its setpoints so far.
    #[getter]
    fn setpoint_hashes(&self) -> Vec<String> {
        self.walks.iter().map(|walk| walk.walk.setpoints().to_string()).collect()
    }
}

impl PythonBatch {
    fn check(&self, place: usize) -> PyResult<()> {
        let count = self.walks.len();
        if place < count { Ok(()) } else { Err(bad_input(format!("place = {place}: there are {count} walks"))) }
    }
}
