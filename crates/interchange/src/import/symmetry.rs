//! Makes the robot its own mirror image: the controller always stands on the right foot and mirrors the rest.

use model::Side;
use nalgebra::{Unit, Vector3};

use crate::import::biped::{Biped, Hinge, Segment};
use crate::import::body::LumpedBody;
use crate::import::drive::JointDrive;
use crate::import::file_errors::FileErrors;
use crate::import::range_pair::{self, mirrored};
use crate::import::role::JointRole;
use crate::import::urdf_robot::UrdfRobot;
use crate::side_name::side_name;

/// Rounding of a URDF's decimals (m, rad, and share).
const ROUNDING: f64 = 1e-6;
/// From here on, every difference is printed: lengths (m) and shares of masses.
const LENGTH_TOLD: f64 = 0.01;
const MASS_TOLD: f64 = 0.03;
/// What cannot be one robot any more: how far axes of right and left may differ (rad, m).
pub(super) const ANGLE_MAX: f64 = 0.035;
pub(super) const DISTANCE_MAX: f64 = 0.02;

/// Makes both sides the mean of one and the mirror image of the other, and puts the middle at y = 0.
pub(super) fn symmetrise(biped: &mut Biped, robot: &UrdfRobot, errors: &mut FileErrors, lines: &mut Vec<String>) {
    let mut changes = Changes::default();
    let mut mean_of = |role: JointRole, [own, other]: [Segment; 2]| {
        let hinge = mean_hinge(role, [&own.hinge, &other.hinge], robot, errors, &mut changes, lines);
        let image = Hinge {
            urdf: other.hinge.urdf,
            place: across(hinge.place),
            axis: mirrored_axis(role, hinge.axis),
            sign: other.hinge.sign,
            drive: JointDrive {
                range: mirrored(role, hinge.drive.range),
                motor: other.hinge.drive.motor,
                ..hinge.drive
            },
        };
        let mean = own.body.mean(&other.body.mirrored());
        changes.body(&own.body, &mean, &format!("the body below the {}", role.name_of_both()));
        [Segment { hinge, body: mean }, Segment { hinge: image, body: mean.mirrored() }]
    };
    for (place, role) in biped.roles.into_iter().enumerate() {
        let sides = biped.legs.map(|leg| leg[place]);
        let sides = mean_of(JointRole::Leg(Side::Right, role), sides);
        biped.legs.iter_mut().zip(sides).for_each(|(leg, side)| leg[place] = side);
    }
    let [right, left] = &mut biped.arms;
    for ((right, left), role) in right.iter_mut().zip(left).zip(JointRole::of_arm(Side::Right)) {
        [*right, *left] = mean_of(role, [*right, *left]);
    }
    for (body, name) in [(&mut biped.pelvis, "pelvis"), (&mut biped.middle, "waist"), (&mut biped.trunk, "trunk")] {
        let mean = body.mean(&body.mirrored());
        changes.body(body, &mean, &format!("the {name}"));
        *body = mean;
    }
    biped.mount.y = 0.0;
    if let Some(waist) = &mut biped.waist {
        for (hinge, axis, name) in waist.iter_mut().zip([1, 0]).map(|(hinge, axis)| {
            let name = if axis == 1 { JointRole::WaistPitch.name() } else { JointRole::WaistRoll.name() };
            (hinge, axis, name)
        }) {
            middle_hinge(hinge, axis, &name, &mut changes);
            if axis == 0 {
                hinge.drive.range = range_pair::of_both_sides(hinge.drive.range, &name, errors, lines);
            }
        }
    }
    changes.lines(lines);
}

/// The mean of a joint of the right side and the mirror image of the left one's.
fn mean_hinge(
    role: JointRole,
    [own, other]: [&Hinge; 2],
    robot: &UrdfRobot,
    errors: &mut FileErrors,
    changes: &mut Changes,
    lines: &mut Vec<String>,
) -> Hinge {
    let name = role.name_of_both();
    let image_axis = mirrored_axis(role, other.axis);
    let axis = Unit::new_normalize(own.axis.into_inner() + image_axis.into_inner());
    let image = across(other.place);
    let (angle, off) = (own.axis.angle(&image_axis), across_axis(&axis, own.place - image));
    if angle > ANGLE_MAX || off > DISTANCE_MAX {
        let joints = [own, other].map(|hinge| &robot.joints[hinge.urdf]);
        errors.note_at(
            joints[0].line,
            format!(
                "joints {} and {} as {name} of both sides: their axes must be mirror images of each other; \
                 they differ by {:.2}° and {:.1} mm, and may by 2° and 20 mm",
                joints[0].name,
                joints[1].name,
                angle.to_degrees(),
                off * 1e3
            ),
        );
    }
    let place = (own.place + image) / 2.0;
    changes.length(across_axis(&axis, own.place - place), &format!("the {name} axis"));
    changes.angle(own.axis.angle(&axis), &format!("the {name} axis"));
    let drive = range_pair::mean(role, &own.drive, &other.drive, errors, lines);
    Hinge { place, axis, drive, ..*own }
}

