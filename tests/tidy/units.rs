//! Public fields and constants state the unit of the physical quantity that they hold.
//!
//! The check covers types that contain `f64`, except poses and rotations. The unit stands in parentheses anywhere in
//! the documentation: `(rad/s)`, or `(-)` for a pure number. Words that imply a pure number, e.g. ratio, also count.

use quote::ToTokens;
use syn::visit::Visit;
use syn::{Attribute, Field, Fields, ItemConst, ItemStruct, Visibility};

use crate::offence::Offence;
use crate::sources::Sources;
use crate::syntax::{documentation, parse_without_tests, tokens};

/// Units and the symbols that they are composed of.
const UNITS: &[&str] = &[
    "-", "%", "‰", "°", "1", "m", "mm", "µm", "s", "ms", "µs", "us", "ns", "rad", "deg", "kg", "g", "N", "kN", "Nm",
    "V", "A", "Ω", "W", "J", "Hz", "px", "ticks", "tick", "knots", "samples", "periods", "bytes",
];

/// Words that imply a pure number, or state the unit in another way.
const PURE: &[&str] =
    &["ratio", "share", "fraction", "factor", "progress", "dimensionless", "unit vector", "quaternion", "unit of the"];

/// Fields and constants without a unit.
pub fn without_unit(sources: &Sources) -> Vec<Offence> {
    let mut offences = Vec::new();
    for (file, text) in sources.of_crates() {
        let mut finder = Finder { file, offences: Vec::new() };
        finder.visit_file(&parse_without_tests(file, text));
        offences.append(&mut finder.offences);
    }
    offences
}

struct Finder<'a> {
    file: &'a str,
    offences: Vec<Offence>,
}

impl Finder<'_> {
    fn look_at(&mut self, visibility: &Visibility, name: &syn::Ident, of: &str, attributes: &[Attribute], unit: bool) {
        let is_public = matches!(visibility, Visibility::Public(_));
        if is_public && !unit && !states_a_unit(&documentation(attributes)) {
            let line = name.span().start().line;
            self.offences.push(Offence::new(self.file, line, format!("`{of}{name}`: its documentation has no unit")));
        }
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_item_struct(&mut self, item: &'ast ItemStruct) {
        // A struct's documentation may state one unit for all of its fields.
        let unit = states_a_unit(&documentation(&item.attrs));
        if let (Visibility::Public(_), Fields::Named(fields)) = (&item.vis, &item.fields) {
            for Field { vis, ident, attrs, ty, .. } in &fields.named {
                if let Some(name) = ident.as_ref().filter(|_| is_quantity(ty)) {
                    self.look_at(vis, name, &format!("{}.", item.ident), attrs, unit);
                }
            }
        }
    }

    fn visit_item_const(&mut self, item: &'ast ItemConst) {
        if is_quantity(&item.ty) {
            self.look_at(&item.vis, &item.ident, "", &item.attrs, false);
        }
    }
}

/// Whether a type holds numbers with a unit; poses and rotations have none.
fn is_quantity(kind: &syn::Type) -> bool {
    let tokens = tokens(kind.to_token_stream());
    let has = |name: &str| tokens.iter().any(|token| token.text == name);
    has("f64") && !["Isometry2", "Isometry3", "UnitQuaternion", "Quaternion", "Rotation3"].into_iter().any(has)
}

/// Whether a text contains a unit in parentheses or a word that implies a pure number.
fn states_a_unit(text: &str) -> bool {
    let mut in_parentheses = text.split('(').skip(1).filter_map(|rest| rest.split_once(')'));
    PURE.iter().any(|word| text.to_lowercase().contains(word)) || in_parentheses.any(|(inside, _)| is_unit(inside))
}

/// Whether a text is a unit or a list of units: `N·m/rad²`, `m, rad`.
fn is_unit(text: &str) -> bool {
    let parts = text.split(['·', '/', '*', ',', ' ', '(', ')', '√']);
    let mut parts = parts.map(|part| part.trim_end_matches(['²', '³', '⁴', '⁻', '¹'])).filter(|part| !part.is_empty());
    let has_any = !text.trim().is_empty();
    has_any && parts.all(|part| UNITS.contains(&part))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_none;

    #[test]
    fn public_quantities_state_their_unit() {
        let remedy = "End the documentation with the unit in parentheses: `(rad/s)`, or `(-)` for a pure number.";
        assert_none(&without_unit(&Sources::of_repository()), remedy);
    }

    #[test]
    fn a_quantity_without_a_unit_is_found() {
        let text = r#"
            pub struct A {
                /// How long (m).
                pub a: f64,
                /// How wide.
                pub b: f64,
                /// At 5 (Hz or so).
                pub c: Vector3<f64>,
                /// Speed factor.
                pub d: f64,
                /// Whose.
                pub e: u32,
                f: f64,
                /// Of the sole.
                pub g: Isometry3<f64>,
            }

            /// Lengths (m).
            pub struct B {
                /// Of a.
                pub a: f64,
            }

            /// Gravity (m/s²).
            pub const G: f64 = 9.81;

            /// Gravity.
            pub const H: f64 = 9.81;
        "#;
        let found = without_unit(&Sources::sample(&[("crates/model/src/lib.rs", text)]));
        let names: Vec<&str> = found.iter().filter_map(|offence| offence.what.split('`').nth(1)).collect();
        assert_eq!(names, ["A.b", "A.c", "H"]);
    }
}
