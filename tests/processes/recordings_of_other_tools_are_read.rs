//! Goal: a recording that other MCAP tools have sorted, filtered or compressed is still a recording; and of one that
//! holds less than a run, it is said what it lacks.

use std::fs;
use std::io::Write;
use std::path::Path;

use halfstep_tests::command_line::CommandLine;
use halfstep_tests::repository;

const MAGIC: &[u8] = b"\x89MCAP0\r\n";
/// Kinds of records.
const HEADER: u8 = 0x01;
const FOOTER: u8 = 0x02;
const CHANNEL: u8 = 0x04;
const MESSAGE: u8 = 0x05;
const CHUNK: u8 = 0x06;
const MESSAGE_INDEX: u8 = 0x07;
const ATTACHMENT: u8 = 0x09;
const METADATA: u8 = 0x0C;
const DATA_END: u8 = 0x0F;

/// A record: its kind, and what it holds.
type Record = (u8, Vec<u8>);

/// The records of a file or of a chunk.
fn records(mut bytes: &[u8]) -> Vec<Record> {
    let mut records = Vec::new();
    while let Some((head, rest)) = bytes.split_first_chunk::<9>() {
        let length = u64::from_le_bytes(head[1..].try_into().unwrap()) as usize;
        records.push((head[0], rest[..length].to_vec()));
        bytes = &rest[length..];
    }
    records
}

fn bytes_of(records: &[Record]) -> Vec<u8> {
    let of_record = |(kind, data): &Record| [&[*kind][..], &(data.len() as u64).to_le_bytes(), data].concat();
    records.iter().flat_map(of_record).collect()
}

/// Writes a file: its end as the format demands it, without an index.
fn write(file: &Path, records: &[Record]) {
    let end = [(DATA_END, vec![0; 4]), (FOOTER, vec![0; 20])];
    fs::write(file, [MAGIC, &bytes_of(records), &bytes_of(&end), MAGIC].concat()).unwrap();
}

/// What stands in a recording before its index.
fn data(file: &Path) -> Vec<Record> {
    let bytes = fs::read(file).unwrap();
    let all = records(&bytes[MAGIC.len()..bytes.len() - MAGIC.len()]);
    all.into_iter().take_while(|(kind, _)| *kind != DATA_END).filter(|(kind, _)| *kind != MESSAGE_INDEX).collect()
}

/// The records of a chunk that is not compressed: behind three numbers, a checksum, no name, and their length.
fn unpacked(chunk: &[u8]) -> &[u8] {
    &chunk[8 + 8 + 8 + 4 + 4 + 8..]
}

/// The chunk with other records, compressed.
fn packed(chunk: &[u8], records: &[u8], compression: &str) -> Record {
    let packed = match compression {
        "lz4" => {
            let mut encoder = lz4_flex::frame::FrameEncoder::new(Vec::new());
            encoder.write_all(records).unwrap();
            encoder.finish().unwrap()
        }
        "zstd" => ruzstd::encoding::compress_to_vec(records, ruzstd::encoding::CompressionLevel::Fastest),
        _ => records.to_vec(),
    };
    let mut data = chunk[..16].to_vec();
    data.extend((records.len() as u64).to_le_bytes());
    data.extend(crc32fast::hash(records).to_le_bytes());
    data.extend((compression.len() as u32).to_le_bytes());
    data.extend(compression.bytes());
    data.extend((packed.len() as u64).to_le_bytes());
    data.extend(packed);
    (CHUNK, data)
}

/// A command line in whose folder `run/run.mcap` is a run of a second.
fn recorded() -> CommandLine {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let walked = command_line.run("walk --lockstep --for 1s --out run");
    assert_eq!(walked.code, Some(0), "{}", walked.stderr);
    command_line
}

