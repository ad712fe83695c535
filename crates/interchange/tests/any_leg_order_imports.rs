//! Legs with hip and ankle joints in any order, oblique axes that do not meet, axes of either sign, link frames turned
//! any way, and a root that faces anywhere come in exactly, without names that would tell.

mod support;

use std::fmt::Write;

use config::Config;
use interchange::import::{JointRole, LegRole, NamedText, import};
use model::{Mechanism, Side};
use nalgebra::{UnitQuaternion, Vector3};

use support::robots::{Allowed, is_symmetric, same_robot};

#[test]
fn every_order_of_hip_and_ankle_imports_exactly() {
    use LegRole::*;
    let hips = [
        [HipYaw, HipRoll, HipPitch],
        [HipYaw, HipPitch, HipRoll],
        [HipRoll, HipYaw, HipPitch],
        [HipRoll, HipPitch, HipYaw],
        [HipPitch, HipYaw, HipRoll],
        [HipPitch, HipRoll, HipYaw],
    ];
    let mut chance = Chance(1);
    for hip in hips {
        for ankle in [[AnklePitch, AnkleRoll], [AnkleRoll, AnklePitch]] {
            let order = [hip[0], hip[1], hip[2], Knee, ankle[0], ankle[1]];
            for yaw in [0.0, 0.7, -2.4, std::f64::consts::PI] {
                let robot = biped(order, yaw, &mut chance);
                let map =
                    "name = \"any\"\n[sole]\nbehind_m = 0.05\nahead_m = 0.1\nwidth_m = 0.06\nankle_height_m = 0.04\n";
                let map = NamedText { text: map, file: "map.toml" };
                let imported = import(NamedText { text: &robot.urdf, file: "robot.urdf" }, Some(map));
                let imported = imported.unwrap_or_else(|error| panic!("{order:?}, {yaw}: {error}\n{}", robot.urdf));
                for (role, name) in &imported.roles {
                    let expected = robot.roles.iter().find(|(joint, _)| joint == name).map(|(_, role)| role);
                    assert_eq!(expected, Some(role), "{order:?}, {yaw}");
                }
                same_robot(&robot.urdf, &imported, yaw, Allowed { place: 1e-9, arms: 1e-9, com: 1e-6 });
                is_symmetric(&imported);
                Mechanism::from_toml(&imported.text, "mechanism.toml").unwrap_or_else(|errors| panic!("{errors}"));
                let knee = file_range(&imported.text, "right_knee");
                assert!((knee[0] + 2.2_f64.to_degrees()).abs() < 1e-6 && (knee[1] - 0.1_f64.to_degrees()).abs() < 1e-6);
                let abduction = file_range(&imported.text, "left_hip_roll");
                assert!((abduction[1] - 0.8_f64.to_degrees()).abs() < 1e-6, "{abduction:?}");
            }
        }
    }
}

fn file_range(text: &str, role: &str) -> [f64; 2] {
    let file: toml::Table = text.parse().unwrap();
    let range = file["joint"][role]["range_deg"].as_array().unwrap();
    [support::as_number(&range[0]), support::as_number(&range[1])]
}

struct Biped {
    urdf: String,
    roles: Vec<(String, JointRole)>,
}

