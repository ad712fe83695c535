//! A number that distinguishes texts, the same everywhere: for names of folders that depend on what is in them.

/// The FNV-1a hash of a text.
pub(super) fn text_hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_does_not_depend_on_the_compiler() {
        assert_eq!(text_hash("foobar"), 0x8594_4171_f739_67e8);
    }
}
