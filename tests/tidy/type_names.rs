//! No two types of the workspace have the same name.

use std::collections::BTreeMap;

use syn::Item;

use crate::modules::{defined_by, defined_in};
use crate::offence::Offence;
use crate::paths::body_tokens;
use crate::sources::Sources;
use crate::syntax::parse_without_tests;

/// Names that several types may share, each with its reason.
pub const ALLOWED: &[(&str, &str)] = &[("Parameters", "the configuration of each crate that has any")];

/// Names shared by several types, one offence per name.
pub fn defined_twice(sources: &Sources, allowed: &[(&str, &str)]) -> Vec<Offence> {
    let mut places: BTreeMap<String, Vec<(&str, usize)>> = BTreeMap::new();
    for (file, text) in sources.of_crates() {
        for (name, line) in types_of(file, text) {
            places.entry(name).or_default().push((file, line));
        }
    }
    places.retain(|name, places| places.len() > 1 && !allowed.iter().any(|(allowed, _)| allowed == name));
    let offence = |name: &str, places: &[(&str, usize)]| {
        let others: Vec<String> = places[1..].iter().map(|(file, line)| format!("{file}:{line}")).collect();
        Offence::new(places[0].0, places[0].1, format!("`{name}` is also defined at {}", others.join(", ")))
    };
    places.iter().map(|(name, places)| offence(name, places)).collect()
}

/// Names in `allowed` that no two types share.
pub fn unneeded<'a>(sources: &Sources, allowed: &[(&'a str, &str)]) -> Vec<&'a str> {
    let found = defined_twice(sources, &[]);
    let is_needed = |name: &str| found.iter().any(|offence| offence.what.starts_with(&format!("`{name}` ")));
    allowed.iter().map(|(name, _)| *name).filter(|name| !is_needed(name)).collect()
}

/// The types that a file defines, including private ones and those within macro calls.
fn types_of(file: &str, text: &str) -> Vec<(String, usize)> {
    let mut types = Vec::new();
    let mut open = vec![parse_without_tests(file, text).items];
    while let Some(items) = open.pop() {
        for item in items {
            match item {
                Item::Mod(module) => open.extend(module.content.map(|(_, items)| items)),
                Item::Struct(_) | Item::Enum(_) | Item::Trait(_) | Item::Type(_) | Item::Union(_) => {
                    let name = defined_by(&item).remove(0);
                    let tokens = body_tokens(&[item]);
                    let line = tokens.iter().find(|token| token.text == name).map_or(1, |token| token.line);
                    types.push((name, line));
                }
                Item::Macro(item) if item.ident.is_none() => {
                    let tokens = crate::syntax::tokens(item.mac.tokens);
                    let is_type =
                        |name: &str| name.starts_with(char::is_uppercase) && name.contains(char::is_lowercase);
                    let defined = defined_in(&tokens).filter(|token| is_type(&token.text));
                    types.extend(defined.map(|token| (token.text.clone(), token.line)));
                }
                _ => {}
            }
        }
    }
    types
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_none;

    #[test]
    fn no_two_types_have_one_name() {
        let remedy = "Rename one of the types, or give the name a row with its reason in tests/tidy/type_names.rs.";
        assert_none(&defined_twice(&Sources::of_repository(), ALLOWED), remedy);
    }

    #[test]
    fn every_allowed_name_is_given_twice() {
        let unneeded = unneeded(&Sources::of_repository(), ALLOWED);
        let offences: Vec<Offence> =
            unneeded.iter().map(|name| Offence::new("tests/tidy/type_names.rs", 1, format!("`{name}`"))).collect();
        assert_none(&offences, "Take these names off the list.");
    }

    #[test]
    fn a_name_given_twice_is_found_in_macro_calls_and_private_modules() {
        let macro_call = "codes! { /// How.\n pub enum Intent { Walk, Stop } }";
        let module = "mod inner { struct Intent; } #[cfg(test)] mod tests { struct Intent; }";
        let sources =
            Sources::sample(&[("crates/wire/src/lib.rs", macro_call), ("crates/controller/src/mode.rs", module)]);
        let found = defined_twice(&sources, &[]);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].what, "`Intent` is also defined at crates/wire/src/lib.rs:2");
        assert_eq!(defined_twice(&sources, &[("Intent", "a reason")]), []);
    }
}
