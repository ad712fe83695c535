//! One walk for Python.

use std::path::PathBuf;

use model::{Joint, PerJoint};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::WIDTH;
use crate::failure::bad_input;
use crate::one_walk::{OneWalk, link, stable};
use crate::setup::{Options, RobotSource, Setup};

/// Longest time that a request may wait for its reply (s): two half-steps of the slowest walk.
const REPLY_WITHIN: f64 = 5.0;

/// A walk: controller and plant in this process, tick by tick.
#[pyclass(name = "Walk", module = "halfstep._halfstep")]
pub(crate) struct PythonWalk {
    setup: Setup,
    seed: u64,
    walk: OneWalk,
}

/// A walk as it was at an instant, to the bit.
#[pyclass(module = "halfstep._halfstep", frozen)]
pub(crate) struct Snapshot(pub(crate) OneWalk);

#[pymethods]
impl PythonWalk {
    #[new]
    #[pyo3(signature = (robot=None, *, config=None, urdf=None, map=None, seed=0, from_stand=true, rate_hz=1000,
        parameters=None, commands=None, disturbances=None))]
    #[expect(clippy::too_many_arguments, reason = "they are named in Python")]
    fn new(
        robot: Option<String>,
        config: Option<PathBuf>,
        urdf: Option<PathBuf>,
        map: Option<PathBuf>,
        seed: u64,
        from_stand: bool,
        rate_hz: u32,
        parameters: Option<&Bound<'_, PyDict>>,
        commands: Option<PathBuf>,
        disturbances: Option<PathBuf>,
    ) -> PyResult<Self> {
        let source = RobotSource::of(robot, config, urdf, map)?;
        let setup = Setup::new(
            &source,
            &source.texts()?,
            parameters,
            &Options { rate_hz, from_stand, commands, disturbances },
        )?;
        Ok(Self { walk: OneWalk::new(setup.walk(seed)?), seed, setup })
    }

    /// Walks on by so many control periods.
    #[pyo3(signature = (periods=1))]
    fn step(&mut self, py: Python<'_>, periods: u64) -> PyResult<()> {
        let walk = &mut self.walk;
        stable(py.detach(|| walk.steps(periods)))
    }

    /// Walks on and returns a row for every so many periods, the last one of them included.
    fn rows<'py>(&mut self, py: Python<'py>, rows: usize, every: u64) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let walk = &mut self.walk;
        let (numbers, result) = py.detach(|| {
            let mut numbers = vec![0.0; rows * WIDTH];
            let result = numbers.chunks_exact_mut(WIDTH).try_for_each(|row| {
                walk.steps(every)?;
                walk.write(row);
                Ok(())
            });
            (numbers, result)
        });
        stable(result)?;
        PyArray1::from_vec(py, numbers).reshape([rows, WIDTH])
    }

    /// The present state.
    fn row<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let mut row = vec![0.0; WIDTH];
        self.walk.write(&mut row);
        PyArray1::from_vec(py, row)
    }

    /// Asks for what a line of JSON says, walks on until the controller has replied, and returns the reply as JSON.
    fn ask(&mut self, py: Python<'_>, line: &str) -> PyResult<String> {
        self.walk.ask(line)?;
        let walk = &mut self.walk;
        py.detach(|| {
            let until = walk.walk.time() + REPLY_WITHIN;
            while walk.verdict().is_none() && walk.walk.time() < until {
                walk.step();
            }
        });
        self.walk.reply().ok_or_else(|| bad_input("the controller did not reply"))
    }

    /// Pushes a link from the next period on: impulse ahead, to the left and up (N·s).
    #[pyo3(signature = (impulse, lasts=0.1, name="trunk"))]
    fn push(&mut self, impulse: [f64; 3], lasts: f64, name: &str) -> PyResult<()> {
        self.walk.push(impulse, lasts, link(name)?)
    }

    /// Adds an angle to each joint's setpoint from the next period on (rad).
    fn residual(&mut self, angles: [f64; Joint::COUNT]) {
        self.walk.walk.set_joint_residual(&PerJoint(angles));
    }

    /// Begins anew, with another seed if one is given.
    #[pyo3(signature = (seed=None))]
    fn reset(&mut self, seed: Option<u64>) -> PyResult<()> {
        self.seed = seed.unwrap_or(self.seed);
        self.walk = OneWalk::new(self.setup.walk(self.seed)?);
        Ok(())
    }

    /// The walk as it is now.
    fn save(&self) -> Snapshot {
        Snapshot(self.walk.clone())
    }

    /// Goes back to how the walk was.
    fn restore(&mut self, snapshot: &Snapshot) {
        self.walk = snapshot.0.clone();
    }

    /// Control periods walked.
    #[getter]
    fn tick(&self) -> u64 {
        self.walk.walk.tick()
    }

    /// Control periods per second.
    #[getter]
    fn rate_hz(&self) -> u32 {
        self.walk.walk.rate().hz()
    }

    /// The seed of noise and mass errors.
    #[getter]
    fn seed(&self) -> u64 {
        self.seed
    }

    /// One number for all setpoints so far: two walks with the same one have commanded the same bits.
    #[getter]
    fn setpoint_hash(&self) -> String {
        self.walk.walk.setpoints().to_string()
    }
}
