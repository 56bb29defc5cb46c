#![doc = include_str!("../README.md")]

use std::cell::RefCell;
use std::io;
use std::sync::Arc;

use bytemuck::{Pod, Zeroable, cast_slice, cast_slice_mut};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::ser::Formatter;

use lumen_message::messages;

messages! {
    /// A message that cannot be read.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum TransferError {
        /// The line is not one of ours.
        "errors-message" Line {
            /// What `serde_json` says.
            error: String,
        } => "the message is not understood: {error}",
        /// A buffer is missing.
        "errors-message-missing" Missing {
            /// Which.
            index: usize,
        } => "buffer {index} of the message is missing",
        /// A buffer has no whole number of elements.
        "errors-message-buffer" Buffer {
            /// Which.
            index: usize,
            /// Its length.
            bytes: usize,
            /// Bytes of an element.
            element: usize,
        } => "buffer {index} of the message has {bytes} bytes, not a multiple of {element}",
        /// There is no memory for a buffer.
        "errors-message-memory" Memory {
            /// Its length.
            bytes: usize,
        } => "there is no memory left for its {bytes} bytes",
        /// A buffer that should be text is not UTF-8.
        "errors-message-text" Text {
            /// Which.
            index: usize,
        } => "buffer {index} of the message is no text",
    }
}

impl From<serde_json::Error> for TransferError {
    fn from(error: serde_json::Error) -> Self {
        Self::Line { error: error.to_string() }
    }
}

/// What can cross.
pub trait Message: Serialize + DeserializeOwned {}

impl<T: Serialize + DeserializeOwned> Message for T {}

/// The buffers that came with a message.
pub trait Buffers {
    /// Length of buffer `index` in bytes; `None` where there is none.
    fn len(&self, index: usize) -> Option<usize>;

    /// Copies buffer `index` into `target`, which has its length.
    fn copy(&self, index: usize, target: &mut [u8]);
}

impl Buffers for Vec<Vec<u8>> {
    fn len(&self, index: usize) -> Option<usize> {
        self.get(index).map(Vec::len)
    }

    fn copy(&self, index: usize, target: &mut [u8]) {
        target.copy_from_slice(&self[index]);
    }
}

/// `message` as a line, and its buffers, each of which `copy` has made from an array.
///
/// # Errors
/// The first of `copy`.
pub fn encode<B, E>(
    message: &impl Message,
    mut copy: impl FnMut(&[u8]) -> Result<B, E>,
) -> Result<(String, Vec<B>), E> {
    let (mut line, mut buffers, mut failure) = (Vec::new(), Vec::new(), None);
    let beside = BufferFormatter(|array: &[u8]| {
        let buffer = copy(array).map_err(|error| failure = Some(error));
        buffers.push(buffer.map_err(|()| io::ErrorKind::Other)?);
        Ok(buffers.len() as u64 - 1)
    });
    let written = message.serialize(&mut serde_json::Serializer::with_formatter(&mut line, beside));
    match failure {
        Some(error) => Err(error),
        None => {
            written.expect("messages are plain data with string keys");
            Ok((String::from_utf8(line).expect("JSON is text"), buffers))
        }
    }
}

/// Writes JSON, and in place of bytes the number that it gets for them.
struct BufferFormatter<F>(F);

impl<F: FnMut(&[u8]) -> io::Result<u64>> Formatter for BufferFormatter<F> {
    fn write_byte_array<W: ?Sized + io::Write>(&mut self, line: &mut W, array: &[u8]) -> io::Result<()> {
        let index = (self.0)(array)?;
        self.write_u64(line, index)
    }
}

thread_local! {
    /// The message that this thread is reading: serde hands a field nothing but its own part of the line.
    static READING: RefCell<Option<Reading>> = const { RefCell::new(None) };
}

struct Reading {
    buffers: Box<dyn Buffers>,
    /// Why an array could not be read, which serde would turn into a sentence.
    failure: Option<TransferError>,
}

