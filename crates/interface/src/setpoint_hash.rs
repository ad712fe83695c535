//! One number for all setpoints of a walk: two walks with the same one have commanded the same bits.

use std::fmt;

use crate::Setpoint;

/// A hash of setpoints in their order; displayed as a hexadecimal number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SetpointHash(pub u64);

impl SetpointHash {
    /// Adds the next setpoint: each number by its bits, in the order of angles, rates, feed-forward torques.
    pub fn add(&mut self, setpoint: &Setpoint) {
        for joints in [&setpoint.angles, &setpoint.rates, &setpoint.feed_forward] {
            for number in joints.0 {
                // An odd factor keeps different sums different; the rotation brings high bits down.
                self.0 = (self.0.rotate_left(5) ^ number.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            }
        }
    }
}

impl fmt::Display for SetpointHash {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "{:#018x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use model::Joint;

    use super::*;

    #[test]
    fn every_number_and_the_order_count() {
        let hash = |setpoints: &[Setpoint]| {
            let mut hash = SetpointHash::default();
            setpoints.iter().for_each(|setpoint| hash.add(setpoint));
            hash
        };
        let changed = |change: &dyn Fn(&mut Setpoint)| {
            let mut setpoint = Setpoint::default();
            change(&mut setpoint);
            setpoint
        };
        let rest = Setpoint::default();
        let least = f64::from_bits(1);
        let angle = changed(&|setpoint| setpoint.angles[Joint::ALL[0]] = least);
        let rate = changed(&|setpoint| setpoint.rates[Joint::ALL[7]] = least);
        let torque = changed(&|setpoint| setpoint.feed_forward[Joint::ALL[Joint::COUNT - 1]] = -0.0);
        let hashes =
            [[rest, rest], [angle, rest], [rest, angle], [rate, rest], [torque, rest]].map(|pair| hash(&pair).0);
        for (at, one) in hashes.iter().enumerate() {
            assert!(!hashes[..at].contains(one), "{hashes:x?}");
        }
    }
}
