//! What became of a push, in words.

use interface::{PushOutcome, PushReply};

/// A push and the reply to it as kind and text; the kind is `push` or `refused`.
///
/// * `impulse` – force times duration (N·s): ahead, to the left and up, as the robot faces
pub fn push_text(impulse: &[f64; 3], reply: &PushReply) -> (&'static str, String) {
    match *reply {
        PushReply { outcome: PushOutcome::Begun, start } => {
            let [ahead, left, up] = impulse;
            let push = format!("push of {ahead:.1} N·s ahead, {left:.1} left, {up:.1} up");
            ("push", format!("{push}, from {start:.3} s of the plant on"))
        }
        PushReply { outcome, .. } => ("refused", outcome.text().to_owned()),
    }
}
