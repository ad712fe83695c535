//! Numbers and vectors of eight motions side by side, in plain loops that the compiler turns into vector code.
//!
//! Everything is inlined into the one function that sets the width of the registers; otherwise it would be compiled for
//! narrow ones.

use std::ops::{Add, Mul, Sub};

use nalgebra::Vector3;

/// Number of motions that a [`Batch`](crate::Batch) computes at once.
pub const LANES: usize = 8;

/// A number for each motion.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Lanes(pub [f64; LANES]);

/// A vector for each motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vectors {
    pub x: Lanes,
    pub y: Lanes,
    pub z: Lanes,
}

impl Lanes {
    pub(crate) const ZERO: Lanes = Lanes([0.0; LANES]);

    #[inline(always)]
    pub(crate) fn times(self, factor: f64) -> Lanes {
        self * Lanes([factor; LANES])
    }
}

impl Add for Lanes {
    type Output = Lanes;

    #[inline(always)]
    fn add(self, other: Lanes) -> Lanes {
        let mut sum = Lanes::ZERO;
        for lane in 0..LANES {
            sum.0[lane] = self.0[lane] + other.0[lane];
        }
        sum
    }
}

impl Sub for Lanes {
    type Output = Lanes;

    #[inline(always)]
    fn sub(self, other: Lanes) -> Lanes {
        let mut difference = Lanes::ZERO;
        for lane in 0..LANES {
            difference.0[lane] = self.0[lane] - other.0[lane];
        }
        difference
    }
}

impl Mul for Lanes {
    type Output = Lanes;

    #[inline(always)]
    fn mul(self, other: Lanes) -> Lanes {
        let mut product = Lanes::ZERO;
        for lane in 0..LANES {
            product.0[lane] = self.0[lane] * other.0[lane];
        }
        product
    }
}

impl Vectors {
    pub(crate) const ZERO: Vectors = Vectors { x: Lanes::ZERO, y: Lanes::ZERO, z: Lanes::ZERO };

    pub(crate) fn lane(&self, lane: usize) -> Vector3<f64> {
        Vector3::new(self.x.0[lane], self.y.0[lane], self.z.0[lane])
    }

    #[inline(always)]
    pub(crate) fn times(self, factor: f64) -> Vectors {
        Vectors { x: self.x.times(factor), y: self.y.times(factor), z: self.z.times(factor) }
    }

    /// The vector rotated about the unit vector `axis`, along which it has the component `share` (Rodrigues' formula).
    #[inline(always)]
    pub(crate) fn about(&self, axis: &Vectors, share: f64, sine: Lanes, cosine: Lanes) -> Vectors {
        *self * cosine + axis.cross(self) * sine + axis.times(share) * (Lanes([1.0; LANES]) - cosine)
    }

    #[inline(always)]
    pub(crate) fn dot(&self, other: &Vectors) -> Lanes {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub(crate) fn cross(&self, other: &Vectors) -> Vectors {
        Vectors {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }
}

impl Add for Vectors {
    type Output = Vectors;

    #[inline(always)]
    fn add(self, other: Vectors) -> Vectors {
        Vectors { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl Sub for Vectors {
    type Output = Vectors;

    #[inline(always)]
    fn sub(self, other: Vectors) -> Vectors {
        Vectors { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl Mul<Lanes> for Vectors {
    type Output = Vectors;

    #[inline(always)]
    fn mul(self, factor: Lanes) -> Vectors {
        Vectors { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}
