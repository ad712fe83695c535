//! Only listed files match on `Side`: all other code is written for the right foot as support and mirrored.

use quote::ToTokens;
use syn::visit::Visit;

use crate::offence::Offence;
use crate::sources::Sources;
use crate::syntax::{Token, parse_without_tests, tokens};

/// Files that may have `Side::Right =>` or `Side::Left =>`, each with its reason.
pub const ALLOWED: &[(&str, &str)] = &[
    ("crates/charts/src/colours.rs", "the colour of a side"),
    ("crates/dynamics/src/leg_geometry.rs", "the right leg's chain begins at the foot, the left one's at the pelvis"),
    ("crates/dynamics/src/leg_solver.rs", "the right leg's chain begins at the foot, the left one's at the pelvis"),
    ("crates/interchange/src/side_name.rs", "the name of a side"),
    ("crates/model/src/mechanism.rs", "the link of a foot"),
    ("crates/model/src/mirror.rs", "mirrors everything"),
    ("crates/model/src/side.rs", "the other side"),
    ("crates/model/src/sole.rs", "the inner edge of a sole"),
    ("crates/paper/src/picture.rs", "mirrors a footprint"),
    ("crates/plots/src/picture/balance_over_time.rs", "the name of a side"),
    ("crates/synthesis/src/error.rs", "the name of a side"),
    ("crates/wire/src/message/report.rs", "the number of a side"),
];

/// Match arms on a side in files that are not in `allowed`.
pub fn offences(sources: &Sources, allowed: &[(&str, &str)]) -> Vec<Offence> {
    let others = sources.of_crates().filter(|(file, _)| !allowed.iter().any(|(place, _)| place == file));
    others.flat_map(|(file, text)| arms(file, text)).collect()
}

/// Files of `allowed` that do not match on a side.
pub fn unneeded<'a>(sources: &Sources, allowed: &[(&'a str, &str)]) -> Vec<&'a str> {
    let is_needed = |place: &str| sources.0.get(place).is_some_and(|text| !arms(place, text).is_empty());
    allowed.iter().map(|(place, _)| *place).filter(|place| !is_needed(place)).collect()
}

/// Match arms on a side. Within macro calls and attributes, `=>` must follow directly on the side to be found.
fn arms(file: &str, text: &str) -> Vec<Offence> {
    let parsed = parse_without_tests(file, text);
    let mut finder = Finder { file, offences: Vec::new() };
    finder.visit_file(&parsed);
    for arm in tokens(parsed.to_token_stream()).windows(4).filter(|part| part[3].text == "=>") {
        finder.look_at(arm);
    }
    finder.offences.sort();
    finder.offences.dedup();
    finder.offences
}

struct Finder<'a> {
    file: &'a str,
    offences: Vec<Offence>,
}

impl Finder<'_> {
    fn look_at(&mut self, pattern: &[Token]) {
        let side = pattern.windows(3).find(|part| {
            part[0].text == "Side" && part[1].text == "::" && ["Right", "Left"].contains(&part[2].text.as_str())
        });
        if let Some([_, _, side]) = side {
            self.offences.push(Offence::new(self.file, side.line, format!("matches on `Side::{}`", side.text)));
        }
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_arm(&mut self, arm: &'ast syn::Arm) {
        self.look_at(&tokens(arm.pat.to_token_stream()));
        syn::visit::visit_arm(self, arm);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_none;

    #[test]
    fn only_listed_files_match_on_a_side() {
        let remedy = "Write it for the right foot and mirror on the way in and out, or give the file a row with its \
                      reason in tests/tidy/side_arms.rs.";
        assert_none(&offences(&Sources::of_repository(), ALLOWED), remedy);
    }

    #[test]
    fn every_listed_file_matches_on_a_side() {
        let unneeded = unneeded(&Sources::of_repository(), ALLOWED);
        assert!(unneeded.is_empty(), "take these off the list in tests/tidy/side_arms.rs: {unneeded:?}");
    }

    #[test]
    fn an_arm_on_a_side_is_found_alone_in_a_tuple_and_in_an_attribute() {
        let text = "fn f(side: Side) { match side { Side::Right => {}\nmodel::Side::Left => {} } }\n\
                    fn g(s: Side, b: bool) { match (s, b) { (Side::Left, _) => {} _ => {} } }\n\
                    fn h(s: Side) -> bool { s == Side::Left }\n\
                    #[error(\"{leg}\", leg = match side { Side::Right => 1, _ => 2 })] struct E;";
        let sources = Sources::sample(&[("crates/gait/src/walk.rs", text)]);
        let lines: Vec<usize> = offences(&sources, &[]).iter().map(|offence| offence.line).collect();
        assert_eq!(lines, [1, 2, 3, 5]);
        assert_eq!(offences(&sources, &[("crates/gait/src/walk.rs", "the swap")]), []);
    }
}
