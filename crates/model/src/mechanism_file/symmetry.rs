//! Checks that the robot is its own mirror image in the sagittal plane: the controller always stands on the right foot
//! and mirrors the rest.
//!
//! In the legs the mirror also reverses the chain. A joint's partner is at the other end of the mirrored link: the
//! right shank is carried by the ankle, the left one by the knee.

use config::Table;
use nalgebra::{Matrix3, Vector3};

use crate::{Joint, Mechanism, Mirror, Motor, PerJoint, Side, partner};

/// Largest difference of lengths, masses and angles between the two sides: the rounding of decimals (m, kg, rad).
const TOLERANCE: f64 = 1e-8;

/// Notes everything that differs between right and left, at the joint with the higher number.
pub(super) fn check(tables: &PerJoint<Table>, mechanism: &Mechanism) {
    for joint in Joint::ALL {
        if partner(joint) <= joint {
            axis(joint, &tables[joint], mechanism);
            origin(joint, &tables[joint], mechanism);
        }
        if linked_partner(joint, mechanism) <= joint {
            body(joint, &tables[joint], mechanism);
        }
    }
    // Without symmetric axes the sign of the mirrored range is unknown.
    if let Some(mirror) = Mirror::new(mechanism) {
        for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered() && partner(*joint) <= *joint) {
            drive(joint, &tables[joint], mechanism, mirror.sign(joint));
        }
    }
}

fn axis(joint: Joint, table: &Table, mechanism: &Mechanism) {
    let other = partner(joint);
    let axis = mechanism.links[joint].axis;
    let image = mechanism.links[other].axis;
    let image = Vector3::new(-image.x, image.y, -image.z);
    if axis.cross(&image).norm() > TOLERANCE {
        let must = if other == joint {
            "must be along or across y".to_string()
        } else {
            format!("must be ±{}, the mirror image of joint.{}.axis", list(image), other.name())
        };
        table.refuse("axis", &must);
    }
}

fn origin(joint: Joint, table: &Table, mechanism: &Mechanism) {
    let links = &mechanism.links;
    let (model, image) = if joint.is_in_leg() {
        // The link that joins this joint to its parent is the mirror image of the one that joins the partner to the
        // joint after it.
        let model = next(partner(joint), mechanism);
        (model, mirrored_step(model, mechanism))
    } else if joint.is_powered() {
        let plane = 2.0 * plane_of_parent(joint, mechanism);
        (partner(joint), across(links[partner(joint)].origin) + Vector3::new(0.0, plane, 0.0))
    } else {
        return;
    };
    if (links[joint].origin - image).norm() > TOLERANCE {
        let must = format!("must be {}, the mirror image of joint.{}.origin_m", list(image), model.name());
        table.refuse("origin_m", &must);
    }
    let parents = [joint, partner(joint)].map(|joint| links[joint].parent.filter(|parent| *parent < joint));
    if let [Some(own), Some(other)] = parents
        && !joint.is_in_leg()
        && own != linked_partner(other, mechanism)
    {
        let must = format!("must be \"{}\", as the mirror has it", linked_partner(other, mechanism).name());
        table.refuse("parent", &must);
    }
}

fn body(joint: Joint, table: &Table, mechanism: &Mechanism) {
    let other = linked_partner(joint, mechanism);
    let (own, model) = (mechanism.links[joint].body, mechanism.links[other].body);
    let named = format!("as joint.{}", other.name());
    if (own.mass - model.mass).abs() > TOLERANCE {
        table.refuse("mass_kg", &format!("must be {} {named}", model.mass));
    }
    if own.mass == 0.0 || model.mass == 0.0 {
        return;
    }
    let flip = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0));
    let image = flip * model.inertia_matrix() * flip;
    if (own.inertia_matrix() - image).norm() > TOLERANCE {
        let mut must = format!("must be {} {named}", list(image.diagonal()));
        if model.principal_axes.is_some() {
            let products = list(Vector3::new(image.m12, image.m13, image.m23));
            must = format!(
                "must be {} with the products {products}, the mirror image of {}",
                list(image.diagonal()),
                &named[3..]
            );
        }
        table.refuse("inertia_kg_m2", &must);
    }
    let image = across(model.com) + image_of_frame(other, mechanism);
    if (own.com - image).norm() > TOLERANCE {
        table.refuse("com_m", &format!("must be {}, the mirror image of joint.{}.com_m", list(image), other.name()));
    }
}

