//! By what a file is known: SHA-256 of its bytes (FIPS 180-4), whole or its first sixteen hexadecimal digits.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

/// SHA-256 of a file. It is shown as 64 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Digest([u8; 32]);

impl Digest {
    /// The hash of a file's bytes.
    pub fn of(bytes: &[u8]) -> Self {
        let mut digesting = Digesting::default();
        digesting.add(bytes);
        digesting.digest()
    }

    /// Its first sixteen digits: as likely to be those of another file as a number of 64 bits that was drawn by lot.
    pub fn short(&self) -> ShortDigest {
        let [a, b, c, d, e, f, g, h, ..] = self.0;
        ShortDigest(u64::from_be_bytes([a, b, c, d, e, f, g, h]))
    }
}

/// A digest on its way: of a large file it takes seconds in a browser.
#[derive(Clone, Default)]
pub struct Digesting(Sha256);

impl Digesting {
    /// Takes the next bytes of the file.
    pub fn add(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    /// The hash of all of them.
    pub fn digest(self) -> Digest {
        Digest(self.0.finalize().into())
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

/// The first sixteen digits of a [`Digest`], and shown as such.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShortDigest(u64);

impl fmt::Display for ShortDigest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// These are not sixteen hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("not sixteen hexadecimal digits")]
pub struct NoDigest;

impl FromStr for ShortDigest {
    type Err = NoDigest;

    fn from_str(text: &str) -> Result<Self, NoDigest> {
        // `from_str_radix` takes a sign too.
        let is_plain = text.len() == 16 && text.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'a'..=b'f'));
        let number = is_plain.then(|| u64::from_str_radix(text, 16).ok()).flatten();
        number.map(Self).ok_or(NoDigest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_examples_of_the_standard_come_out() {
        // NIST's example values for SHA-256.
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(Digest::of(b"abc").to_string(), abc);
        assert_eq!(Digest::of(b"abc").short().to_string(), abc[..16]);
        let none = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        assert_eq!(Digest::of(b"").to_string(), none);
        let mut digesting = Digesting::default();
        b"abc".iter().for_each(|&byte| digesting.add(&[byte]));
        assert_eq!(digesting.digest().to_string(), abc);
    }

    #[test]
    fn sixteen_lower_case_digits_and_nothing_else_are_read_back() {
        let short = Digest::of(b"abc").short();
        assert_eq!(short.to_string().parse(), Ok(short));
        for wrong in
            ["", "ba7816bf8f01cfe", "ba7816bf8f01cfeaa", "BA7816BF8F01CFEA", "+a7816bf8f01cfea", "ä7816bf8f01cfe"]
        {
            assert_eq!(wrong.parse::<ShortDigest>(), Err(NoDigest), "{wrong}");
        }
    }
}
