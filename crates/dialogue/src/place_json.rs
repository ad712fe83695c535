//! Way-points and footsteps as JSON, in metres and degrees.
//!
//! ```text
//! {"x_m": 3, "y_m": 2, "heading_deg": 90}
//! [{"x_m": 1, "y_m": 0}, {"x_m": 3, "y_m": 2, "heading_deg": 90}]
//! [{"side": "left", "x_m": 0.2, "y_m": 0.1, "heading_deg": 0}]
//! ```
//!
//! Whatever is wrong is named with its place, counted from 1.

use std::fmt;
use std::marker::PhantomData;

use interface::{Footstep, PLACES_MAX, PlaceList, Places, WalkPose, Waypoint};
use model::Side;
use serde::de::value::MapAccessDeserializer;
use serde::de::{DeserializeOwned, Error, IgnoredAny, MapAccess, SeqAccess, Unexpected, Visitor};
use serde::{Deserialize, Deserializer};

/// A place as it is written.
trait PlaceJson: DeserializeOwned {
    type Place: Copy;
    /// What is expected, as text.
    const EXPECTED: &str;
    /// Whether a single place need not be in an array.
    const MAY_BE_ALONE: bool;

    fn place(self) -> Self::Place;
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WaypointJson {
    x_m: f64,
    y_m: f64,
    heading_deg: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FootstepJson {
    side: Side,
    x_m: f64,
    y_m: f64,
    heading_deg: f64,
}

/// A place that must be an object: serde would accept an array as well, which nobody could read.
struct Object<J>(J);

struct ObjectVisitor<J>(PhantomData<J>);

struct PlacesVisitor<J>(PhantomData<J>);

/// Way-points to a goal, for serde's `deserialize_with`.
pub(crate) fn waypoints<'d, D: Deserializer<'d>>(deserializer: D) -> Result<Option<Places>, D::Error> {
    let list = deserializer.deserialize_any(PlacesVisitor::<WaypointJson>(PhantomData))?;
    Ok(Some(Places::Waypoints(list)))
}

/// Footsteps, for serde's `deserialize_with`.
pub(crate) fn footsteps<'d, D: Deserializer<'d>>(deserializer: D) -> Result<Option<Places>, D::Error> {
    let list = deserializer.deserialize_any(PlacesVisitor::<FootstepJson>(PhantomData))?;
    Ok(Some(Places::Footsteps(list)))
}

/// Footsteps of a text that holds nothing else.
///
/// # Errors
/// The text is no array of footsteps: what is wrong, and where.
pub fn read_footsteps(text: &str) -> Result<Places, serde_json::Error> {
    #[derive(Deserialize)]
    #[serde(transparent)]
    struct Whole {
        #[serde(deserialize_with = "footsteps")]
        places: Option<Places>,
    }
    let whole: Whole = serde_json::from_str(text)?;
    whole.places.ok_or_else(|| Error::custom(FootstepJson::EXPECTED))
}

impl PlaceJson for WaypointJson {
    type Place = Waypoint;
    const EXPECTED: &str =
        r#"a way-point such as {"x_m":3,"y_m":2,"heading_deg":90}, heading_deg being optional, or an array of them"#;
    const MAY_BE_ALONE: bool = true;

    fn place(self) -> Waypoint {
        Waypoint { x: self.x_m, y: self.y_m, heading: self.heading_deg.map(f64::to_radians) }
    }
}

impl PlaceJson for FootstepJson {
    type Place = Footstep;
    const EXPECTED: &str = r#"an array of footsteps such as {"side":"left","x_m":0.2,"y_m":0.1,"heading_deg":0}"#;
    const MAY_BE_ALONE: bool = false;

    fn place(self) -> Footstep {
        let sole = WalkPose { x: self.x_m, y: self.y_m, heading: self.heading_deg.to_radians() };
        Footstep { side: self.side, sole }
    }
}

impl<'d, J: PlaceJson> Visitor<'d> for PlacesVisitor<J> {
    type Value = PlaceList<J::Place>;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(J::EXPECTED)
    }

    fn visit_map<A: MapAccess<'d>>(self, map: A) -> Result<Self::Value, A::Error> {
        if !J::MAY_BE_ALONE {
            return Err(Error::invalid_type(Unexpected::Map, &self));
        }
        let place = J::deserialize(MapAccessDeserializer::new(map)).map_err(|error| at_place(1, error))?.place();
        PlaceList::new(&[place]).ok_or_else(|| Error::custom(J::EXPECTED))
    }

