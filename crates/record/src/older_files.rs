//! Configuration files of earlier versions, read as those of this one.
//!
//! Until 0.1.0 the servos of the drives were tables of `plant.toml`, and their stiffness was a key of
//! `controller.toml`, too. Now they are the mechanism's.

use crate::Provenance;

/// The tables that are the mechanism's now.
const TABLES: [&str; 2] = ["servo.legs_and_waist", "servo.arms"];
/// The controller's key for the stiffness of the first of them.
const STIFFNESS: &str = "ankle_stiffness_n_m_per_rad";

/// Moves the servos of a run of an earlier version into its mechanism. Nothing happens to files of this version, nor
/// without the files that tell them.
pub(crate) fn move_servos(provenance: &mut Provenance) {
    let is_told = |text: &str| text.lines().any(|line| TABLES.iter().any(|table| is_header(line, table)));
    if provenance.file("mechanism.toml").is_none_or(is_told) {
        return;
    }
    let stiffness = provenance.file("controller.toml").and_then(|text| {
        let line = text.lines().find(|line| line.starts_with(STIFFNESS))?;
        line.split_once('=')?.1.split('#').next()?.trim().parse::<f64>().ok()
    });
    let of_plant = provenance.file("plant.toml").map(|text| cut(text, |table| TABLES.contains(&table)).1);
    let servos = of_plant.filter(|tables| !tables.is_empty()).or_else(|| {
        // The controller's part of a run does not tell the plant's damping, nor does anything need it.
        let tables = TABLES.map(|table| format!("[{table}]\nstiffness_n_m_per_rad = {}\n", stiffness.unwrap_or(0.0)));
        stiffness.map(|_| tables.map(|table| table + "damping_n_m_s_per_rad = 0\n").concat())
    });
    let Some(servos) = servos else { return };
    for (name, text) in &mut provenance.files {
        match name.as_str() {
            "mechanism.toml" => *text += &format!("\n{servos}"),
            "plant.toml" => *text = cut(text, |table| TABLES.contains(&table)).0,
            "controller.toml" => {
                let kept = text.lines().filter(|line| !line.starts_with(STIFFNESS));
                *text = kept.map(|line| format!("{line}\n")).collect();
            }
            _ => {}
        }
    }
}

fn is_header(line: &str, table: &str) -> bool {
    line.strip_prefix('[').and_then(|rest| rest.split_once(']')).is_some_and(|(name, _)| name == table)
}

/// A file without the tables that are taken, and these.
fn cut(text: &str, is_taken: impl Fn(&str) -> bool) -> (String, String) {
    let (mut kept, mut taken) = (String::new(), String::new());
    let mut in_taken = false;
    for line in text.lines() {
        if let Some((name, _)) = line.strip_prefix('[').and_then(|rest| rest.split_once(']')) {
            in_taken = is_taken(name);
        }
        let part = if in_taken { &mut taken } else { &mut kept };
        *part += &format!("{line}\n");
    }
    (kept, taken)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLANT: &str = "mass_error = 0\n\n[servo.legs_and_waist]\nstiffness_n_m_per_rad = 5000\n\
                         damping_n_m_s_per_rad = 150\n[servo.arms]\nstiffness_n_m_per_rad = 500\n\n[sensors]\n";
    const CONTROLLER: &str = "[feedback]\ngain = 3\nankle_stiffness_n_m_per_rad = 4000 # N m/rad\n";

    fn moved(files: &[(&str, &str)]) -> Provenance {
        let files = files.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect();
        let mut provenance = Provenance { metadata: Vec::new(), files };
        move_servos(&mut provenance);
        provenance
    }

    #[test]
    fn servos_of_the_plant_become_the_mechanisms() {
        let files =
            moved(&[("mechanism.toml", "name = \"x\"\n"), ("plant.toml", PLANT), ("controller.toml", CONTROLLER)]);
        let mechanism = files.file("mechanism.toml").unwrap();
        assert!(mechanism.starts_with("name = \"x\"\n\n[servo.legs_and_waist]\nstiffness_n_m_per_rad = 5000\n"));
        assert!(mechanism.contains("[servo.arms]\nstiffness_n_m_per_rad = 500\n") && !mechanism.contains("sensors"));
        assert_eq!(files.file("plant.toml"), Some("mass_error = 0\n\n[sensors]\n"));
        assert_eq!(files.file("controller.toml"), Some("[feedback]\ngain = 3\n"));
    }

    #[test]
    fn the_controllers_part_tells_the_stiffness() {
        let files = moved(&[("mechanism.toml", "name = \"x\"\n"), ("controller.toml", CONTROLLER)]);
        let mechanism = files.file("mechanism.toml").unwrap();
        assert_eq!(mechanism.matches("stiffness_n_m_per_rad = 4000\n").count(), 2, "{mechanism}");
    }

    #[test]
    fn files_of_this_version_stay() {
        let told = [("mechanism.toml", "[servo.arms]\nstiffness_n_m_per_rad = 1\n"), ("plant.toml", "[servo]\n")];
        let files = moved(&told);
        assert!(told.iter().all(|(name, text)| files.file(name) == Some(*text)));
        assert_eq!(moved(&[("mechanism.toml", "")]).file("mechanism.toml"), Some(""), "nothing is made up");
    }
}