#[test]
fn attachments_and_metadata_are_found_wherever_they_stand() {
    let command_line = recorded();
    let all = data(&command_line.folder().join("run/run.mcap"));
    let is_of = |kinds: &'static [u8]| move |(kind, _): &&Record| kinds.contains(kind);
    let part = |kinds: &'static [u8]| all.iter().filter(is_of(kinds)).cloned().collect::<Vec<_>>();
    let (head, chunks, metadata, attachments) =
        (part(&[HEADER]), part(&[CHUNK]), part(&[METADATA]), part(&[ATTACHMENT]));
    let middle = chunks.len() / 2;
    for (order, records) in [
        ("attachments last", [&head[..], &metadata, &chunks, &attachments]),
        ("both last", [&head[..], &chunks, &metadata, &attachments]),
        ("metadata last", [&head[..], &attachments, &chunks, &metadata]),
        ("attachments in the middle", [&head[..], &metadata, &chunks[..middle], &attachments]),
    ] {
        let rest = if order.ends_with("middle") { &chunks[middle..] } else { &[] };
        write(&command_line.folder().join("rewritten.mcap"), &[records.concat(), rest.to_vec()].concat());
        let replayed = command_line.run("replay rewritten.mcap");
        assert_eq!((replayed.code, replayed.stdout.as_str()), (Some(0), "identical: 1000 setpoints\n"), "{order}");
        let drawn = command_line.run("plot rewritten.mcap --out pictures");
        assert_eq!((drawn.code, drawn.stderr.as_str()), (Some(0), ""), "{order}");
    }
}

#[test]
fn compressed_recordings_are_read_and_unknown_compressions_refused_with_the_remedy() {
    let command_line = recorded();
    let all = data(&command_line.folder().join("run/run.mcap"));
    for compression in ["lz4", "zstd", "br"] {
        let records: Vec<Record> = all
            .iter()
            .map(|(kind, data)| match *kind {
                CHUNK => packed(data, unpacked(data), compression),
                _ => (*kind, data.clone()),
            })
            .collect();
        write(&command_line.folder().join("packed.mcap"), &records);
        let replayed = command_line.run("replay packed.mcap");
        let drawn = command_line.run("plot packed.mcap --out packed");
        if compression == "br" {
            let says = "packed.mcap: is compressed with `br`; lz4 and zstd can be read, for others unpack it first \
                        with `mcap decompress`\n";
            assert_eq!((replayed.code, replayed.stderr.as_str()), (Some(2), says));
            assert_eq!((drawn.code, drawn.stderr.as_str()), (Some(2), says));
        } else {
            assert_eq!(replayed.stdout, "identical: 1000 setpoints\n", "{compression}: {}", replayed.stderr);
            assert_eq!((drawn.code, drawn.stderr.as_str()), (Some(0), ""), "{compression}");
            assert_eq!(command_line.read("packed/footprints.svg"), command_line.read("run/footprints.svg"));
        }
    }
}

/// Not "different": the controller was right, and the recording is at fault.
#[test]
fn a_lost_request_is_told_as_missing() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    fs::write(command_line.folder().join("c.jsonl"), "{\"t\":0.3,\"turn_deg\":10}\n{\"t\":0.5,\"speed\":1.1}\n")
        .unwrap();
    let walked = command_line.run("walk --lockstep --for 1s --commands c.jsonl --out run");
    assert_eq!(walked.code, Some(0), "{}", walked.stderr);
    let all = data(&command_line.folder().join("run/run.mcap"));
    // The channel's number stands before the schema's and the topic.
    let is_requests = |(kind, data): &Record| *kind == CHANNEL && data[8..].starts_with(b"/requests");
    let chunks = all.iter().filter(|(kind, _)| *kind == CHUNK).flat_map(|(_, data)| records(unpacked(data)));
    let channel = { chunks }.find(is_requests).expect("the channel of requests").1[..2].to_vec();
    let mut lost = false;
    let cut: Vec<Record> = all
        .iter()
        .map(|(kind, data)| match *kind {
            CHUNK => {
                let mut within = records(unpacked(data));
                // The number of a message is behind the channel's.
                let second = |(kind, data): &Record| {
                    *kind == MESSAGE && data[..2] == channel && data[2..6] == 2_u32.to_le_bytes()
                };
                let before = within.len();
                within.retain(|record| !second(record));
                lost |= within.len() < before;
                packed(data, &bytes_of(&within), "")
            }
            _ => (*kind, data.clone()),
        })
        .collect();
    assert!(lost, "the second request was recorded");
    write(&command_line.folder().join("lost.mcap"), &cut);
    let replayed = command_line.run("replay lost.mcap");
    assert_eq!(replayed.code, Some(1), "{}", replayed.stdout);
    let [identical, missing] = replayed.stdout.lines().collect::<Vec<_>>()[..] else { panic!("{}", replayed.stdout) };
    assert!(identical.starts_with("identical: ") && missing.contains("request 2, of tick "), "{}", replayed.stdout);
}