    fn visit_seq<A: SeqAccess<'d>>(self, mut elements: A) -> Result<Self::Value, A::Error> {
        let mut places = Vec::with_capacity(PLACES_MAX);
        while places.len() < PLACES_MAX {
            match elements.next_element::<Object<J>>() {
                Ok(Some(Object(json))) => places.push(json.place()),
                Ok(None) => break,
                Err(error) => return Err(at_place(places.len() + 1, error)),
            }
        }
        if places.len() == PLACES_MAX && elements.next_element::<IgnoredAny>()?.is_some() {
            return Err(at_place(PLACES_MAX + 1, format_args!("at most {PLACES_MAX} can be given at a time")));
        }
        PlaceList::new(&places).ok_or_else(|| Error::invalid_length(0, &self))
    }
}

impl<'d, J: PlaceJson> Deserialize<'d> for Object<J> {
    fn deserialize<D: Deserializer<'d>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(ObjectVisitor(PhantomData)).map(Self)
    }
}

impl<'d, J: PlaceJson> Visitor<'d> for ObjectVisitor<J> {
    type Value = J;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("an object in {}")
    }

    fn visit_map<A: MapAccess<'d>>(self, map: A) -> Result<J, A::Error> {
        J::deserialize(MapAccessDeserializer::new(map))
    }
}

/// An error with its place before it.
fn at_place<E: Error>(number: usize, problem: impl fmt::Display) -> E {
    E::custom(format_args!("place {number}: {problem}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP: &str = r#"{"side":"right","x_m":0.2,"y_m":-0.1,"heading_deg":180}"#;

    fn problem(text: &str) -> String {
        read_footsteps(text).expect_err("it is wrong").to_string()
    }

    #[test]
    fn footsteps_are_read_in_metres_and_degrees() {
        let text = format!("[\n{STEP},\n{}\n]", STEP.replace("right", "left"));
        let Ok(Places::Footsteps(read)) = read_footsteps(&text) else { panic!("no footsteps") };
        let sole = WalkPose { x: 0.2, y: -0.1, heading: std::f64::consts::PI };
        assert_eq!(*read, [Side::Right, Side::Left].map(|side| Footstep { side, sole }));
    }

    #[test]
    fn a_list_has_up_to_24_places_and_the_next_one_is_named() {
        let steps = |count: usize| format!("[{}]", vec![STEP; count].join(","));
        assert_eq!(read_footsteps(&steps(PLACES_MAX)).map(|places| places.count()).ok(), Some(PLACES_MAX));
        for count in [PLACES_MAX + 1, 1000] {
            let told = problem(&steps(count));
            assert!(told.starts_with("place 25: at most 24 can be given at a time at line 1"), "{told}");
        }
        assert!(problem("[]").starts_with("invalid length 0, expected an array of footsteps"));
    }

    #[test]
    fn a_wrong_footstep_is_named_with_its_place() {
        let second = |wrong: &str| problem(&format!("[{STEP},\n  {wrong}]"));
        let told = second(&STEP.replace("right", "lft"));
        assert_eq!(told, "place 2: unknown variant `lft`, expected `right` or `left` at line 2 column 15");
        assert!(second(&STEP.replace("x_m", "x")).starts_with("place 2: unknown field `x`, expected one of `side`"));
        assert!(second(&STEP.replace(",\"heading_deg\":180", "")).starts_with("place 2: missing field `heading_deg`"));
        assert!(second(&STEP.replace("0.2", "\"far\"")).starts_with("place 2: invalid type: string \"far\""));
        assert!(second(&STEP.replace("0.2", "1e999")).starts_with("place 2: number out of range"));
        assert!(second(&STEP.replace("180", "null")).starts_with("place 2: invalid type: null"));
        assert!(second(&STEP.replace("y_m", "x_m")).starts_with("place 2: duplicate field `x_m`"));
        assert!(second("[1,2,3]").starts_with("place 2: invalid type: sequence, expected an object in {}"));
        assert!(problem(STEP).starts_with("invalid type: map, expected an array of footsteps"));
        assert!(problem("").starts_with("EOF while parsing"));
    }
}
