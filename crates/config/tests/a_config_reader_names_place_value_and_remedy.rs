//! Goal: the reader that all configuration files share reports each kind of mistake once, where it is.
//! Method: one small file with every kind of mistake; the report is compared letter by letter.

use std::time::Duration;

use config::{Config, ConfigErrors, Table};

#[derive(Debug, PartialEq)]
struct Servo {
    name: String,
    stiffness: f64,
    angle_max: f64,
    period: Duration,
    samples: u64,
    enabled: bool,
    mode: Option<u8>,
    order: Option<[char; 3]>,
    pushes: Vec<f64>,
}

impl Config for Servo {
    fn read(root: &Table) -> Self {
        let servo = root.table("servo");
        Servo {
            name: root.text("name").to_string(),
            stiffness: servo.number("stiffness_n_m_per_rad").between(1.0, 1e5),
            angle_max: servo.angle("angle_max_deg").between(0.0, 90.0),
            period: servo.duration("period_ms", 0.1, 100.0),
            samples: servo.integer("samples", 1, 64),
            enabled: servo.flag("enabled"),
            mode: servo.choice("mode", [("stiff", 1), ("soft", 2)]),
            order: servo.order("order", [("angle", 'q'), ("rate", 'v'), ("torque", 't')]),
            pushes: root.tables("push").iter().map(|push| push.number("force_n").between(-1e3, 1e3)).collect(),
        }
    }
}

fn servo(text: &str) -> Result<Servo, ConfigErrors> {
    Servo::from_toml(text, "servo.toml")
}

#[test]
fn a_valid_file_is_read_into_si_units() {
    let text = r#"
name = "test"
[servo]
stiffness_n_m_per_rad = 5_000
angle_max_deg = 90
period_ms = 2.5
samples = 0x10
enabled = true
mode = "soft"
order = ["torque", "angle", "rate"]
[[push]]
force_n = 10
[[push]]
force_n = -20.5
"#;
    let expected = Servo {
        name: "test".to_string(),
        stiffness: 5000.0,
        angle_max: std::f64::consts::FRAC_PI_2,
        period: Duration::from_micros(2500),
        samples: 16,
        enabled: true,
        mode: Some(2),
        order: Some(['t', 'q', 'v']),
        pushes: vec![10.0, -20.5],
    };
    assert_eq!(servo(text).unwrap(), expected);
}

#[test]
fn every_kind_of_mistake_is_reported_with_its_place_value_and_remedy() {
    let text = r#"name = 3
[servo]
stiffness = 5000
angle_max_deg = 100
period_ms = 0
samples = 65
enabled = "yes"
mode = "hard"
order = ["torque", "torque"]
speed = 1
[[push]]
force_n = nan
[[push]]
force_kg = 2
when = 3
[server]
port = 80
"#;
    let expected = concat!(
        r#"servo.toml:1:8: name = 3: must be a text in quotes
servo.toml:3:1: servo.stiffness = 5000: unknown key; write `stiffness_n_m_per_rad`
servo.toml:4:17: servo.angle_max_deg = 100: must lie between 0 and 90
servo.toml:5:13: servo.period_ms = 0: must lie between 0.1 and 100
servo.toml:6:11: servo.samples = 65: must be a whole number between 1 and 64
servo.toml:7:11: servo.enabled = "yes": must be true or false
servo.toml:8:8: servo.mode = "hard": must be one of "stiff", "soft"
servo.toml:9:9: servo.order = ["torque", "torque"]: must be an array that names each of "angle", "rate", "torque" once
servo.toml:10:1: servo.speed = 1: unknown key; expected one of stiffness_n_m_per_rad, angle_max_deg, period_ms, "#,
        r#"samples, enabled, mode, order
servo.toml:12:11: push[0].force_n = nan: must be a finite number
servo.toml:14:1: push[1].force_kg = 2: unknown key; write `force_n`
servo.toml:15:1: push[1].when = 3: unknown key; expected one of force_n
servo.toml:16:2: server: unknown key; expected one of servo, name, push"#
    );
    assert_eq!(servo(text).unwrap_err().to_string(), expected);
}

#[test]
fn a_missing_table_is_reported_once_and_not_once_per_key() {
    let errors = servo("name = \"test\"").unwrap_err().to_string();
    assert_eq!(errors, "servo.toml:1:1: servo: is missing: it must be a table");
    let errors = servo("name = \"test\"\nservo = 4\npush = 5").unwrap_err().to_string();
    let expected = "servo.toml:2:9: servo = 4: must be a table\n\
                    servo.toml:3:8: push = 5: must be tables, each with the header [[push]]";
    assert_eq!(errors, expected);
}
