//! Where a request comes from.

use crate::code::codes;

codes! {
    /// Where a request comes from; `controller.toml` ranks those of operators by priority.
    Source {
        /// A person at a command line.
        Console = 0 "console",
        /// A file or a pipe of commands.
        Script = 1 "script",
        /// A person with keys, sticks or sliders.
        Teleop = 2 "teleop",
        /// Another program.
        Program = 3 "program",
        /// The control loop of the controller's own process, after missed deadlines. No operator may claim it.
        ControlLoop = 4 "control loop",
    }
}

impl Source {
    /// The sources that operators may claim, in the order of their numbers; `controller.toml` ranks these.
    pub const OPERATORS: [Source; 4] = [Source::Console, Source::Script, Source::Teleop, Source::Program];
}