fn middle_hinge(hinge: &mut Hinge, axis: usize, name: &str, changes: &mut Changes) {
    let before = *hinge;
    hinge.place.y = 0.0;
    let mut direction = hinge.axis.into_inner();
    if axis == 1 {
        direction = Vector3::y();
    } else {
        direction.y = 0.0;
    }
    hinge.axis = Unit::new_normalize(direction);
    changes.length(across_axis(&hinge.axis, before.place - hinge.place), &format!("the {name} axis"));
    changes.angle(before.axis.angle(&hinge.axis), &format!("the {name} axis"));
}

/// The mirror image of an axis in the plane y = 0, its role's component positive as before. Rotations about an image
/// have the opposite sign, and an axis has no direction of its own.
fn mirrored_axis(role: JointRole, axis: Unit<Vector3<f64>>) -> Unit<Vector3<f64>> {
    let image = Vector3::new(-axis.x, axis.y, -axis.z);
    Unit::new_unchecked(if role.axis() == 1 { image } else { -image })
}

/// The part of a vector across an axis (m).
fn across_axis(axis: &Unit<Vector3<f64>>, vector: Vector3<f64>) -> f64 {
    axis.cross(&vector).norm()
}

fn across(vector: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(vector.x, -vector.y, vector.z)
}

/// How far the robot was changed.
#[derive(Default)]
struct Changes {
    length: (f64, String),
    angle: (f64, String),
    mass: (f64, String),
    moment: (f64, String),
    large: Vec<String>,
}

impl Changes {
    fn length(&mut self, value: f64, of: &str) {
        if value > self.length.0 {
            self.length = (value, of.to_string());
        }
        if value > LENGTH_TOLD / 2.0 {
            self.large.push(format!("{of} differs by {:.1} mm", 2e3 * value));
        }
    }

    fn angle(&mut self, value: f64, of: &str) {
        if value > self.angle.0 {
            self.angle = (value, of.to_string());
        }
    }

    fn body(&mut self, before: &LumpedBody, after: &LumpedBody, of: &str) {
        if after.mass == 0.0 {
            return;
        }
        self.length((before.com - after.com).norm(), &format!("the centre of mass of {of}"));
        let share = (before.mass - after.mass).abs() / after.mass;
        if share > self.mass.0 {
            self.mass = (share, format!("the mass of {of}"));
        }
        let moment = (before.inertia - after.inertia).amax() / after.inertia.diagonal().amax();
        if moment > self.moment.0 {
            self.moment = (moment, format!("that of {of}"));
        }
        if 2.0 * share > MASS_TOLD {
            self.large.push(format!("the mass of {of} differs by {:.1} %", 200.0 * share));
        }
    }

    fn lines(self, lines: &mut Vec<String>) {
        let (mut parts, none) = (Vec::new(), ROUNDING);
        let Changes { length, angle, mass, moment, large } = self;
        if length.0 > none {
            parts.push(format!("no point moved by more than {:.3} mm ({})", 1e3 * length.0, length.1));
        }
        if angle.0 > none {
            parts.push(format!("no axis turned by more than {:.4}° ({})", angle.0.to_degrees(), angle.1));
        }
        if mass.0 > none {
            parts.push(format!("no mass changed by more than {:.3} % ({})", 100.0 * mass.0, mass.1));
        }
        if moment.0 > none {
            let percent = 100.0 * moment.0;
            parts.push(format!("no inertia changed by more than {percent:.3} % of its greatest moment ({})", moment.1));
        }
        if !parts.is_empty() {
            lines.push(format!("made symmetric: {}", parts.join("; ")));
        }
        let sides = Side::BOTH.map(side_name).join(" and ");
        lines.extend(large.into_iter().map(|what| format!("large difference of {sides}, the mean is taken: {what}")));
    }
}
