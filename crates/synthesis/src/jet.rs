//! A quantity with its first and second derivative in time, by automatic differentiation.

use std::ops::{Add, Mul, Neg, Sub};

use dynamics::sin_cos;
use nalgebra::Vector3;

/// Value, first and second derivative in time of a quantity at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Jet {
    /// Value of the quantity (rad, m, -).
    pub value: f64,
    /// First derivative in time (rad/s, m/s, 1/s).
    pub rate: f64,
    /// Second derivative in time (rad/s², m/s², 1/s²).
    pub acceleration: f64,
}

/// A moving point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointMotion {
    /// Position of the point (m).
    pub position: Vector3<f64>,
    /// Velocity of the point (m/s).
    pub velocity: Vector3<f64>,
    /// Acceleration of the point (m/s²).
    pub acceleration: Vector3<f64>,
}

impl Jet {
    pub(crate) const fn constant(value: f64) -> Self {
        Self { value, rate: 0.0, acceleration: 0.0 }
    }

    /// `f` of this quantity, given the value and the two derivatives of `f` here.
    pub(crate) fn chain(self, value: f64, first: f64, second: f64) -> Self {
        Self {
            value,
            rate: first * self.rate,
            acceleration: second * self.rate * self.rate + first * self.acceleration,
        }
    }

    pub(crate) fn cos(self) -> Self {
        let (sine, cosine) = sin_cos(self.value);
        self.chain(cosine, -sine, -cosine)
    }

    pub(crate) fn sin(self) -> Self {
        let (sine, cosine) = sin_cos(self.value);
        self.chain(sine, cosine, -sine)
    }

    pub(crate) fn sinh(self) -> Self {
        let (sinh, cosh) = sinh_cosh(self.value);
        self.chain(sinh, cosh, sinh)
    }

    pub(crate) fn cosh(self) -> Self {
        let (sinh, cosh) = sinh_cosh(self.value);
        self.chain(cosh, sinh, cosh)
    }

    /// From 0 to 1 as the quantity goes from 0 to 1, with three derivatives zero at both ends.
    pub(crate) fn smooth_step(self) -> Self {
        let square = self * self;
        square * square * (((self * -20.0 + 70.0) * self - 84.0) * self + 35.0)
    }

    /// From 0 over 1 in the middle back to 0 as the quantity goes from 0 to 1, with two derivatives zero at both ends.
    pub(crate) fn bump(self) -> Self {
        let arch = self * (-self + 1.0) * 4.0;
        arch * arch * arch
    }
}

impl PointMotion {
    pub(crate) const AT_REST: Self = Self {
        position: Vector3::new(0.0, 0.0, 0.0),
        velocity: Vector3::new(0.0, 0.0, 0.0),
        acceleration: Vector3::new(0.0, 0.0, 0.0),
    };

    /// The sum of two motions.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            position: self.position + other.position,
            velocity: self.velocity + other.velocity,
            acceleration: self.acceleration + other.acceleration,
        }
    }

    pub(crate) fn new(x: Jet, y: Jet, z: Jet) -> Self {
        Self {
            position: Vector3::new(x.value, y.value, z.value),
            velocity: Vector3::new(x.rate, y.rate, z.rate),
            acceleration: Vector3::new(x.acceleration, y.acceleration, z.acceleration),
        }
    }
}

/// Hyperbolic sine and cosine by their power series, the same bits on every machine; exact to rounding for |x| ≤ 4.
pub(crate) fn sinh_cosh(x: f64) -> (f64, f64) {
    const TERMS: u32 = 20;
    let square = x * x;
    let (mut sinh, mut cosh) = (1.0, 1.0);
    // Horner's rule, from the smallest term to the largest.
    for term in (1..TERMS).rev() {
        let even = f64::from(2 * term);
        cosh = 1.0 + cosh * square / (even * (even - 1.0));
        sinh = 1.0 + sinh * square / (even * (even + 1.0));
    }
    (x * sinh, cosh)
}

impl Add for Jet {
    type Output = Jet;

    fn add(self, other: Jet) -> Jet {
        Jet {
            value: self.value + other.value,
            rate: self.rate + other.rate,
            acceleration: self.acceleration + other.acceleration,
        }
    }
}

impl Sub for Jet {
    type Output = Jet;

    fn sub(self, other: Jet) -> Jet {
        self + -other
    }
}

impl Mul for Jet {
    type Output = Jet;

    fn mul(self, other: Jet) -> Jet {
        Jet {
            value: self.value * other.value,
            rate: self.rate * other.value + self.value * other.rate,
            acceleration: self.acceleration * other.value
                + 2.0 * self.rate * other.rate
                + self.value * other.acceleration,
        }
    }
}

impl Neg for Jet {
    type Output = Jet;

    fn neg(self) -> Jet {
        self * -1.0
    }
}

impl Add<f64> for Jet {
    type Output = Jet;

    fn add(self, other: f64) -> Jet {
        Jet { value: self.value + other, ..self }
    }
}

impl Sub<f64> for Jet {
    type Output = Jet;

    fn sub(self, other: f64) -> Jet {
        self + -other
    }
}

impl Mul<f64> for Jet {
    type Output = Jet;

    fn mul(self, factor: f64) -> Jet {
        Jet { value: self.value * factor, rate: self.rate * factor, acceleration: self.acceleration * factor }
    }
}

#[cfg(test)]
mod tests {
    use super::{Jet, sinh_cosh};

    /// Oracle: central differences of the value.
    #[test]
    fn derivatives_of_a_jet_agree_with_differences_of_its_value() {
        let f = |time: f64| {
            let s = Jet { value: time, rate: 1.0, acceleration: 0.0 };
            s.bump() * (s * 2.0).sinh() + s.smooth_step() * (s * 3.0).cos() - (s * s).cosh() * s.sin()
        };
        let h = 1e-4;
        for time in [0.1, 0.35, 0.5, 0.8] {
            let (before, here, after) = (f(time - h), f(time), f(time + h));
            assert!((here.rate - (after.value - before.value) / (2.0 * h)).abs() < 1e-5);
            assert!((here.acceleration - (after.rate - before.rate) / (2.0 * h)).abs() < 1e-4);
        }
    }

    #[test]
    fn hyperbolic_functions_agree_with_the_standard_library() {
        for step in -40..=40 {
            let x = f64::from(step) * 0.1;
            let (sinh, cosh) = sinh_cosh(x);
            assert!((sinh - x.sinh()).abs() <= 1e-15 * cosh && (cosh - x.cosh()).abs() <= 1e-15 * cosh, "{x}");
        }
    }

    #[test]
    fn smooth_step_and_bump_are_at_rest_at_both_ends() {
        for end in [0.0, 1.0] {
            let s = Jet { value: end, rate: 1.0, acceleration: 0.0 };
            assert_eq!(s.smooth_step(), Jet { value: end, ..Jet::default() });
            assert_eq!(s.bump().value.abs() + s.bump().rate.abs() + s.bump().acceleration.abs(), 0.0);
        }
    }
}
