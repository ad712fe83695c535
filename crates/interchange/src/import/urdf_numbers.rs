//! Numbers in a URDF's attributes, each checked where it is read.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use crate::import::file_errors::FileErrors;
use crate::import::xml_tree::Element;

/// Values that a number may have, both ends included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Allowed {
    pub min: f64,
    pub max: f64,
    /// Unit in words, for messages.
    pub unit: &'static str,
}

/// Coordinates: so wide that a robot in millimetres is read, and told as such.
pub(super) const LENGTH: Allowed = Allowed { min: -1e5, max: 1e5, unit: "metres" };
/// Angles between frames.
pub(super) const TURN: Allowed = Allowed { min: -12.6, max: 12.6, unit: "radians, not degrees" };
/// Masses.
pub(super) const MASS: Allowed = Allowed { min: 0.0, max: 1e7, unit: "kilograms" };
/// Moments of inertia: those that are zero but for rounding may be negative.
pub(super) const MOMENT: Allowed = Allowed { min: -1e-12, max: 1e12, unit: "kg·m²" };
/// Products of inertia.
pub(super) const PRODUCT: Allowed = Allowed { min: -1e12, max: 1e12, unit: "kg·m²" };
/// Sizes of collision shapes.
pub(super) const SIZE: Allowed = Allowed { min: 0.0, max: 1e5, unit: "metres" };
/// Components of an axis.
pub(super) const AXIS: Allowed = Allowed { min: -1e3, max: 1e3, unit: "parts of a unit vector" };
/// Limits of a joint: angles (rad) or lengths (m).
pub(super) const LIMIT: Allowed = Allowed { min: -1e18, max: 1e18, unit: "radians or metres" };
/// Largest rate and effort of a joint, and any factor.
pub(super) const RATE: Allowed = Allowed { min: 0.0, max: 1e18, unit: "radians or metres per second" };
pub(super) const EFFORT: Allowed = Allowed { min: 0.0, max: 1e18, unit: "N·m or N" };
pub(super) const FACTOR: Allowed = Allowed { min: -1e6, max: 1e6, unit: "no unit" };

/// Reads attributes of the parts of one link or joint.
pub(super) struct UrdfNumbers<'a, 'f> {
    /// Link or joint with its name, for messages.
    pub owner: String,
    pub errors: &'a mut FileErrors<'f>,
}

impl UrdfNumbers<'_, '_> {
    /// One number; `None` where the attribute is absent, or wrong and noted.
    pub(super) fn optional(&mut self, element: &Element, attribute: &str, allowed: Allowed) -> Option<f64> {
        let text = element.attribute(attribute)?;
        let [value] = self.parse(element, attribute, text, allowed)?;
        Some(value)
    }

    /// One number that must be there; zero after noting what is wrong.
    pub(super) fn required(&mut self, element: &Element, attribute: &str, allowed: Allowed) -> f64 {
        if element.attribute(attribute).is_none() {
            self.note(element, &format!("<{}> must have {attribute}=\"…\" ({})", element.name, allowed.unit));
        }
        self.optional(element, attribute, allowed).unwrap_or(0.0)
    }

    /// Three numbers, or `default` where the attribute is absent, or wrong and noted.
    pub(super) fn vector(
        &mut self,
        element: &Element,
        attribute: &str,
        default: Vector3<f64>,
        allowed: Allowed,
    ) -> Vector3<f64> {
        let text = element.attribute(attribute);
        let numbers = text.and_then(|text| self.parse::<3>(element, attribute, text, allowed));
        numbers.map_or(default, Vector3::from)
    }

    /// The pose that an `<origin>` within an element tells: a rotation about the fixed axes x, y, z by roll, pitch,
    /// yaw, then a translation.
    pub(super) fn origin(&mut self, element: &Element) -> Isometry3<f64> {
        let Some(origin) = element.child("origin") else { return Isometry3::identity() };
        let place = self.vector(origin, "xyz", Vector3::zeros(), LENGTH);
        let turn = self.vector(origin, "rpy", Vector3::zeros(), TURN);
        Isometry3::from_parts(Translation3::from(place), UnitQuaternion::from_euler_angles(turn.x, turn.y, turn.z))
    }

    /// Notes an error of an element.
    pub(super) fn note(&mut self, element: &Element, error: &str) {
        self.errors.note_at(element.line, format!("{}: {error}", self.owner));
    }

    fn parse<const N: usize>(
        &mut self,
        element: &Element,
        attribute: &str,
        text: &str,
        allowed: Allowed,
    ) -> Option<[f64; N]> {
        let numbers: Option<Vec<f64>> = text.split_whitespace().map(|word| word.parse().ok()).collect();
        let numbers: Option<[f64; N]> = numbers.and_then(|numbers| numbers.try_into().ok());
        let right = |value: &f64| (allowed.min..=allowed.max).contains(value);
        if let Some(numbers) = numbers.filter(|numbers| numbers.iter().all(right)) {
            return Some(numbers);
        }
        let many = if N == 1 { "a number".to_string() } else { format!("{N} numbers") };
        let must = match numbers {
            Some(_) if allowed.max > 1e15 && allowed.min == 0.0 => {
                format!("must be {many}, finite and at least 0 ({})", allowed.unit)
            }
            Some(_) if allowed.max > 1e15 => format!("must be {many}, finite ({})", allowed.unit),
            Some(_) => {
                let min = if allowed.min.abs() < 1e-9 { 0.0 } else { allowed.min };
                format!("must be {many} from {min} to {} ({})", allowed.max, allowed.unit)
            }
            None if text.contains("${") || text.contains("$(") => {
                format!("must be {many} ({}); this is an expression of xacro: expand the file with xacro", allowed.unit)
            }
            None if text.contains(',') => {
                format!("must be {many} ({}), with decimal points, and spaces between numbers", allowed.unit)
            }
            None => format!("must be {many} ({})", allowed.unit),
        };
        let value = config::quoted(text);
        self.note(element, &format!("<{}> {attribute} = \"{value}\": {must}", element.name));
        None
    }
}
