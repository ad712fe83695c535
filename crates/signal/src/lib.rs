//! Filters and blends of scalar and vector signals.
//!
//! Every filter advances by an implicit step, so it is stable for any step size and time constant. A signal is anything
//! that adds, subtracts and scales: a number, a vector, a wrench.

mod critically_damped;
mod low_pass;
mod quintic;

pub use critically_damped::{CriticallyDamped, critically_damped_rate};
pub use low_pass::LowPass;
pub use quintic::{quintic_to_rest, smooth_step};

use std::ops::{Add, Div, Mul, Sub};

/// A value that filters can work on: a vector space over `f64`.
pub trait Signal:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> + Div<f64, Output = Self>
{
}

impl<T> Signal for T where T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T> + Div<f64, Output = T> {}
