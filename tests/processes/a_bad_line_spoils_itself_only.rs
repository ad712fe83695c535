//! A line that is no text, or has no end, is refused with its number; all others are heard. The file of a walk is
//! refused as a whole, with each such line.

use std::io::Write;

use halfstep_tests::command_line::CommandLine;

fn broken() -> Vec<u8> {
    let mut bytes =
        b"\xef\xbb\xbf{\"t\":1,\"turn_deg\":5}\r\n\r\n{\"t\":2,\"speed\":1.1,\"note\":\"gr\xfc\xdfe\"}\n".to_vec();
    bytes.extend(std::iter::repeat_n(b'a', 3_000_000));
    bytes.extend(b"\n\0\n{\"t\":3,\"turn_deg\":0}");
    bytes
}

const COMPLAINTS: [&str; 3] = [
    ":3: not UTF-8 (byte 30 of the line); write e.g. {",
    ":4: longer than 65536 bytes; write",
    ":5: not a JSON object",
];

#[test]
fn a_bad_line_spoils_itself_only() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let path = command_line.folder().join("broken.jsonl");
    std::fs::File::create(&path).unwrap().write_all(&broken()).unwrap();

    let _controller = command_line.start_here("controller --lockstep");
    command_line.wait_for_controller();
    let _plant = command_line.start_here("plant --lockstep");
    let streamed = command_line.start_here("stream broken.jsonl").finish();
    let lines: Vec<&str> = streamed.stdout.lines().collect();
    assert_eq!((lines.len(), streamed.code), (2, Some(1)), "{lines:?} {}", streamed.stderr);
    assert!(lines[0].starts_with("1: accepted: turn 5°") && lines[1].starts_with("6: accepted: turn 0°"), "{lines:?}");

    let walked = command_line.run("walk --lockstep --for 4s --commands broken.jsonl --out walked");
    assert_eq!((walked.code, &*walked.stdout), (Some(2), ""), "nothing is walked");
    for stderr in [streamed.stderr, walked.stderr] {
        for (line, complaint) in stderr.lines().zip(COMPLAINTS) {
            assert!(line.starts_with(&format!("broken.jsonl{complaint}")), "{stderr}");
        }
        assert_eq!(stderr.lines().count(), 3, "{stderr}");
    }
}
