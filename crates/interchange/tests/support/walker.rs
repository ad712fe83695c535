//! A small biped's URDF, written out so that single words can be replaced by mistakes.

/// Its URDF: 20 links, waist yaw, pitch and roll, one joint in each arm; legs of 0.4 m, 14.4 kg. The feet have boxes.
pub(crate) fn walker() -> String {
    let mut text = "<?xml version=\"1.0\"?>\n<robot name=\"walker\">\n".to_string();
    text += &link("pelvis", 2.0, [0.0, 0.0, 0.05], "");
    text += &link("waist_1", 0.0, [0.0; 3], "");
    text += &link("waist_2", 0.0, [0.0; 3], "");
    text += &link("torso", 6.0, [0.0, 0.0, 0.15], "");
    text += &joint("waist_yaw", "pelvis", "waist_1", [0.0, 0.0, 0.1], "0 0 1", [-1.0, 1.0]);
    text += &joint("waist_pitch", "waist_1", "waist_2", [0.0; 3], "0 1 0", [-0.5, 1.0]);
    text += &joint("waist_roll", "waist_2", "torso", [0.0; 3], "1 0 0", [-0.6, 0.6]);
    for (side, y) in [("right", -1.0), ("left", 1.0)] {
        let name = |part: &str| format!("{side}_{part}");
        let roll = if y < 0.0 { [-0.7, 0.4] } else { [-0.4, 0.7] };
        let sole =
            "<collision><origin xyz=\"0.03 0 -0.03\"/><geometry><box size=\"0.16 0.08 0.02\"/></geometry></collision>";
        text += &link(&name("hip_1"), 0.0, [0.0; 3], "");
        text += &link(&name("hip_2"), 0.1, [0.0; 3], "");
        text += &link(&name("thigh"), 1.5, [0.0, 0.0, -0.1], "");
        text += &link(&name("shank"), 1.0, [0.0, 0.0, -0.1], "");
        text += &link(&name("cross"), 0.0, [0.0; 3], "");
        text += &link(&name("foot"), 0.3, [0.03, 0.0, -0.03], sole);
        text += &link(&name("arm"), 0.8, [0.0, 0.0, -0.15], "");
        text += &joint(&name("hip_roll"), "pelvis", &name("hip_1"), [0.0, 0.08 * y, 0.0], "1 0 0", roll);
        text += &joint(&name("hip_yaw"), &name("hip_1"), &name("hip_2"), [0.0; 3], "0 0 1", [-0.7, 0.7]);
        text += &joint(&name("hip_pitch"), &name("hip_2"), &name("thigh"), [0.0; 3], "0 1 0", [-1.9, 0.6]);
        text += &joint(&name("knee"), &name("thigh"), &name("shank"), [0.0, 0.0, -0.2], "0 1 0", [-0.1, 2.2]);
        text += &joint(&name("ankle_pitch"), &name("shank"), &name("cross"), [0.0, 0.0, -0.2], "0 1 0", [-0.9, 0.8]);
        text += &joint(&name("ankle_roll"), &name("cross"), &name("foot"), [0.0; 3], "1 0 0", [-0.5, 0.5]);
        text += &joint(&name("shoulder"), "torso", &name("arm"), [0.0, 0.15 * y, 0.3], "0 1 0", [-3.0, 1.0]);
    }
    text + "</robot>\n"
}

fn link(name: &str, mass: f64, com: [f64; 3], more: &str) -> String {
    let [x, y, z] = com;
    let moment = mass * 0.004;
    let inertial = format!(
        "\n    <inertial>\n      <origin xyz=\"{x} {y} {z}\"/>\n      <mass value=\"{mass}\"/>\n      <inertia \
         ixx=\"{moment}\" iyy=\"{moment}\" izz=\"{moment}\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/>\n    </inertial>"
    );
    let inertial = if mass > 0.0 { inertial } else { String::new() };
    format!("  <link name=\"{name}\">{inertial}{more}\n  </link>\n")
}

fn joint(name: &str, parent: &str, child: &str, origin: [f64; 3], axis: &str, limit: [f64; 2]) -> String {
    let ([x, y, z], [lower, upper]) = (origin, limit);
    format!(
        "  <joint name=\"{name}\" type=\"revolute\">\n    <origin xyz=\"{x} {y} {z}\"/>\n    <parent \
         link=\"{parent}\"/>\n    <child link=\"{child}\"/>\n    <axis xyz=\"{axis}\"/>\n    <limit lower=\"{lower}\" \
         upper=\"{upper}\" effort=\"30\" velocity=\"9\"/>\n  </joint>\n"
    )
}

/// The same with one place of a joint changed: the first `from` within it.
pub(crate) fn in_joint(urdf: &str, joint: &str, from: &str, to: &str) -> String {
    within(urdf, &format!("<joint name=\"{joint}\""), "</joint>", from, to)
}

/// The same with one place of a link changed.
pub(crate) fn in_link(urdf: &str, link: &str, from: &str, to: &str) -> String {
    within(urdf, &format!("<link name=\"{link}\""), "</link>", from, to)
}

fn within(urdf: &str, start: &str, end: &str, from: &str, to: &str) -> String {
    let begins = urdf.find(start).unwrap_or_else(|| panic!("{start}"));
    let ends = begins + urdf[begins..].find(end).unwrap() + end.len();
    let part = &urdf[begins..ends];
    assert!(part.contains(from), "{from} is not in {part}");
    format!("{}{}{}", &urdf[..begins], part.replacen(from, to, 1), &urdf[ends..])
}
