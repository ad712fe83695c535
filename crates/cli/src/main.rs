//! The `halfstep` binary.

fn main() -> std::process::ExitCode {
    halfstep::run()
}
