//! Spoils files at random: what an editor, a disk, another program or a malicious person may do to them.

use rand::rngs::StdRng;
use rand::{Rng, seq::IndexedRandom};

/// Numbers that are none, or absurd.
const NUMBERS: [&str; 14] = [
    "0",
    "-0.0",
    "1",
    "-1",
    "1e300",
    "-1e300",
    "1e-300",
    "5e-324",
    "nan",
    "inf",
    "-inf",
    "1e999",
    "99999999999999999999",
    "0x7fffffff",
];
/// Texts that parsers stumble over.
const TEXTS: [&str; 16] =
    ["[[", "]]", "\"", "'''", "=", "#", "\r\n", "\0", "\u{feff}", "é", ",", "<a>", "</", "&lt;", "{", "}"];
/// Length of a bomb (bytes), which few cases are.
const BOMB: usize = 20 << 20;

/// The bytes with one to four changes.
pub(crate) fn spoilt(original: &[u8], random: &mut StdRng) -> Vec<u8> {
    let mut bytes = original.to_vec();
    if random.random_range(0..200) == 0 {
        return bomb(bytes, random);
    }
    for _ in 0..random.random_range(1..=4) {
        spoil(&mut bytes, random);
    }
    bytes
}

fn spoil(bytes: &mut Vec<u8>, random: &mut StdRng) {
    let place = random.random_range(0..=bytes.len());
    let end = (place + random.random_range(0..64)).min(bytes.len());
    match random.random_range(0..11) {
        0..=3 => another_number(bytes, place, random),
        4 => bytes.truncate(place),
        5 => drop(bytes.drain(place..end)),
        6 => {
            let copied = bytes[place..end].to_vec();
            let to = random.random_range(0..=bytes.len());
            bytes.splice(to..to, copied);
        }
        7 => drop(bytes.splice(place..place, TEXTS.choose(random).unwrap_or(&"").bytes())),
        8 => bytes[place..end].iter_mut().for_each(|byte| *byte ^= 1 << random.random_range(0..8)),
        9 => bytes[place..end].fill(if random.random() { 0 } else { 0xFF }),
        // A length or a count, in a binary file.
        _ => {
            let number: u64 = *[0, 1, 255, 1 << 20, 1 << 30, 1 << 40, u64::MAX].choose(random).unwrap_or(&0);
            let end = (place + 8).min(bytes.len());
            bytes[place..end].copy_from_slice(&number.to_le_bytes()[..end - place]);
        }
    }
}

/// Replaces the number at or after a place; eight bytes where there is none, as in a binary file.
fn another_number(bytes: &mut Vec<u8>, place: usize, random: &mut StdRng) {
    let is_number = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+' | b'e');
    let from = bytes[place..].iter().take(200).position(|byte| byte.is_ascii_digit()).map(|at| place + at);
    match from {
        Some(from) => {
            let length = bytes[from..].iter().take_while(|byte| is_number(byte)).count();
            let number = NUMBERS.choose(random).unwrap_or(&"0");
            bytes.splice(from..from + length, number.bytes());
        }
        None => {
            let numbers = [f64::NAN, f64::INFINITY, 1e308, -1e300, 5e-324, 0.0, f64::from_bits(random.random())];
            let end = (place + 8).min(bytes.len());
            let number = numbers.choose(random).unwrap_or(&0.0).to_le_bytes();
            bytes[place..end].copy_from_slice(&number[..end - place]);
        }
    }
}

/// A piece of the file again and again, or something nested without end.
fn bomb(bytes: Vec<u8>, random: &mut StdRng) -> Vec<u8> {
    let place = random.random_range(0..=bytes.len());
    let piece = match random.random_range(0..4) {
        0 => b"[".to_vec(),
        1 => b"<a>".to_vec(),
        2 => b"\n[[push]]\n".to_vec(),
        _ => bytes[place..(place + 200).min(bytes.len())].to_vec(),
    };
    let many = BOMB.checked_div(piece.len()).unwrap_or(0);
    let (before, after) = bytes.split_at(place);
    [before, &piece.repeat(many), after].concat()
}
