//! The same robot written otherwise: its URDF's text with frames turned, elements in another order, other names.

/// The root link hangs on another one, which is turned: the robot's x axis is `yaw` to the left of the new root's.
pub(crate) fn turned(urdf: &str, root: &str, yaw: f64) -> String {
    let base = format!(
        "<link name=\"turned root\"/><joint name=\"turned\" type=\"fixed\"><parent link=\"turned root\"/><child \
         link=\"{root}\"/><origin rpy=\"0 0 {yaw}\"/></joint></robot>"
    );
    urdf.replace("</robot>", &base)
}

/// Links and joints in the opposite order, so that the legs come the other way round, too.
pub(crate) fn reversed(urdf: &str) -> String {
    let (head, mut parts) = parts(urdf);
    parts.reverse();
    format!("{head}{}</robot>\n", parts.concat())
}

/// Links and joints in an order that chance picked.
pub(crate) fn shuffled(urdf: &str, mut seed: u64) -> String {
    let (head, mut parts) = parts(urdf);
    for place in (1..parts.len()).rev() {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        parts.swap(place, (seed >> 33) as usize % (place + 1));
    }
    format!("{head}{}</robot>\n", parts.concat())
}

/// Names that say nothing: a0, a1, …
pub(crate) fn nameless(urdf: &str) -> String {
    let mut text = urdf.to_string();
    let mut names: Vec<(&str, &str)> = Vec::new();
    for element in ["<link name=\"", "<joint name=\""] {
        for (at, _) in urdf.match_indices(element) {
            let rest = &urdf[at + element.len()..];
            names.push((element, &rest[..rest.find('"').unwrap()]));
        }
    }
    for (place, (element, name)) in names.iter().enumerate() {
        let kind = if element.starts_with("<link") { "link" } else { "joint" };
        text = text.replace(&format!("<{kind} name=\"{name}\""), &format!("<{kind} name=\"a{place}\""));
        let used = if kind == "link" { " link=" } else { "<mimic joint=" };
        text = text.replace(&format!("{used}\"{name}\""), &format!("{used}\"a{place}\""));
    }
    text
}

/// What stands before the first link, and all links and joints.
fn parts(urdf: &str) -> (String, Vec<String>) {
    let mut head = String::new();
    let mut parts: Vec<String> = Vec::new();
    for line in urdf.replace("</robot>", "").lines() {
        if line.starts_with("  <link") || line.starts_with("  <joint") {
            parts.push(String::new());
        }
        let part = parts.last_mut().unwrap_or(&mut head);
        part.push_str(line);
        part.push('\n');
    }
    (head, parts)
}
