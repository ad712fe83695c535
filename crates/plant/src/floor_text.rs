//! The floor in words.

use crate::PlantParameters;

impl PlantParameters {
    /// What the floor is, for people: `a plane`, or the parts that make it other than that.
    pub fn floor_text(&self) -> String {
        let (slope, floor) = (self.slope, &self.floor);
        let mut parts = Vec::new();
        for (angle, way) in [(slope.ahead, "ahead"), (slope.left, "to the left")] {
            if angle != 0.0 {
                let degrees = angle.to_degrees().abs();
                parts.push(format!("a slope of {degrees:.3}° {} {way}", if angle > 0.0 { "up" } else { "down" }));
            }
        }
        if self.unevenness.height > 0.0 {
            parts.push(format!("tiles of ±{} mm", self.unevenness.height * 1e3));
        }
        parts.extend(floor.steps.iter().map(|step| format!("a step of {:+} mm", step.height * 1e3)));
        parts.extend(floor.ramps.iter().map(|ramp| format!("a ramp of {:+.3}°", ramp.rise.to_degrees())));
        parts.extend(floor.height_field.iter().map(|field| format!("the heights of {}", field.file)));
        parts.extend(
            floor.friction_tiles.iter().map(|tiles| format!("friction of {} to {}", tiles.least, tiles.greatest)),
        );
        parts.extend(floor.friction_patches.iter().map(|patch| format!("a patch of friction {}", patch.friction)));
        if parts.is_empty() { "a plane".to_owned() } else { parts.join(", ") }
    }
}

#[cfg(test)]
mod tests {
    use config::Config;

    use super::*;

    #[test]
    fn a_floor_is_told_by_its_parts() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/plant.toml");
        let text = std::fs::read_to_string(file).expect("a committed file");
        let told = |text: &str| PlantParameters::from_toml(text, "plant.toml").expect("a floor").floor_text();
        assert_eq!(told(&text), "a plane");
        let step = "\n[[floor.step]]\nfrom_m = 1\nheight_m = -0.03\n";
        let shaped = text.replace("ahead_deg = 0", "ahead_deg = -2").replace("height_m = 0", "height_m = 0.002") + step;
        assert_eq!(told(&shaped), "a slope of 2.000° down ahead, tiles of ±2 mm, a step of -30 mm");
    }
}