/// The message of a line and its buffers.
///
/// # Errors
/// When they are not what [`encode`] makes of such a message, or when there is no memory for an array.
pub fn decode<M: Message>(line: &str, buffers: impl Buffers + 'static) -> Result<M, TransferError> {
    READING.set(Some(Reading { buffers: Box::new(buffers), failure: None }));
    let message = serde_json::from_str(line);
    let failure = READING.take().and_then(|reading| reading.failure);
    message.map_err(|error| failure.unwrap_or_else(|| error.into()))
}

/// What crosses as a buffer.
pub trait Bulk: Sized {
    /// Its bytes.
    fn bytes(&self) -> &[u8];

    /// The reverse: buffer `index` of `buffers`.
    ///
    /// # Errors
    /// When there is no such buffer, or no memory for it.
    fn read(buffers: &dyn Buffers, index: usize) -> Result<Self, TransferError>;
}

impl<T: Pod + Zeroable> Bulk for Vec<T> {
    fn bytes(&self) -> &[u8] {
        cast_slice(self)
    }

    fn read(buffers: &dyn Buffers, index: usize) -> Result<Self, TransferError> {
        let element = size_of::<T>();
        let bytes = buffers.len(index);
        match bytes {
            Some(length) if length.is_multiple_of(element) => {
                let mut values = Self::new();
                values.try_reserve_exact(length / element).map_err(|_| TransferError::Memory { bytes: length })?;
                values.resize(length / element, T::zeroed());
                buffers.copy(index, cast_slice_mut(&mut values));
                Ok(values)
            }
            Some(bytes) => Err(TransferError::Buffer { index, bytes, element }),
            None => Err(TransferError::Missing { index }),
        }
    }
}

impl Bulk for String {
    fn bytes(&self) -> &[u8] {
        self.as_bytes()
    }

    fn read(buffers: &dyn Buffers, index: usize) -> Result<Self, TransferError> {
        Self::from_utf8(Vec::read(buffers, index)?).map_err(|_| TransferError::Text { index })
    }
}

impl<B: Bulk> Bulk for Arc<B> {
    fn bytes(&self) -> &[u8] {
        (**self).bytes()
    }

    fn read(buffers: &dyn Buffers, index: usize) -> Result<Self, TransferError> {
        B::read(buffers, index).map(Self::new)
    }
}

/// For fields that cross as a buffer.
pub mod bulk {
    use super::{Bulk, Deserialize, Deserializer, Serializer, arrived};

    /// Puts an array beside the line.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer>(array: &impl Bulk, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_bytes(array.bytes())
    }

    /// Takes an array from beside the line.
    ///
    /// # Errors
    /// When there is none, or no memory for it.
    pub fn deserialize<'de, B: Bulk, D: Deserializer<'de>>(from: D) -> Result<B, D::Error> {
        arrived(usize::deserialize(from)?)
    }
}

/// For fields that may hold what crosses as a buffer.
pub mod optional {
    use super::{Bulk, Deserialize, Deserializer, Serialize, Serializer, arrived, bulk};

    /// Puts an array beside the line, if there is one.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer>(array: &Option<impl Bulk>, to: S) -> Result<S::Ok, S::Error> {
        struct Carried<'a, B>(&'a B);
        impl<B: Bulk> Serialize for Carried<'_, B> {
            fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                bulk::serialize(self.0, to)
            }
        }
        array.as_ref().map(Carried).serialize(to)
    }

    /// Takes an array from beside the line, if there is one.
    ///
    /// # Errors
    /// When one is told of that is not there, or there is no memory for it.
    pub fn deserialize<'de, B: Bulk, D: Deserializer<'de>>(from: D) -> Result<Option<B>, D::Error> {
        Option::deserialize(from)?.map(arrived).transpose()
    }
}

