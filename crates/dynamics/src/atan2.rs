//! The angle of a direction, the same bits on every machine and without a branch, as [`sin_cos`](crate::sin_cos()).
//!
//! The ratio of the shorter to the longer component is reduced to ±7/16 by the nearest of atan 0, atan ½ and atan 1,
//! and goes into the minimax polynomial of FreeBSD's msun (`s_atan.c`). The reduction works on the components
//! themselves, so that one division serves both; with constants beyond 53 bits the result is within 1.5 units in the
//! last place.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// The parts of the constants beyond 53 bits.
const FRAC_PI_4_REST: f64 = 3.061_616_997_868_383e-17;
const FRAC_PI_2_REST: f64 = 6.123_233_995_736_766e-17;
const PI_REST: f64 = 1.224_646_799_147_353_2e-16;
const ATAN_HALF: f64 = 0.463_647_609_000_806_1;
const ATAN_HALF_REST: f64 = 2.269_877_745_296_168_7e-17;

/// Angle of the direction (x, y) from the x axis towards the y axis (rad), −π to π; 0 for the zero vector.
///
/// Components up to 1e307; NaN if one is NaN or both are infinite.
#[inline(always)]
pub fn atan2(y: f64, x: f64) -> f64 {
    let (across, along) = (y.abs(), x.abs());
    let steep = across > along;
    let (short, long) = if steep { (along, across) } else { (across, along) };

    // atan(short/long) = atan(nearest) + atan(ratio); the difference of the components is exact.
    let flat = short <= 0.4375 * long;
    let middling = short < 0.6875 * long;
    let nearest = choose(flat, 0.0, choose(middling, 0.5, 1.0));
    let angle = choose(flat, 0.0, choose(middling, ATAN_HALF, FRAC_PI_4));
    let angle_rest = choose(flat, 0.0, choose(middling, ATAN_HALF_REST, FRAC_PI_4_REST));
    let divisor = choose(long == 0.0, 1.0, long + nearest * short);
    let ratio = (short - nearest * long) / divisor;

    let z = ratio * ratio;
    let w = z * z;
    let odd = z
        * (3.333_333_333_333_293e-1
            + w * (1.428_571_427_250_346_6e-1
                + w * (9.090_887_133_436_507e-2
                    + w * (6.661_073_137_387_531e-2
                        + w * (4.976_877_994_615_932_4e-2 + w * 1.628_582_011_536_578_2e-2)))));
    let even = w
        * (-1.999_999_999_987_648_3e-1
            + w * (-1.111_111_040_546_235_6e-1
                + w * (-7.691_876_205_044_83e-2
                    + w * (-5.833_570_133_790_573_5e-2 + w * -3.653_157_274_421_691_6e-2))));
    let small = ratio - (ratio * (odd + even) - angle_rest);

    // In a steep direction the angle counts from the y axis, in a backward one against the x axis.
    let backward = x < 0.0;
    let start = choose(steep, FRAC_PI_2, choose(backward, PI, 0.0));
    let start_rest = choose(steep, FRAC_PI_2_REST, choose(backward, PI_REST, 0.0));
    let sense = choose(steep ^ backward, -1.0, 1.0);
    let (large, rest) = (start + sense * angle, start_rest + sense * small);
    (large + rest).copysign(y)
}

/// Both values are at hand: a selection, no jump.
#[inline(always)]
fn choose(condition: bool, yes: f64, no: f64) -> f64 {
    if condition { yes } else { no }
}

#[cfg(test)]
mod tests {
    use super::atan2;

    /// The standard library's own error is hardly more than half a unit in the last place.
    fn check(y: f64, x: f64) {
        let (ours, theirs) = (atan2(y, x), y.atan2(x));
        let unit = theirs.abs().next_up() - theirs.abs();
        assert!((ours - theirs).abs() <= unit, "atan2({y:e}, {x:e}): {ours:e} against {theirs:e}");
        assert_eq!(ours.is_sign_negative(), theirs.is_sign_negative(), "atan2({y:e}, {x:e})");
    }

    #[test]
    fn atan2_agrees_with_the_standard_library_in_every_direction() {
        for step in -300_000..=300_000 {
            let angle = f64::from(step) * 1.047_197e-5;
            let length = 2.0_f64.powi(step % 60);
            check(length * angle.sin(), length * angle.cos());
        }
    }

    #[test]
    fn atan2_agrees_for_components_of_very_different_size() {
        for exponent in -300..=300 {
            for (y, x) in [(1.7, 1.0), (-1.7, 1.0), (1.7, -1.0), (-1.7, -1.0)] {
                check(y * 10.0_f64.powi(exponent), x);
                check(y, x * 10.0_f64.powi(exponent));
            }
        }
    }

    #[test]
    fn atan2_agrees_where_its_pieces_meet() {
        for edge in [0.4375, 0.5, 0.6875, 1.0] {
            for near in [-4e-16, -1e-16, 0.0, 1e-16, 4e-16] {
                for (y, x) in [(1.0, edge + near), (edge + near, 1.0), (-1.0, -edge - near), (-edge - near, -1.0)] {
                    check(y, x);
                }
            }
        }
    }

    #[test]
    fn atan2_is_exact_on_the_axes_and_zero_for_the_zero_vector() {
        use std::f64::consts::{FRAC_PI_2, PI};
        assert_eq!([atan2(0.0, 2.0), atan2(3.0, 0.0), atan2(0.0, -1.0)], [0.0, FRAC_PI_2, PI]);
        assert_eq!([atan2(-3.0, 0.0), atan2(-0.0, -1.0)], [-FRAC_PI_2, -PI]);
        for zero in [0.0, -0.0] {
            assert_eq!([atan2(zero, 0.0), atan2(zero, -0.0)], [0.0, 0.0]);
        }
    }

    #[test]
    fn atan2_of_nan_is_nan() {
        assert!(atan2(f64::NAN, 1.0).is_nan());
        assert!(atan2(1.0, f64::NAN).is_nan());
    }
}
