//! Sine and cosine, the same bits on every machine and without a branch, so that loops over joints compile to vector
//! code.
//!
//! The system's libm differs from version to version in the last bit and is called once per value. Here: Cody–Waite
//! reduction to ±π/4 and the minimax polynomials of FreeBSD's msun (`k_sin.c`, `k_cos.c`); within 2.5·10⁻¹⁶ for |x| ≤
//! 10⁵, far beyond any joint.

use std::ops::Range;

use model::{Joint, JointVector};

const TWO_OVER_PI: f64 = std::f64::consts::FRAC_2_PI;
/// π/2 in two parts; the first has 33 bits, so that its product with a whole number is exact.
const HALF_PI_HIGH: f64 = 1.570_796_326_734_125_6;
const HALF_PI_LOW: f64 = 6.077_100_506_506_192e-11;
/// Adding 1.5·2⁵² rounds to a whole number and leaves it in the low bits.
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// Sine and cosine of an angle (rad).
#[inline(always)]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    let shifted = angle * TWO_OVER_PI + ROUNDING;
    let quadrant = shifted.to_bits();
    let quarters = shifted - ROUNDING;
    let x = (angle - quarters * HALF_PI_HIGH) - quarters * HALF_PI_LOW;

    let z = x * x;
    let sine = x + x
        * z
        * (-1.666_666_666_666_663_2e-1
            + z * (8.333_333_333_322_49e-3
                + z * (-1.984_126_982_985_795e-4
                    + z * (2.755_731_370_707_006_8e-6
                        + z * (-2.505_076_025_340_686_3e-8 + z * 1.589_690_995_211_55e-10)))));
    // Compensates for the rounding of 1 − z/2.
    let half = 0.5 * z;
    let rough = 1.0 - half;
    let fine = z
        * z
        * (4.166_666_666_666_66e-2
            + z * (-1.388_888_888_887_411e-3
                + z * (2.480_158_728_947_673e-5
                    + z * (-2.755_731_435_139_066_3e-7
                        + z * (2.087_572_321_298_175e-9 + z * -1.135_964_755_778_819_5e-11)))));
    let cosine = rough + (((1.0 - rough) - half) + fine);

    // Odd quarters exchange sine and cosine; the sign bits follow from the quarter's two low bits.
    let swap = 0u64.wrapping_sub(quadrant & 1);
    let (s, c) = (sine.to_bits(), cosine.to_bits());
    let sine_sign = (quadrant & 2) << 62;
    let cosine_sign = ((quadrant.wrapping_add(1)) & 2) << 62;
    (f64::from_bits(((s & !swap) | (c & swap)) ^ sine_sign), f64::from_bits(((c & !swap) | (s & swap)) ^ cosine_sign))
}

/// Sines and cosines of some joints' angles, computed in one loop of vector code.
pub(crate) struct SinCos {
    sines: JointVector,
    cosines: JointVector,
}

impl SinCos {
    #[inline(always)]
    pub(crate) fn of(angles: &JointVector, joints: Range<usize>) -> Self {
        let mut all = Self { sines: JointVector::ZERO, cosines: JointVector::ZERO };
        for index in joints {
            (all.sines.0[index], all.cosines.0[index]) = sin_cos(angles.0[index]);
        }
        all
    }

    #[inline(always)]
    pub(crate) fn at(&self, joint: Joint) -> (f64, f64) {
        (self.sines[joint], self.cosines[joint])
    }
}

#[cfg(test)]
mod tests {
    use super::sin_cos;

    #[test]
    fn sin_cos_agrees_with_the_standard_library_over_many_revolutions() {
        for step in -200_000..=200_000 {
            let angle = f64::from(step) * 1.234_567e-3;
            let (sine, cosine) = sin_cos(angle);
            assert!((sine - angle.sin()).abs() <= 2.5e-16, "sin {angle}: {sine} against {}", angle.sin());
            assert!((cosine - angle.cos()).abs() <= 2.5e-16, "cos {angle}: {cosine} against {}", angle.cos());
        }
    }

    #[test]
    fn sin_cos_of_nan_or_infinity_is_nan() {
        assert!(sin_cos(f64::NAN).0.is_nan());
        assert!(sin_cos(f64::INFINITY).1.is_nan());
    }
}
