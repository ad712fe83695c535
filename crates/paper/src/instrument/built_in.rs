//! What `halfstep paper` reads of `config/` beside the robot, carried by the program.

use crate::FileText;

/// The scenarios of figures, by the digits in the names of their files.
macro_rules! scenarios {
    ($($digits:literal)*) => {
        [$((
            concat!("figure_", $digits, ".toml"),
            include_str!(concat!("../../../../config/scenarios/figure_", $digits, ".toml")),
        )),*]
    };
}

/// `config/mechanism_other_reading.toml`.
const OTHER_AXES: (&str, &str) =
    ("mechanism_other_reading.toml", include_str!("../../../../config/mechanism_other_reading.toml"));
/// `config/paper.toml`.
const READING: (&str, &str) = ("paper.toml", include_str!("../../../../config/paper.toml"));
/// All of `config/scenarios`.
const SCENARIOS: [(&str, &str); 45] = scenarios!(
    "04" "05" "06" "07" "08" "09" "10" "11" "12" "13" "14" "15" "16" "17" "18" "19" "20" "21" "22" "23" "24" "25" "26"
    "27" "28" "29" "30" "31" "32" "33" "34" "35" "36" "37" "39" "40" "41" "42" "43" "44" "45" "46" "47" "48" "49"
);

/// The paper's mechanism with the other reading of its axes, `config/mechanism_other_reading.toml`.
pub fn built_in_other_axes() -> FileText {
    file_text(OTHER_AXES)
}

/// The text of `config/paper.toml`.
pub fn built_in_reading() -> FileText {
    file_text(READING)
}

/// The texts of all scenarios of `config/scenarios`, in the order of the figures.
pub fn built_in_scenarios() -> Vec<FileText> {
    SCENARIOS.map(file_text).into()
}

fn file_text((name, text): (&str, &str)) -> FileText {
    FileText { name: name.to_owned(), text: text.to_owned() }
}
