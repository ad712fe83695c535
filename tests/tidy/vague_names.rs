//! Files, modules and types have specific names: no `utils`, no `manager`, no `helper`.

use crate::offence::Offence;
use crate::paths::body_tokens;
use crate::sources::Sources;
use crate::syntax::parse;

/// Words that could mean anything.
const VAGUE: &[&str] = &["util", "utils", "utility", "utilities", "manager", "managers", "helper", "helpers", "misc"];

/// Files, folders, modules and types with a vague word in their name.
pub fn vague(sources: &Sources) -> Vec<Offence> {
    let mut offences = Vec::new();
    for (file, text) in sources.iter() {
        for part in file.trim_end_matches(".rs").split('/').filter(|part| is_vague(part)) {
            offences.push(Offence::new(file, 1, format!("`{part}` is vague")));
        }
        let tokens = body_tokens(&parse(file, text).items);
        let defines = ["struct", "enum", "trait", "type", "mod"];
        for pair in tokens.windows(2).filter(|pair| defines.contains(&pair[0].text.as_str()) && is_vague(&pair[1].text))
        {
            offences.push(Offence::new(file, pair[1].line, format!("`{}` is vague", pair[1].text)));
        }
    }
    offences
}

/// Whether a name in `snake_case` or `CamelCase` contains a vague word.
fn is_vague(name: &str) -> bool {
    let mut snake = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake.split('_').any(|word| VAGUE.contains(&word))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_none;

    #[test]
    fn no_name_is_as_vague_as_utils_or_manager() {
        assert_none(
            &vague(&Sources::of_repository()),
            "Name it after its concept; if no noun fits, it may be two concepts.",
        );
    }

    #[test]
    fn a_vague_file_and_a_vague_type_are_found() {
        let sources = Sources::sample(&[("crates/gait/src/utils.rs", "struct StepManager; struct Futile;")]);
        let found: Vec<String> = vague(&sources).into_iter().map(|offence| offence.what).collect();
        assert_eq!(found, ["`utils` is vague", "`StepManager` is vague"]);
    }
}
