//! The numbers of a volume, in the type that they are stored in: a scan of 512 x 512 x 800 points at 16 bit stays 420 MB.

/// One number of a volume.
pub(crate) trait Sample: Copy + PartialOrd {
    /// As a number that every type fits into.
    fn to_f64(self) -> f64;
}

macro_rules! sample_types {
    ($($variant:ident $type:ty, $name:literal;)*) => {
        /// The type that numbers are stored in.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum SampleType {
            $(#[doc = $name] $variant,)*
        }

        impl SampleType {
            /// Bytes of a number.
            pub fn size(self) -> usize {
                match self {
                    $(Self::$variant => size_of::<$type>(),)*
                }
            }

            /// What it is called.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }
        }

        /// The numbers of a volume, i running fastest, then j, then k.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Samples {
            $(#[doc = $name] $variant(Vec<$type>),)*
        }

        impl Samples {
            /// None yet.
            pub fn new(sample_type: SampleType) -> Self {
                match sample_type {
                    $(SampleType::$variant => Self::$variant(Vec::new()),)*
                }
            }

            /// Adds the numbers that `bytes` are, whole ones, in the one byte order or the other.
            pub fn extend_from_bytes(&mut self, bytes: &[u8], is_big_endian: bool) {
                match self {
                    $(Self::$variant(values) => {
                        let words = bytes.as_chunks::<{ size_of::<$type>() }>().0.iter();
                        if is_big_endian {
                            values.extend(words.map(|&word| <$type>::from_be_bytes(word)));
                        } else {
                            values.extend(words.map(|&word| <$type>::from_le_bytes(word)));
                        }
                    })*
                }
            }

            /// Adds a number, cut to a whole one and clamped where the type needs that.
            pub fn push(&mut self, value: f64) {
                match self {
                    $(Self::$variant(values) => values.push(value as $type),)*
                }
            }
        }

        $(impl Sample for $type {
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
        })*
    };
}

sample_types! {
    I8 i8, "8-bit signed";
    U8 u8, "8-bit unsigned";
    I16 i16, "16-bit signed";
    U16 u16, "16-bit unsigned";
    I32 i32, "32-bit signed";
    U32 u32, "32-bit unsigned";
    F32 f32, "32-bit float";
    F64 f64, "64-bit float";
}

/// Does the same with the numbers of any type.
macro_rules! with_samples {
    ($samples:expr, $values:ident => $body:expr) => {
        match $samples {
            $crate::Samples::I8($values) => $body,
            $crate::Samples::U8($values) => $body,
            $crate::Samples::I16($values) => $body,
            $crate::Samples::U16($values) => $body,
            $crate::Samples::I32($values) => $body,
            $crate::Samples::U32($values) => $body,
            $crate::Samples::F32($values) => $body,
            $crate::Samples::F64($values) => $body,
        }
    };
}
pub(crate) use with_samples;

impl Samples {
    /// How many there are.
    pub fn len(&self) -> usize {
        with_samples!(self, values => values.len())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Their type.
    pub fn sample_type(&self) -> SampleType {
        match self {
            Self::I8(_) => SampleType::I8,
            Self::U8(_) => SampleType::U8,
            Self::I16(_) => SampleType::I16,
            Self::U16(_) => SampleType::U16,
            Self::I32(_) => SampleType::I32,
            Self::U32(_) => SampleType::U32,
            Self::F32(_) => SampleType::F32,
            Self::F64(_) => SampleType::F64,
        }
    }

    /// Number `index`, as it is stored.
    pub fn stored(&self, index: usize) -> f64 {
        with_samples!(self, values => values[index].to_f64())
    }

    /// Makes room for `more` numbers, and for none beyond.
    ///
    /// # Errors
    /// When there is no memory for them.
    pub fn try_reserve(&mut self, more: usize) -> Result<(), std::collections::TryReserveError> {
        with_samples!(self, values => values.try_reserve_exact(more))
    }

    /// How many there is room for.
    pub fn capacity(&self) -> usize {
        with_samples!(self, values => values.capacity())
    }
}
