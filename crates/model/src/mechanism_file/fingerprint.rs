//! The fingerprints: one number for everything physical about a mechanism, and one for all of it but the servos and the
//! held joints, of which no planned motion knows.
//!
//! FNV-1a, 64 bits (Fowler, Noll, Vo; draft-eastlake-fnv), over the little-endian bytes of every number [`Mechanism`]
//! holds, in the order of its fields and joints, in SI units. Names, comments and the order of the file's keys do not
//! count; `-0` counts as `0`.

use crate::{Joint, Mechanism, Motor};

/// The fingerprint of a mechanism, and that of its body, without servos and held joints.
pub(super) fn of(mechanism: &Mechanism) -> (u64, u64) {
    let mut hash = Hash::default();
    add_body(&mut hash, mechanism);
    let body = hash.0;
    add_held(&mut hash, mechanism);
    for servo in [mechanism.servos.legs_and_waist, mechanism.servos.arms] {
        hash.add(servo.stiffness);
        hash.add(servo.damping);
    }
    (hash.0, body)
}

/// The state of the hash.
struct Hash(u64);

impl Default for Hash {
    fn default() -> Self {
        const OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
        Self(OFFSET_BASIS)
    }
}

impl Hash {
    fn add(&mut self, value: f64) {
        const PRIME: u64 = 0x0000_0100_0000_01b3;
        for byte in (value + 0.0).to_bits().to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(PRIME);
        }
    }
}

fn add_body(hash: &mut Hash, mechanism: &Mechanism) {
    let mut add = |value: f64| hash.add(value);
    let sole = mechanism.sole;
    // A sole that is as wide on both sides has one number, as it has one key.
    let aside = if sole.inside == sole.outside { &[sole.inside][..] } else { &[sole.inside, sole.outside] };
    [sole.behind, sole.ahead].iter().chain(aside).chain(&[sole.ankle_height]).copied().for_each(&mut add);
    for (_, link) in mechanism.links.iter() {
        add(f64::from(link.parent.map_or(0, Joint::number)));
        link.axis.iter().chain(link.origin.iter()).copied().for_each(&mut add);
        add(link.body.mass);
        link.body.com.iter().chain(link.body.inertia.iter()).copied().for_each(&mut add);
        // Present and absent limits must not yield the same number.
        add(f64::from(u8::from(link.limits.is_some())));
        if let Some(limits) = link.limits {
            [limits.angle_min, limits.angle_max, limits.rate_max].into_iter().for_each(&mut add);
        }
        add(f64::from(u8::from(link.motor.is_some())));
        if let Some(axes) = link.body.principal_axes {
            axes.matrix().iter().copied().for_each(&mut add);
        }
        if let Some(Motor::Torque(source)) = link.motor {
            [source.effort, source.armature].into_iter().for_each(&mut add);
        }
        if let Some(Motor::Dc(motor)) = link.motor {
            let electric = [motor.resistance, motor.torque_constant, motor.voltage_max];
            electric.into_iter().chain([motor.gear_ratio, motor.rotor_inertia]).for_each(&mut add);
        }
    }
}

/// The held joints that have a link by themselves.
fn add_held(hash: &mut Hash, mechanism: &Mechanism) {
    let held = mechanism.source.iter().flat_map(|source| &source.held);
    for (place, link) in held.enumerate().filter_map(|(place, held)| Some((place, held.link.as_ref()?))) {
        let mut add = |value: f64| hash.add(value);
        add(place as f64);
        add(link.below.map_or(0.0, |below| 1.0 + below as f64));
        [link.mount, link.lumped_into].iter().chain(&link.carries).for_each(|joint| add(f64::from(joint.number())));
        link.axis.iter().chain(link.origin.iter()).copied().for_each(&mut add);
        add(link.body.mass);
        link.body.com.iter().copied().for_each(&mut add);
        link.body.inertia_matrix().iter().copied().for_each(&mut add);
        [link.drive.effort, link.drive.armature].into_iter().for_each(&mut add);
    }
}
