//! Checksums: names for what was learned, and ties between files.

use sha2::{Digest, Sha256};

/// SHA-256 of the bytes, 64 lower-case hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

/// The first 16 hexadecimal digits of the SHA-256 of the numbers' little-endian bytes.
pub fn short_hash(numbers: impl Iterator<Item = f32>) -> String {
    let mut hash = Sha256::new();
    numbers.for_each(|v| hash.update(v.to_le_bytes()));
    hex(&hash.finalize())[..16].to_owned()
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FIPS 180-4 example.
    #[test]
    fn abc_has_the_published_checksum() {
        assert_eq!(sha256(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}
