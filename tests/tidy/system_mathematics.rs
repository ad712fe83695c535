//! What a walk depends on calls no function of the system's mathematics, whose last bits differ from system to system.
//!
//! `nalgebra` does without by its feature `libm-force`.

use crate::offence::Offence;
use crate::paths::body_tokens;
use crate::sources::Sources;
use crate::syntax::parse_without_tests;

/// The crates by which a walk and the files of a robot are computed.
pub const CRATES: &[&str] = &[
    "controller",
    "dynamics",
    "gait",
    "interchange",
    "interface",
    "model",
    "pattern",
    "plant",
    "signal",
    "stabilizer",
    "synthesis",
];
/// Methods of `f64` that the system computes.
pub const FUNCTIONS: &[&str] = &[
    "acos", "asin", "atan", "atan2", "cbrt", "cos", "cosh", "exp", "exp2", "exp_m1", "hypot", "ln", "ln_1p", "log",
    "log10", "log2", "mul_add", "powf", "sin", "sin_cos", "sinh", "tan", "tanh",
];
/// Files with methods of the same names that are the project's own, each with its reason.
pub const ALLOWED: &[(&str, &str)] = &[
    ("crates/synthesis/src/arms.rs", "methods of Jet"),
    ("crates/synthesis/src/fourier.rs", "methods of Jet"),
    ("crates/synthesis/src/pendulum_path.rs", "methods of Jet"),
];

/// Calls of the system's mathematics outside of tests and allowed files.
pub fn offences(sources: &Sources, allowed: &[(&str, &str)]) -> Vec<Offence> {
    let mut offences = Vec::new();
    for (file, text) in sources.of_crates() {
        let of_walk = CRATES.iter().any(|name| file.starts_with(&format!("crates/{name}/src/")));
        if !of_walk || allowed.iter().any(|(place, _)| *place == file) {
            continue;
        }
        let tokens = body_tokens(&parse_without_tests(file, text).items);
        for triple in tokens.windows(3) {
            let [before, joint, name] = [0, 1, 2].map(|at| triple[at].text.as_str());
            let is_called = joint == "." || (joint == "::" && before == "f64");
            if is_called && FUNCTIONS.contains(&name) {
                offences.push(Offence::new(file, triple[2].line, format!("`{name}` is computed by the system")));
            }
        }
    }
    offences
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_none;

    #[test]
    fn a_walk_needs_no_mathematics_of_the_system() {
        let sources = Sources::of_repository();
        let remedy = "Call `libm`, or `dynamics::sin_cos` and `dynamics::atan2`.";
        assert_none(&offences(&sources, ALLOWED), remedy);
        let all = offences(&sources, &[]);
        let is_needed = |place: &str| all.iter().any(|offence| offence.file == place);
        assert!(ALLOWED.iter().all(|(place, _)| is_needed(place)), "a row of the allowed files is not needed");
    }

    #[test]
    fn a_method_and_a_path_are_found() {
        let text = "fn f(x: f64) -> f64 { x.sin() + f64::exp(x) + libm::cos(x) + x.sqrt() }\n\
                    #[cfg(test)] mod tests { fn g() { 1.0_f64.tan(); } }";
        let sources = Sources::sample(&[("crates/plant/src/lib.rs", text), ("crates/plots/src/lib.rs", text)]);
        let found: Vec<String> = offences(&sources, ALLOWED).into_iter().map(|offence| offence.what).collect();
        assert_eq!(found, ["`sin` is computed by the system", "`exp` is computed by the system"]);
    }
}
