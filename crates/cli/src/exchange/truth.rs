//! The truth about the plant, loop → recording.

use record::TruthMessage;

use crate::record::PlantEntry;

/// What the plant has to tell of a tick, for its recording.
pub fn message(entry: &PlantEntry) -> TruthMessage {
    let PlantEntry { tick, angles, ref truth } = *entry;
    let (p, q) = (truth.soles[0].translation, truth.soles[0].rotation);
    TruthMessage {
        tick,
        right_sole: [p.x, p.y, p.z, q.w, q.i, q.j, q.k],
        angles: angles.0,
        loads: truth.loads,
        com: truth.com.into(),
        zmp: truth.zmp.map_or([f64::NAN; 2], Into::into),
        trunk_tilt: truth.trunk_tilt,
        fallen: truth.has_fallen().into(),
    }
}
