//! Makes the robot its own mirror image: each side becomes the mean of itself and the other side's image.

use model::{Joint, partner};
use nalgebra::{Matrix3, Unit, Vector3};

use crate::import::file_errors::FileErrors;
use crate::import::joint_map::Idealise;
use crate::import::straight_biped::{LumpedBody, StraightBiped, carried, up};

/// Rounding of a URDF's decimals (m, and share).
const ROUNDING: f64 = 1e-9;

/// Puts the sagittal plane at y = 0 and makes both sides alike, as far as that is allowed.
pub(super) fn symmetrise(
    biped: &mut StraightBiped,
    idealise: &Idealise,
    errors: &mut FileErrors,
    changes: &mut Vec<String>,
) {
    let plane = 0.5 * (biped.hinges[Joint::RightHipYaw].place.y + biped.hinges[Joint::LeftHipYaw].place.y);
    for joint in Joint::ALL {
        biped.hinges[joint].place.y -= plane;
        biped.bodies[joint].com.y -= plane;
    }
    // Moving a pitch joint of the waist along its axis changes nothing.
    for joint in [Joint::WaistPitch, Joint::WaistRoll] {
        if biped.hinges[joint].axis == Vector3::y_axis() {
            biped.hinges[joint].place.y = 0.0;
        }
    }

    let original = biped.clone();
    let mut greatest = Greatest::default();
    for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
        let (own, other) = (&original.hinges[joint], &original.hinges[partner(joint)]);
        let hinge = &mut biped.hinges[joint];
        hinge.place = (own.place + across(other.place)) / 2.0;
        greatest.length((own.place - hinge.place).norm(), || joint.name().to_string());

        // The mirror image of a rotation has the opposite sign. An axis has no direction of its own: as everywhere in
        // this module, its greatest component is positive.
        let image = -across(other.axis.into_inner());
        let image = if image.dot(&own.axis) < 0.0 { -image } else { image };
        hinge.axis = Unit::new_normalize(own.axis.into_inner() + image);
        greatest.share(own.axis.cross(&image).norm(), || format!("the axis of {}", joint.name()));

        // Mirroring reverses rotations about x and z; the legs' chains, one down and one up, reverse all once more.
        let same_sense = (hinge.axis.y.abs() > 0.5) != joint.is_in_leg();
        let range = if same_sense { other.range } else { [-other.range[1], -other.range[0]] };
        hinge.range = [own.range[0].max(range[0]), own.range[1].min(range[1])];
        let less = (own.range[0] - hinge.range[0]).abs().max((own.range[1] - hinge.range[1]).abs());
        if less > ROUNDING {
            changes.push(format!("{}: range {:.2}° less, as the other side's", joint.name(), less.to_degrees()));
        }
        hinge.rate_max = own.rate_max.min(other.rate_max);
    }
    for joint in Joint::ALL {
        let (own, other) = (&original.bodies[joint], &original.bodies[carried_by_partner(joint)]);
        let flip = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0));
        let image = LumpedBody { mass: other.mass, com: across(other.com), inertia: flip * other.inertia * flip };
        let body = &mut biped.bodies[joint];
        body.mass = (own.mass + image.mass) / 2.0;
        body.com = (own.com + image.com) / 2.0;
        body.inertia = (own.inertia + image.inertia) / 2.0;
        if body.mass > 0.0 {
            greatest.length((own.com - body.com).norm(), || format!("the centre of mass of {}", carried(joint)));
            greatest.share((own.mass - body.mass).abs() / body.mass, || format!("the mass of {}", carried(joint)));
            let moment = body.inertia.diagonal().max();
            let off = (own.inertia - body.inertia).diagonal().amax();
            greatest
                .share(if moment > 0.0 { off / moment } else { 0.0 }, || format!("the moments of {}", carried(joint)));
        }
    }
    greatest.judge(idealise, errors, changes);
}

/// The greatest differences from the mean of both sides.
#[derive(Default)]
struct Greatest {
    length: (f64, String),
    share: (f64, String),
}

impl Greatest {
    fn length(&mut self, value: f64, of: impl Fn() -> String) {
        if value > self.length.0 {
            self.length = (value, of());
        }
    }

    fn share(&mut self, value: f64, of: impl Fn() -> String) {
        if value > self.share.0 {
            self.share = (value, of());
        }
    }

    fn judge(&self, idealise: &Idealise, errors: &mut FileErrors, changes: &mut Vec<String>) {
        let ((length, long), (share, large)) = (&self.length, &self.share);
        if *length > idealise.asymmetry_max.max(ROUNDING) {
            errors.note(format!(
                "{long} is {:.2} mm off its mean with the other side's mirror image; both sides must be alike: allow \
                 to \
                 take the mean with idealise.asymmetry_max_m = {}",
                length * 1e3,
                up(*length, 1e5)
            ));
        } else if *length > ROUNDING {
            changes.push(format!("made symmetric: nothing moves more than {:.2} mm ({long})", length * 1e3));
        }
        if *share > idealise.asymmetry_share_max.max(ROUNDING) {
            errors.note(format!(
                "{large}: {share:.4} off the mean with the other side; both sides must be alike: allow to take \
                 the mean with idealise.asymmetry_max_share = {}",
                up(*share, 1e4)
            ));
        } else if *share > ROUNDING {
            changes.push(format!(
                "made symmetric: no mass or moment of inertia changed by more than {share:.4} of its value ({large})"
            ));
        }
    }
}

fn across(vector: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(vector.x, -vector.y, vector.z)
}

/// The joint that carries the mirror image of the link that `joint` carries: the tree goes up the right leg and down
/// the left one, so that in the legs it is not the partner of `joint`.
fn carried_by_partner(joint: Joint) -> Joint {
    match joint {
        Joint::FootRoll => joint,
        Joint::FootPitch => Joint::LeftAnkleRoll,
        Joint::LeftAnkleRoll => Joint::FootPitch,
        _ if joint.is_in_leg() => partner(Joint::ALL[joint.index() + 1]),
        _ => partner(joint),
    }
}
