//! The verdict on a request.

use crate::code::codes;

codes! {
    /// The verdict on a request.
    Verdict {
        /// Granted as requested.
        Accepted = 1 "accepted",
        /// Granted in part: the reply has the values in force and the active limit.
        Limited = 2 "limited",
        /// Nothing of it takes effect.
        Refused = 3 "refused",
    }
}