#[test]
fn what_a_recording_lacks_is_said_and_no_empty_picture_is_drawn() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let controller = command_line.start_here("controller --lockstep --for 1s --out c");
    command_line.wait_for_controller();
    let plant = command_line.start_here("plant --lockstep --for 1s --out p").finish();
    assert_eq!((controller.finish().code, plant.code), (Some(0), Some(0)));

    let drawn = command_line.run("plot c");
    assert_eq!(drawn.code, Some(0));
    assert!(
        drawn.stderr.starts_with("it holds no states of the plant (/truth): the robot is drawn where the controller")
    );
    for picture in ["footprints", "stick_walk", "balance_over_time"] {
        assert!(command_line.read(&format!("c/{picture}.svg")).contains("as the controller estimates"), "{picture}");
    }
    assert!(command_line.read("c/margin_over_time.svg").contains("<path"));
    let drawn = command_line.run("plot p");
    assert_eq!(drawn.code, Some(0));
    assert!(drawn.stderr.contains("give controller and plant the same --out"), "{}", drawn.stderr);
    assert!(drawn.stdout.contains("not drawn: zmp_over_time.svg: no report of the controller was recorded"));
    assert!(command_line.read("p/footprints.svg").contains("<path"));
    assert!(!command_line.folder().join("p/zmp_over_time.svg").exists());
    for folder in ["c", "p"] {
        assert!(command_line.read(&format!("{folder}/index.html")).contains("class=\"note\">it holds no "), "{folder}");
    }
    assert!(command_line.run("replay p").stderr.contains("has no controller.toml attached"));

    let whole = fs::read(command_line.folder().join("c/controller.mcap")).unwrap();
    // Schemas are in the first chunk, before the attachments.
    let begun = records(&whole[8..whole.len() - 8]);
    let events = 2 + begun.iter().skip(2).position(|(kind, _)| *kind == CHUNK).expect("a chunk of events");
    let until_events = 8 + bytes_of(&begun[..events]).len();
    for (name, length, code, says) in [
        ("empty.mcap", 0, 2, "empty.mcap: holds nothing of a run: it is empty\n"),
        ("short.mcap", 5, 2, "short.mcap: holds nothing of a run: it ends inside its first bytes\n"),
        (
            "begun.mcap",
            until_events + 100,
            2,
            "begun.mcap: holds nothing to draw, no report and no state: begun.mcap: \
          truncated, valid up to 0.000 s: it ends inside a chunk\n",
        ),
    ] {
        fs::write(command_line.folder().join(name), &whole[..length]).unwrap();
        let drawn = command_line.run(&format!("plot {name} --out none"));
        assert_eq!((drawn.code, drawn.stderr.as_str(), drawn.stdout.as_str()), (Some(code), says, ""));
        assert!(!command_line.folder().join("none").exists());
    }
    let replayed = command_line.run("replay begun.mcap");
    assert_eq!(replayed.code, Some(1));
    assert!(replayed.stdout.starts_with("nothing to compare: no setpoint was recorded\n"), "{}", replayed.stdout);
    assert_eq!(command_line.run("replay empty.mcap").code, Some(2));
}

/// Requests and replies have got fields since; what earlier versions recorded is still drawn and compared.
#[test]
fn recordings_of_earlier_versions_are_read() {
    let cases = repository().join("../shared/cases");
    if !cases.exists() {
        println!("NOT RUN: {} is not there", cases.display());
        return;
    }
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for file in ["20-attachments-at-the-end/rewritten.mcap", "21-compressed-recording/zstd.mcap"] {
        let file = cases.join(file);
        let drawn = command_line.run(&format!("plot {} --out pictures --force", file.display()));
        assert_eq!(drawn.code, Some(0), "{}", drawn.stderr);
        let replayed = command_line.run(&format!("replay {}", file.display()));
        assert!(replayed.stdout.starts_with("differs in tick 0"), "{}{}", replayed.stdout, replayed.stderr);
    }
}
