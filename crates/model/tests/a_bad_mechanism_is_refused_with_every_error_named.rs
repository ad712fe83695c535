//! Goal: a bad mechanism file is refused, and one look at the message is enough to repair all of it.
//! Method: break the committed file in known places and compare the whole text of the refusal.

use config::Config;
use model::Mechanism;

/// A mistake: in table `table`, the text `right` becomes `wrong`, which is reported as `report`, from the column on.
struct Mistake {
    table: &'static str,
    right: &'static str,
    wrong: &'static str,
    report: &'static str,
}

const fn mistake(table: &'static str, right: &'static str, wrong: &'static str, report: &'static str) -> Mistake {
    Mistake { table, right, wrong, report }
}

fn committed() -> String {
    std::fs::read_to_string(format!("{}/../../config/mechanism.toml", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// The committed file with the mistakes in it, and what the refusal must be.
fn broken(mistakes: &[Mistake]) -> (String, String) {
    let mut text = committed();
    for mistake in mistakes {
        let header = text.find(&format!("\n[{}]", mistake.table)).expect("table") + 1;
        let at = header + text[header..].find(mistake.right).expect("right text");
        text.replace_range(at..at + mistake.right.len(), mistake.wrong);
    }
    // A mistake is reported in its last line; a key that was taken out, in the line of its table.
    let line = |mistake: &Mistake| {
        let header = text.find(&format!("\n[{}]", mistake.table)).expect("table") + 1;
        let mut at = header;
        if !mistake.wrong.is_empty() {
            at += text[header..].find(mistake.wrong).expect("wrong text") + mistake.wrong.len();
        }
        text[..at].matches('\n').count() + 1
    };
    let mut refusals: Vec<_> = mistakes.iter().map(|mistake| (line(mistake), mistake.report)).collect();
    refusals.sort_by_key(|(line, _)| *line);
    let lines: Vec<_> =
        refusals.iter().map(|(line, report)| format!("config/mechanism.toml:{line}:{report}")).collect();
    let expected = lines.join("\n");
    (text, expected)
}

fn assert_refused(mistakes: &[Mistake]) {
    let (text, expected) = broken(mistakes);
    let errors = Mechanism::from_toml(&text, "config/mechanism.toml").expect_err("a broken file");
    assert_eq!(errors.to_string(), expected);
    assert_eq!(errors.0.len(), mistakes.len());
}

#[test]
fn sixteen_mistakes_in_a_mechanism_file_are_reported_in_sixteen_lines() {
    assert_refused(&[
        mistake("sole", "width_m = 0.08", "width_mm = 80", "1: sole.width_mm = 80: unknown key; write `width_m`"),
        mistake("motor.leg", "0.608", "0.0", "18: motor.leg.resistance_ohm = 0.0: must lie between 0.001 and 10000"),
        mistake(
            "motor.arm",
            "gear_ratio = 60\n",
            "",
            "1: motor.arm.gear_ratio: is missing: it must be a finite number",
        ),
        mistake(
            "joint.right_ankle_pitch",
            "3.16",
            "-3.16",
            "11: joint.right_ankle_pitch.mass_kg = -3.16: must lie between 0.000001 and 1000",
        ),
        mistake(
            "joint.right_knee",
            "axis = [0, 1, 0]",
            "axis = [0, 2, 0]",
            "8: joint.right_knee.axis = [0, 2, 0]: must be a unit vector such as [0, 1, 0]",
        ),
        mistake(
            "joint.right_knee",
            "range_deg = [-120, 5]",
            "range_rad = [-2.1, 0.1]",
            "1: joint.right_knee.range_rad = [-2.1, 0.1]: unknown key; write `range_deg`",
        ),
        mistake(
            "joint.right_hip_pitch",
            "[0, 0, 0.422]",
            "[0, 0, inf]",
            "12: joint.right_hip_pitch.origin_m = [0, 0, inf]: must be an array of 3 finite numbers",
        ),
        mistake(
            "joint.right_hip_yaw",
            "number = 7",
            "number = 8",
            "10: joint.right_hip_yaw.number = 8: must be 7, the number of right_hip_yaw",
        ),
        mistake(
            "joint.right_hip_roll",
            "[0.0657, 0.0525, 0.0592]",
            "[0.0657, 0.0525, 0.1592]",
            "17: joint.right_hip_roll.inertia_kg_m2 = [0.0657, 0.0525, 0.1592]: must be three moments, and maybe the \
             products xy, xz, yz: principal moments between 0.000000000001 and 1000, each at most the sum of the \
             other two",
        ),
        mistake(
            "joint.left_hip_pitch",
            "\"left_hip_yaw\"",
            "\"left_elbow\"",
            "10: joint.left_hip_pitch.parent = \"left_elbow\": must be \"right_hip_pitch\" or \"right_hip_yaw\" or \
             \"right_hip_roll\" or \"left_hip_roll\" or \"left_hip_yaw\": the legs are one chain from foot to foot",
        ),
        mistake(
            "joint.left_hip_pitch",
            "rate_max_deg_per_s = 500",
            "rate_max_deg_per_s = \"fast\"",
            "22: joint.left_hip_pitch.rate_max_deg_per_s = \"fast\": must be a finite number",
        ),
        mistake(
            "joint.left_ankle_pitch",
            "[-50, 45]",
            "[45, -50]",
            "13: joint.left_ankle_pitch.range_deg = [45, -50]: each must lie between -720 and 720, and \
             be greater than the one before",
        ),
        mistake(
            "joint.waist_pitch",
            "\"leg\"",
            "\"hydraulic\"",
            "9: joint.waist_pitch.motor = \"hydraulic\": must be one of \"arm\", \"leg\"",
        ),
        mistake(
            "joint.waist_roll",
            "parent = \"waist_pitch\"",
            "parnet = \"waist_pitch\"",
            "1: joint.waist_roll.parnet = \"waist_pitch\": unknown key; write `parent`",
        ),
        mistake(
            "joint.left_shoulder",
            "\"waist_roll\"",
            "\"left_elbow\"",
            "10: joint.left_shoulder.parent = \"left_elbow\": must name a joint that comes before this one (numbers 1 \
             to 18)",
        ),
        mistake(
            "joint.left_elbow",
            "number = 20",
            "number = 20\ncolour = \"red\"",
            "1: joint.left_elbow.colour = \"red\": unknown key; expected one of number, parent, axis, origin_m, \
             mass_kg, com_m, inertia_kg_m2, range_deg, rate_max_deg_per_s, effort_n_m, motor",
        ),
    ]);
}

#[test]
fn a_robot_that_is_not_its_own_mirror_image_is_refused() {
    assert_refused(&[
        mistake(
            "joint.left_hip_pitch",
            "10.36",
            "10.4",
            "11: joint.left_hip_pitch.mass_kg = 10.4: must be 10.36 as joint.right_knee",
        ),
        mistake(
            "joint.left_knee",
            "[0, 0, -0.422]",
            "[0, 0, -0.42]",
            "12: joint.left_knee.origin_m = [0, 0, -0.42]: must be [0, 0, -0.422], the mirror image of \
             joint.right_hip_pitch.origin_m",
        ),
        mistake(
            "joint.left_knee",
            "[0, 0, -0.190743]",
            "[0, 0.01, -0.190743]",
            "9: joint.left_knee.com_m = [0, 0.01, -0.190743]: must be [0, 0, -0.190743], the mirror image of \
             joint.right_ankle_pitch.com_m",
        ),
        mistake(
            "joint.left_knee",
            "[-5, 120]",
            "[-120, 5]",
            "13: joint.left_knee.range_deg = [-120, 5]: must be [-5, 120], the mirror image of \
             joint.right_knee.range_deg",
        ),
        mistake(
            "joint.left_ankle_roll",
            "0.0040",
            "0.0041",
            "17: joint.left_ankle_roll.inertia_kg_m2 = [0.00103, 0.0041, 0.0044]: must be [0.00103, 0.004, 0.0044] as \
             joint.foot_pitch",
        ),
        mistake(
            "joint.waist_roll",
            "[-40, 40]",
            "[-40, 30]",
            "13: joint.waist_roll.range_deg = [-40, 30]: must be [-30, 40], the mirror image of \
             joint.waist_roll.range_deg",
        ),
        mistake(
            "joint.left_shoulder",
            "[0, 0.18, 0.36]",
            "[0, 0.19, 0.36]",
            "12: joint.left_shoulder.origin_m = [0, 0.19, 0.36]: must be [0, 0.18, 0.36], the mirror image of \
             joint.right_shoulder.origin_m",
        ),
        mistake(
            "joint.left_elbow",
            "rate_max_deg_per_s = 600",
            "rate_max_deg_per_s = 599",
            "22: joint.left_elbow.rate_max_deg_per_s = 599: must be 600 as joint.right_elbow",
        ),
    ]);
}

#[test]
fn an_axis_that_cannot_be_symmetric_is_refused() {
    assert_refused(&[mistake(
        "joint.left_ankle_roll",
        "[1, 0, 0]",
        "[0, 1, 0]",
        "8: joint.left_ankle_roll.axis = [0, 1, 0]: must be ±[-1, 0, 0], the mirror image of \
         joint.right_ankle_roll.axis",
    )]);
}

#[test]
fn joints_faster_than_their_motors_and_a_misplaced_ankle_are_refused() {
    assert_refused(&[
        mistake(
            "joint.foot_pitch",
            "origin_m = [0, 0, 0]",
            "origin_m = [0, 0, 0.01]",
            "12: joint.foot_pitch.origin_m = [0, 0, 0.01]: must be [0, 0, 0]: the foot tips about O, under the ankle",
        ),
        mistake(
            "joint.right_ankle_roll",
            "[0, 0, 0.07]",
            "[0, 0, 0.08]",
            "12: joint.right_ankle_roll.origin_m = [0, 0, 0.08]: must be [0, 0, 0.07]: sole.ankle_height_m above the \
             sole",
        ),
        mistake(
            "joint.right_knee",
            "rate_max_deg_per_s = 500",
            "rate_max_deg_per_s = 590",
            "22: joint.right_knee.rate_max_deg_per_s = 590: must be at most 588.9, the motor's speed without load",
        ),
        mistake(
            "joint.left_knee",
            "rate_max_deg_per_s = 500",
            "rate_max_deg_per_s = 590",
            "22: joint.left_knee.rate_max_deg_per_s = 590: must be at most 588.9, the motor's speed without load",
        ),
    ]);
}

#[test]
fn a_missing_mechanism_file_is_reported_with_its_path() {
    let errors = Mechanism::load("no/such/mechanism.toml").expect_err("there is no such file");
    assert!(errors.to_string().starts_with("no/such/mechanism.toml: cannot be read: "), "{errors}");
}

#[test]
fn invalid_toml_is_reported_with_its_place() {
    let errors = Mechanism::from_toml("name = \"x\"\n[sole\nwidth_m = \n", "bad.toml").expect_err("no TOML");
    let places: Vec<_> = errors.0.iter().map(|error| (error.line, error.column)).collect();
    assert_eq!(places, [(2, 6)], "{errors}");
}

#[test]
fn the_fingerprint_depends_on_numbers_only() {
    let text = committed();
    let fingerprint =
        |text: &str| Mechanism::from_toml(text, "x").unwrap_or_else(|errors| panic!("{errors}")).fingerprint;
    let original = fingerprint(&text);
    let bare: String = text.lines().filter(|line| !line.starts_with('#')).map(|line| format!("{line}\n")).collect();
    assert_eq!(fingerprint(&bare), original, "comments do not count");
    let reordered = text.replace("behind_m = 0.07\nahead_m = 0.21\n", "ahead_m = 0.21\nbehind_m = 0.070\n");
    assert_ne!(reordered, text);
    assert_eq!(fingerprint(&reordered), original, "the order of keys does not count");
    let heavier = text.replace("mass_kg = 28.625", "mass_kg = 28.626");
    assert_ne!(fingerprint(&heavier), original, "a gram counts");
    let stiffer = text.replace("stiffness_n_m_per_rad = 5000", "stiffness_n_m_per_rad = 5001");
    assert_ne!(fingerprint(&stiffer), original, "the servos count");
    let renamed = text.replace("name = \"human-size biped\"", "name = \"another\"");
    assert_ne!(renamed, text);
    assert_eq!(fingerprint(&renamed), original, "the name does not count");
}

/// The nominal half-step stays valid: it is planned without drives.
#[test]
fn the_fingerprint_of_the_body_does_not_depend_on_the_servos() {
    let text = committed();
    let body =
        |text: &str| Mechanism::from_toml(text, "x").unwrap_or_else(|errors| panic!("{errors}")).body_fingerprint;
    let stiffer = text.replace("stiffness_n_m_per_rad = 5000", "stiffness_n_m_per_rad = 4000");
    let heavier = text.replace("mass_kg = 28.625", "mass_kg = 28.626");
    assert!(stiffer != text && body(&stiffer) == body(&text));
    assert_ne!(body(&heavier), body(&text));
}

#[test]
fn a_mechanism_without_servos_is_told_where_they_were() {
    let text = committed();
    let begin = text.find("[servo.legs_and_waist]").expect("a table");
    let end = begin + text[begin..].find("[joint.foot_roll]").expect("the next one");
    let errors = Mechanism::from_toml(&(text[..begin].to_owned() + &text[end..]), "m.toml").expect_err("none");
    let must =
        "servo: must have the tables [servo.legs_and_waist] and [servo.arms]: until 0.1.0 they were in plant.toml";
    assert_eq!(errors.to_string(), format!("m.toml:1:1: {must}"));
}

#[test]
fn a_sole_has_a_width_or_two_edges() {
    let text = committed();
    let with = |aside: &str| Mechanism::from_toml(&text.replace("width_m = 0.08", aside), "m.toml");
    let loaded = |aside: &str| with(aside).unwrap_or_else(|errors| panic!("{errors}"));
    let [committed, same, shifted, other] =
        ["width_m = 0.08", "inside_m = 0.04\noutside_m = 0.04", "inside_m = 0.02\noutside_m = 0.05", "width_m = 0.07"]
            .map(loaded);
    assert_eq!(same, committed);
    assert_eq!((shifted.sole.inside, shifted.sole.outside), (0.02, 0.05));
    assert_ne!(shifted.body_fingerprint, other.body_fingerprint);
    for (aside, refusal) in [
        (
            "width_m = 0.08\ninside_m = 0.04",
            "sole.width_m = 0.08: must be left out: inside_m and outside_m tell both edges",
        ),
        ("inside_m = 0.04", "sole.outside_m: is missing: it must be a finite number"),
        ("inside_m = -0.04\noutside_m = 0.1", "sole.inside_m = -0.04: must lie between 0.001 and 2"),
    ] {
        let errors = with(aside).expect_err("a wrong sole").to_string();
        assert!(errors.contains(refusal), "{errors}");
    }
}
