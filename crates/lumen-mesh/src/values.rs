//! Numbers of one type, one after another, as bytes: they keep the type that they were read in, and what only takes rows
//! along needs one code for all types.

use serde::{Deserialize, Serialize};

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Scalar {
    /// 8 bits with a sign.
    #[serde(rename = "int8")]
    I8,
    /// 8 bits without one.
    #[serde(rename = "uint8")]
    U8,
    /// 16 bits with a sign.
    #[serde(rename = "int16")]
    I16,
    /// 16 bits without one.
    #[serde(rename = "uint16")]
    U16,
    /// 32 bits with a sign.
    #[serde(rename = "int32")]
    I32,
    /// 32 bits without one.
    #[serde(rename = "uint32")]
    U32,
    /// 64 bits with a sign.
    #[serde(rename = "int64")]
    I64,
    /// 64 bits without one.
    #[serde(rename = "uint64")]
    U64,
    /// Single precision.
    #[serde(rename = "float32")]
    F32,
    /// Double precision.
    #[serde(rename = "float64")]
    F64,
}

impl Scalar {
    /// Bytes of a number.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// What VTK's XML formats call it.
    pub fn vtk_name(self) -> &'static str {
        match self {
            Self::I8 => "Int8",
            Self::U8 => "UInt8",
            Self::I16 => "Int16",
            Self::U16 => "UInt16",
            Self::I32 => "Int32",
            Self::U32 => "UInt32",
            Self::I64 => "Int64",
            Self::U64 => "UInt64",
            Self::F32 => "Float32",
            Self::F64 => "Float64",
        }
    }

    /// Whether it has whole numbers alone.
    pub fn is_whole(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }

    /// The type's name in reports: `int32`, `float64`.
    pub fn name(self) -> &'static str {
        match self {
            Self::I8 => "int8",
            Self::U8 => "uint8",
            Self::I16 => "int16",
            Self::U16 => "uint16",
            Self::I32 => "int32",
            Self::U32 => "uint32",
            Self::I64 => "int64",
            Self::U64 => "uint64",
            Self::F32 => "float32",
            Self::F64 => "float64",
        }
    }
}

/// Numbers of one type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Values {
    scalar: Scalar,
    /// Little-endian, one number after another.
    bytes: Vec<u8>,
}

impl Values {
    /// No numbers yet.
    pub fn new(scalar: Scalar) -> Self {
        Self { scalar, bytes: Vec::new() }
    }

    /// Numbers that stand in `bytes`, little-endian; what is left over behind the last whole one is dropped.
    pub fn from_bytes(scalar: Scalar, mut bytes: Vec<u8>) -> Self {
        bytes.truncate(bytes.len() / scalar.size() * scalar.size());
        Self { scalar, bytes }
    }

    /// These numbers, each as [`push`](Self::push) adds it.
    pub fn of(scalar: Scalar, numbers: impl IntoIterator<Item = f64>) -> Self {
        let (mut values, numbers) = (Self::new(scalar), numbers.into_iter());
        values.reserve(numbers.size_hint().0);
        numbers.for_each(|x| values.push(x));
        values
    }

    /// Single-precision numbers.
    pub fn from_floats(numbers: &[f32]) -> Self {
        Self { scalar: Scalar::F32, bytes: numbers.iter().flat_map(|x| x.to_le_bytes()).collect() }
    }

