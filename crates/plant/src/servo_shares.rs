//! What the servos of the simulated drives have of the mechanism's: 1 where the controller's idea of them is right.

use config::Table;
use model::Servo;

/// Largest share (-).
const SHARE_MAX: f64 = 100.0;

/// Shares of the mechanism's stiffness and damping that the servos have, all of them alike (-).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoShares {
    /// Share of the stiffness (-).
    pub stiffness: f64,
    /// Share of the damping (-).
    pub damping: f64,
}

impl ServoShares {
    /// Servos as the mechanism tells them.
    pub const ALL: Self = Self { stiffness: 1.0, damping: 1.0 };

    /// Reads `[servo]`, which may be left out, as may each key. Tables of older files are refused: `[servo.arms]` and
    /// `[servo.legs_and_waist]` are the mechanism's.
    pub(crate) fn read(root: &Table) -> Self {
        if !root.has("servo") {
            return Self::ALL;
        }
        let table = root.table("servo");
        for former in ["legs_and_waist", "arms"] {
            let must = format!("must be moved to the robot's mechanism.toml, as [servo.{former}] with the same keys");
            table.refuse_former(former, &must);
        }
        let share = |key| if table.has(key) { table.number(key).between(0.0, SHARE_MAX) } else { 1.0 };
        Self { stiffness: share("stiffness_share"), damping: share("damping_share") }
    }

    /// The servo of a simulated drive.
    ///
    /// * `servo` – that of the mechanism
    pub fn of(&self, servo: &Servo) -> Servo {
        Servo { stiffness: self.stiffness * servo.stiffness, damping: self.damping * servo.damping }
    }
}

#[cfg(test)]
mod tests {
    use config::Document;

    use super::*;

    fn read(text: &str) -> Result<ServoShares, String> {
        let document = Document::parse(text, "plant.toml").map_err(|errors| errors.to_string())?;
        let shares = ServoShares::read(&document.root());
        document.finish(shares).map_err(|errors| errors.to_string())
    }

    #[test]
    fn what_is_left_out_is_as_the_mechanism_tells() {
        assert_eq!(read(""), Ok(ServoShares::ALL));
        let stiff = read("[servo]\nstiffness_share = 1.5").unwrap();
        assert_eq!(stiff, ServoShares { stiffness: 1.5, damping: 1.0 });
        let servo = Servo { stiffness: 200.0, damping: 3.0 };
        assert_eq!(stiff.of(&servo), Servo { stiffness: 300.0, ..servo });
        assert!(read("[servo]\ndamping_share = -1").is_err());
    }

    #[test]
    fn tables_of_older_files_are_sent_to_the_mechanism() {
        let errors = read("[servo.arms]\nstiffness_n_m_per_rad = 500\ndamping_n_m_s_per_rad = 15").unwrap_err();
        let must = "must be moved to the robot's mechanism.toml, as [servo.arms] with the same keys";
        assert!(errors.starts_with("plant.toml:1:1: servo.arms") && errors.contains(must), "{errors}");
    }
}