/// Array `index` of the message that is being read.
fn arrived<B: Bulk, E: serde::de::Error>(index: usize) -> Result<B, E> {
    READING.with_borrow_mut(|reading| {
        let Some(reading) = reading else { return Err(E::custom("an array beside no message")) };
        B::read(&*reading.buffers, index).map_err(|error| {
            let sentence = E::custom(&error);
            reading.failure = Some(error);
            sentence
        })
    })
}

/// Sends `message` within this thread: its line, and what arrives. For tests of messages.
#[doc(hidden)]
pub fn sent<M: Message>(message: &M) -> (String, Result<M, TransferError>) {
    let Ok((line, buffers)) = encode(message, |array| Ok::<_, std::convert::Infallible>(array.to_vec()));
    let arrived = decode(&line, buffers);
    (line, arrived)
}

/// What the messages of this crate need of a translation.
pub const MESSAGES: &[&[lumen_message::Signature]] = &[TransferError::MESSAGES];

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Parcel {
        #[serde(with = "bulk")]
        numbers: Vec<u32>,
        #[serde(with = "optional")]
        places: Option<Vec<[f32; 3]>>,
        name: String,
        #[serde(with = "bulk")]
        text: Arc<String>,
    }

    fn parcel(places: Option<Vec<[f32; 3]>>) -> Parcel {
        Parcel { numbers: vec![1, u32::MAX], places, name: "a".into(), text: Arc::new("µ".into()) }
    }

    #[test]
    fn arrays_stand_in_the_line_as_numbers_of_buffers() {
        let (line, arrived) = sent(&parcel(Some(vec![[0.5; 3]; 2])));
        assert_eq!(line, r#"{"numbers":0,"places":1,"name":"a","text":2}"#);
        assert_eq!(arrived.unwrap(), parcel(Some(vec![[0.5; 3]; 2])));
        let (line, arrived) = sent(&parcel(None));
        assert_eq!(line, r#"{"numbers":0,"places":null,"name":"a","text":1}"#);
        assert_eq!(arrived.unwrap(), parcel(None));
    }

    #[test]
    fn a_copy_that_fails_is_told_as_it_is() {
        let copies = |array: &[u8]| if array.len() == 24 { Err("no memory") } else { Ok(()) };
        assert_eq!(encode(&parcel(Some(vec![[0.5; 3]; 2])), copies).unwrap_err(), "no memory");
        assert_eq!(encode(&parcel(None), copies).unwrap().1.len(), 2);
    }

    /// A buffer of any length that takes no memory.
    struct Claim(usize);

    impl Buffers for Claim {
        fn len(&self, _: usize) -> Option<usize> {
            Some(self.0)
        }

        fn copy(&self, _: usize, _: &mut [u8]) {
            unreachable!("there is no memory to copy into");
        }
    }

    const LINE: &str = r#"{"numbers":0,"places":null,"name":"a","text":1}"#;

    #[test]
    fn a_buffer_that_no_memory_can_hold_is_an_error() {
        let bytes = isize::MAX as usize / 8 * 4;
        let read = decode::<Parcel>(LINE, Claim(bytes));
        assert!(matches!(read, Err(TransferError::Memory { bytes: claimed }) if claimed == bytes), "{read:?}");
    }

    #[test]
    fn messages_of_others_are_refused() {
        let read = |line, buffers: Vec<Vec<u8>>| decode::<Parcel>(line, buffers).unwrap_err();
        assert!(matches!(read("{}", vec![]), TransferError::Line { .. }));
        assert!(matches!(read(LINE, vec![]), TransferError::Missing { index: 0 }));
        assert!(matches!(read(LINE, vec![vec![1; 7]]), TransferError::Buffer { bytes: 7, .. }));
        assert!(matches!(read(LINE, vec![vec![1; 8], vec![0xFF]]), TransferError::Text { index: 1 }));
        assert!(serde_json::from_str::<Parcel>(LINE).is_err(), "outside a message there are no arrays");
    }
}