fn drive(joint: Joint, table: &Table, mechanism: &Mechanism, sign: f64) {
    let other = partner(joint);
    let (own, model) = (&mechanism.links[joint], &mechanism.links[other]);
    if let (Some(own), Some(model)) = (own.limits, model.limits) {
        let ends = [sign * model.angle_min, sign * model.angle_max];
        let image = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        if (own.angle_min - image[0]).abs() > TOLERANCE || (own.angle_max - image[1]).abs() > TOLERANCE {
            let image = image.map(f64::to_degrees);
            let must = format!(
                "must be [{}, {}], the mirror image of joint.{}.range_deg",
                decimal(image[0]),
                decimal(image[1]),
                other.name()
            );
            table.refuse("range_deg", &must);
        }
        if (own.rate_max - model.rate_max).abs() > TOLERANCE {
            let rate = decimal(model.rate_max.to_degrees());
            table.refuse("rate_max_deg_per_s", &format!("must be {rate} as joint.{}", other.name()));
        }
    }
    let numbers = [own.motor, model.motor].map(|motor| motor.map(|motor| numbers(&motor)));
    if let [Some(own), Some(model)] = numbers
        && own.into_iter().zip(model).any(|(own, model)| (own - model).abs() > 0.0)
    {
        let key = if table.has("effort_n_m") { "effort_n_m" } else { "motor" };
        table.refuse(key, &format!("must be the motor of joint.{}", other.name()));
    }
}

/// The numbers of a motor. Refused values are `NaN`, which never counts as a difference.
fn numbers(motor: &Motor) -> [f64; 5] {
    match motor {
        Motor::Dc(motor) => {
            [motor.resistance, motor.torque_constant, motor.gear_ratio, motor.rotor_inertia, motor.voltage_max]
        }
        Motor::Torque(source) => [source.effort, source.armature, 0.0, 0.0, 0.0],
    }
}

/// The joint after another one on the way from the right foot over the pelvis to the left foot.
fn next(joint: Joint, mechanism: &Mechanism) -> Joint {
    let order = mechanism.order.all();
    order[(mechanism.order.place(joint) + 1).min(Joint::COUNT - 1)]
}

/// The mirror image of the way from a joint of the legs to the one before it (m).
fn mirrored_step(joint: Joint, mechanism: &Mechanism) -> Vector3<f64> {
    -across(mechanism.links[joint].origin)
}

/// The joint whose link is the mirror image of the link that `joint` carries: the left foot for the right foot, the
/// pelvis for itself.
fn linked_partner(joint: Joint, mechanism: &Mechanism) -> Joint {
    let [right_foot, left_foot] = Side::BOTH.map(|side| mechanism.foot(side));
    match joint {
        _ if joint == left_foot => right_foot,
        _ if joint == right_foot => left_foot,
        _ if joint.is_in_leg() => partner(next(joint, mechanism)),
        _ => partner(joint),
    }
}

/// Position of the mirrored frame of the link on `joint` in the frame of the link that is its mirror image (m).
///
/// In the legs the frames are at opposite ends of the link: the left link is mounted where the right one carries the
/// next joint.
fn image_of_frame(joint: Joint, mechanism: &Mechanism) -> Vector3<f64> {
    match joint {
        Joint::FootPitch => mechanism.sole_in_foot(Side::Left),
        _ if joint.is_in_leg() => mirrored_step(next(joint, mechanism), mechanism),
        _ => Vector3::zeros(),
    }
}

/// The y coordinate of the plane of symmetry in the parent frame of `joint`, a joint of trunk or arms (m).
fn plane_of_parent(joint: Joint, mechanism: &Mechanism) -> f64 {
    // The pelvis' frame is at the right hip; those of trunk and arms are in the middle or mirrored.
    if mechanism.links[joint].parent == Some(mechanism.pelvis()) {
        mechanism.links[mechanism.leg(Side::Left)[0]].origin.y / 2.0
    } else {
        0.0
    }
}

fn across(vector: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(vector.x, -vector.y, vector.z)
}

fn list(vector: Vector3<f64>) -> String {
    format!("[{}, {}, {}]", decimal(vector.x), decimal(vector.y), decimal(vector.z))
}

/// A number as a person would write it, without the noise of the last binary digits and without `-0`.
fn decimal(value: f64) -> f64 {
    (value * 1e9).round() / 1e9 + 0.0
}
