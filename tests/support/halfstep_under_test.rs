//! The `halfstep` binary, built with the tests so that they find it.

fn main() -> std::process::ExitCode {
    halfstep::run()
}
