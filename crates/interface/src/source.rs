//! Where a request comes from.

use crate::code::codes;

codes! {
    /// Where a request comes from; `controller.toml` ranks the sources by priority.
    Source {
        /// A person at a command line.
        Console = 0 "console",
        /// A file or a pipe of commands.
        Script = 1 "script",
        /// A person with keys, sticks or sliders.
        Teleop = 2 "teleop",
        /// Another program.
        Program = 3 "program",
    }
}
