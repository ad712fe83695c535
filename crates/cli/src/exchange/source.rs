//! Source of requests, wire ↔ controller.

use controller::Source;

/// Who asks, for the controller.
pub fn for_controller(source: wire::Source) -> Source {
    match source {
        wire::Source::Console => Source::Console,
        wire::Source::Script => Source::Script,
        wire::Source::Teleop => Source::Teleop,
        wire::Source::Program => Source::Program,
    }
}

/// Who asks, for the wire.
pub fn for_wire(source: Source) -> wire::Source {
    match source {
        Source::Console => wire::Source::Console,
        Source::Script => wire::Source::Script,
        Source::Teleop => wire::Source::Teleop,
        Source::Program => wire::Source::Program,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back_is_the_same() {
        for &source in wire::Source::ALL {
            assert_eq!(for_wire(for_controller(source)), source);
        }
    }
}