/// A biped whose root's x axis is turned so that the robot's is `yaw` to the left of it.
fn biped(order: [LegRole; 6], yaw: f64, chance: &mut Chance) -> Biped {
    let facing = UnitQuaternion::from_euler_angles(0.0, 0.0, yaw);
    let (mut links, mut joints, mut roles) = (String::new(), String::new(), Vec::new());
    write_link(&mut links, "base", 4.0, facing * Vector3::new(0.01, 0.0, 0.1));
    // the right leg in the robot's own frame; its mirror image is the left one
    let mut height = 0.0;
    let leg: Vec<(LegRole, Vector3<f64>, Vector3<f64>, f64)> = order
        .into_iter()
        .enumerate()
        .map(|(place, role)| {
            height -= match place {
                0 => 0.0,
                3 | 4 if role == LegRole::Knee || place == 4 => 0.25,
                _ => 0.02 * chance.next().abs(),
            };
            let aside = if place < 3 { 0.01 * chance.next() } else { 0.0 };
            let at = Vector3::new(aside, -0.09 + aside, height);
            let oblique = if place < 3 { 0.3 } else { 0.0 };
            let mut axis = Vector3::new(oblique * chance.next(), oblique * chance.next(), oblique * chance.next());
            axis[role.axis()] = 1.0;
            (role, at, axis.normalize(), 1.0 + chance.next())
        })
        .collect();
    for side in [Side::Right, Side::Left] {
        let is_left = side == Side::Left;
        let across = |v: Vector3<f64>| if is_left { Vector3::new(v.x, -v.y, v.z) } else { v };
        let (mut parent, mut at, mut turn) = ("base".to_string(), Vector3::zeros(), UnitQuaternion::identity());
        for (place, (role, joint_at, axis, mass)) in leg.iter().enumerate() {
            let letter = if is_left { "q" } else { "p" };
            let (name, link) = (format!("{letter}{place}"), format!("{letter}{}", place + 10));
            // rotations about a mirrored axis are reversed; roll and yaw axes keep their component instead
            let mut image = across(*axis);
            let (mut low, mut high) = range(*role);
            if is_left && role.axis() != 1 {
                image = Vector3::new(axis.x, -axis.y, axis.z);
                (low, high) = (-high, -low);
            } else if is_left {
                image = Vector3::new(-axis.x, axis.y, -axis.z);
            }
            if chance.next() < 0.0 {
                image = -image;
                (low, high) = (-high, -low);
            }
            let own_turn =
                UnitQuaternion::from_euler_angles(chance.next() * 3.0, chance.next() * 1.5, chance.next() * 3.0);
            let own_at = facing * across(*joint_at);
            let origin = turn.inverse() * (own_at - at);
            let (roll, pitch, yaw) = (turn.inverse() * own_turn).euler_angles();
            let axis = own_turn.inverse() * (facing * image);
            let _ = writeln!(
                joints,
                "<joint name=\"{name}\" type=\"revolute\"><parent link=\"{parent}\"/><child link=\"{link}\"/><origin \
                 xyz=\"{} {} {}\" rpy=\"{roll} {pitch} {yaw}\"/><axis xyz=\"{} {} {}\"/><limit lower=\"{low}\" \
                 upper=\"{high}\" velocity=\"10\" effort=\"40\"/></joint>",
                origin.x, origin.y, origin.z, axis.x, axis.y, axis.z
            );
            let com = own_turn.inverse() * (facing * across(Vector3::new(0.01, 0.005, -0.05)));
            write_link(&mut links, &link, *mass, com);
            roles.push((name, JointRole::Leg(side, *role)));
            (parent, at, turn) = (link, own_at, own_turn);
        }
    }
    Biped { urdf: format!("<robot name=\"any\">\n{links}{joints}</robot>\n"), roles }
}

/// How far the lower link turns against the upper one about the positive axis, on the right side (rad).
fn range(role: LegRole) -> (f64, f64) {
    match role {
        LegRole::HipYaw => (-0.9, 0.6),
        LegRole::HipRoll => (-0.8, 0.3),
        LegRole::HipPitch => (-2.0, 0.5),
        LegRole::Knee => (-0.1, 2.2),
        LegRole::AnklePitch => (-0.9, 0.7),
        LegRole::AnkleRoll => (-0.3, 0.4),
    }
}

fn write_link(links: &mut String, name: &str, mass: f64, com: Vector3<f64>) {
    let moment = 0.003 * mass;
    let _ = writeln!(
        links,
        "<link name=\"{name}\"><inertial><origin xyz=\"{} {} {}\"/><mass value=\"{mass}\"/><inertia ixx=\"{moment}\" \
         iyy=\"{moment}\" izz=\"{moment}\"/></inertial></link>",
        com.x, com.y, com.z
    );
}

/// Numbers from -1 to 1.
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        2.0 * (self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 1.0
    }
}
