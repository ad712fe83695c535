//! Names of test functions are statements, so that one line of a CI log shows what broke.

use syn::Item;

use crate::offence::Offence;
use crate::sources::Sources;
use crate::syntax::{attributes, parse};

/// First words that continue a sentence begun by the file name.
const CONJUNCTIONS: &[&str] = &["and", "as", "but", "nor", "or", "so", "whatever", "whenever", "wherever"];

/// First words that may begin a statement (`on_a_slope_the_ground_force_is_vertical`) or a mere fragment
/// (`on_a_slope`).
const PREPOSITIONS: &[&str] = &["at", "by", "for", "from", "in", "of", "on", "to", "with", "without"];

/// Fewest words of a statement, and of a statement that begins with a preposition.
const WORDS_MIN: [usize; 2] = [3, 6];

/// Test functions whose name is not a statement.
pub fn fragments(sources: &Sources) -> Vec<Offence> {
    let mut offences = Vec::new();
    for (file, text) in sources.iter() {
        let mut open = vec![parse(file, text).items];
        while let Some(items) = open.pop() {
            for item in items {
                let is_test = attributes(&item).iter().any(|attribute| attribute.path().is_ident("test"));
                match item {
                    Item::Fn(function) if is_test => {
                        let name = &function.sig.ident;
                        if is_fragment(&name.to_string()) {
                            offences.push(Offence::new(file, name.span().start().line, format!("`{name}`")));
                        }
                    }
                    Item::Mod(module) => open.extend(module.content.map(|(_, items)| items)),
                    _ => {}
                }
            }
        }
    }
    offences
}

fn is_fragment(name: &str) -> bool {
    let words: Vec<&str> = name.split('_').collect();
    let words_min = WORDS_MIN[usize::from(PREPOSITIONS.contains(&words[0]))];
    words.len() < words_min || CONJUNCTIONS.contains(&words[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_none;

    #[test]
    fn test_names_are_statements() {
        let remedy = "Give the function a name that is understandable without the file name: subject and verb.";
        assert_none(&fragments(&Sources::of_repository()), remedy);
    }

    #[test]
    fn a_name_that_only_finishes_a_sentence_is_found() {
        let text = "#[test] fn on_a_slope_the_ground_force_is_vertical() {}\nfn of_course() {}\n\
                    mod tests { #[test] fn and_the_rest_is_the_integrator() {}\n#[test] fn works() {}\n\
                    #[test] fn in_random_postures() {} }";
        let found = fragments(&Sources::sample(&[("tests/main.rs", text)]));
        let lines: Vec<usize> = found.iter().map(|offence| offence.line).collect();
        assert_eq!(lines, [3, 4, 5]);
    }
}