    /// Their type.
    pub fn scalar(&self) -> Scalar {
        self.scalar
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.bytes.len() / self.scalar.size()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    /// All of them, little-endian.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Number `i`; 64-bit whole ones beyond 2^53 are rounded.
    ///
    /// # Panics
    /// When there is none.
    pub fn get(&self, i: usize) -> f64 {
        let b = self.word(i).to_le_bytes();
        match self.scalar {
            Scalar::I8 => f64::from(b[0] as i8),
            Scalar::U8 => f64::from(b[0]),
            Scalar::I16 => f64::from(i16::from_le_bytes([b[0], b[1]])),
            Scalar::U16 => f64::from(u16::from_le_bytes([b[0], b[1]])),
            Scalar::I32 => f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Scalar::U32 => f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Scalar::I64 => i64::from_le_bytes(b) as f64,
            Scalar::U64 => u64::from_le_bytes(b) as f64,
            Scalar::F32 => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Scalar::F64 => f64::from_le_bytes(b),
        }
    }

    /// The bits of number `i`, with zeros above them: two numbers of a type are the same where these are.
    pub(super) fn word(&self, i: usize) -> u64 {
        let size = self.scalar.size();
        let mut word = [0; 8];
        word[..size].copy_from_slice(&self.bytes[i * size..(i + 1) * size]);
        u64::from_le_bytes(word)
    }

    /// Makes room for so many more.
    pub fn reserve(&mut self, numbers: usize) {
        self.bytes.reserve(numbers * self.scalar.size());
    }

    /// Adds a number, rounded to the type: whole ones to the nearest, within their range.
    pub fn push(&mut self, x: f64) {
        match self.scalar {
            Scalar::I8 => self.bytes.extend((x.round() as i8).to_le_bytes()),
            Scalar::U8 => self.bytes.extend((x.round() as u8).to_le_bytes()),
            Scalar::I16 => self.bytes.extend((x.round() as i16).to_le_bytes()),
            Scalar::U16 => self.bytes.extend((x.round() as u16).to_le_bytes()),
            Scalar::I32 => self.bytes.extend((x.round() as i32).to_le_bytes()),
            Scalar::U32 => self.bytes.extend((x.round() as u32).to_le_bytes()),
            Scalar::I64 => self.bytes.extend((x.round() as i64).to_le_bytes()),
            Scalar::U64 => self.bytes.extend((x.round() as u64).to_le_bytes()),
            Scalar::F32 => self.bytes.extend((x as f32).to_le_bytes()),
            Scalar::F64 => self.bytes.extend(x.to_le_bytes()),
        }
    }

    /// What `of` makes of each, by its place and its value, in the same type.
    #[must_use]
    pub fn mapped(&self, of: impl Fn(usize, f64) -> f64) -> Self {
        Self::of(self.scalar, (0..self.len()).map(|i| of(i, self.get(i))))
    }

    /// Adds the number that `word` is; whether it is one.
    pub fn push_word(&mut self, word: &str) -> bool {
        let whole = match self.scalar {
            Scalar::I64 => word.parse().ok().map(i64::to_le_bytes),
            Scalar::U64 => word.parse().ok().map(u64::to_le_bytes),
            Scalar::F32 => return word.parse::<f32>().map(|x| self.push(f64::from(x))).is_ok(),
            _ => None,
        };
        match whole {
            Some(bytes) => self.bytes.extend(bytes),
            None => return word.parse::<f64>().map(|x| self.push(x)).is_ok(),
        }
        true
    }

    /// Adds the `count` numbers of `other`, of the same type, from number `first` on, as they are.
    ///
    /// # Panics
    /// When there are not so many.
    pub fn push_from(&mut self, other: &Self, first: usize, count: usize) {
        let size = self.scalar.size();
        self.bytes.extend_from_slice(&other.bytes[first * size..(first + count) * size]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Scalar; 10] = [
        Scalar::I8,
        Scalar::U8,
        Scalar::I16,
        Scalar::U16,
        Scalar::I32,
        Scalar::U32,
        Scalar::I64,
        Scalar::U64,
        Scalar::F32,
        Scalar::F64,
    ];

    #[test]
    fn numbers_of_every_type_come_back_rounded_and_within_their_range() {
        for scalar in ALL {
            let numbers = Values::of(scalar, [0.0, 5.5, 127.0, -1.0]);
            let is_signed = !matches!(scalar, Scalar::U8 | Scalar::U16 | Scalar::U32 | Scalar::U64);
            let half = if scalar.is_whole() { 6.0 } else { 5.5 };
            let found: Vec<f64> = (0..numbers.len()).map(|i| numbers.get(i)).collect();
            assert_eq!(found, [0.0, half, 127.0, if is_signed { -1.0 } else { 0.0 }], "{scalar:?}");
            assert_eq!(numbers.bytes().len(), 4 * scalar.size());
            assert_eq!(serde_json::to_string(&scalar).unwrap(), format!("\"{}\"", scalar.name()));
        }
        assert_eq!(Values::from_bytes(Scalar::I32, vec![1, 0, 0, 0, 9]).get(0), 1.0);
    }

    #[test]
    fn words_are_numbers_to_the_last_bit() {
        for (scalar, word, bits) in [
            (Scalar::I64, "-9007199254740993", (-9_007_199_254_740_993i64) as u64),
            (Scalar::U64, "18446744073709551615", u64::MAX),
            (Scalar::F32, "0.1", u64::from(0.1f32.to_bits())),
            (Scalar::F64, "1e-3", 1e-3f64.to_bits()),
            (Scalar::I16, "7.0", 7),
        ] {
            let mut numbers = Values::new(scalar);
            assert!(numbers.push_word(word) && !numbers.push_word("seven"));
            assert_eq!((numbers.len(), numbers.word(0)), (1, bits), "{word}");
        }
    }
}
