#![doc = include_str!("../README.md")]

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use bytemuck::{Pod, Zeroable, cast_slice, cast_slice_mut};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use lumen_message::messages;

messages! {
    /// A message that cannot be read.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum TransferError {
        /// The head is not one of ours.
        "errors-message" Head {
            /// What `postcard` says.
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

/// `message` as its head, and its buffers, each of which `copy` has made from an array.
///
/// # Errors
/// The first of `copy`.
pub fn encode<B: 'static, E: 'static>(
    message: &impl Message,
    mut copy: impl FnMut(&[u8]) -> Result<B, E> + 'static,
) -> Result<(Vec<u8>, Vec<B>), E> {
    let copies = Rc::new(RefCell::new((Vec::new(), None)));
    WRITING.set(Some(Box::new({
        let copies = Rc::clone(&copies);
        move |array| {
            let (buffers, failure) = &mut *copies.borrow_mut();
            match copy(array) {
                Ok(buffer) => buffers.push(buffer),
                Err(error) => *failure = Some(error),
            }
            failure.is_none().then(|| buffers.len() - 1)
        }
    })));
    let head = postcard::to_allocvec(message);
    drop(WRITING.take());
    match copies.take() {
        (_, Some(error)) => Err(error),
        (buffers, None) => Ok((head.expect("messages are plain data"), buffers)),
    }
}

/// Copies an array; the number of its buffer, `None` where it cannot.
type Copy = dyn FnMut(&[u8]) -> Option<usize>;

thread_local! {
    /// What copies the arrays of the message that this thread is writing: serde hands a field nothing but a place in the head.
    static WRITING: RefCell<Option<Box<Copy>>> = const { RefCell::new(None) };
    /// The message that this thread is reading.
    static READING: RefCell<Option<Reading>> = const { RefCell::new(None) };
}

struct Reading {
    buffers: Box<dyn Buffers>,
    /// Why an array could not be read, which serde would turn into a sentence.
    failure: Option<TransferError>,
}

/// The message of a head and its buffers.
///
/// # Errors
/// When they are not what [`encode`] makes of such a message, or when there is no memory for an array.
pub fn decode<M: Message>(head: &[u8], buffers: impl Buffers + 'static) -> Result<M, TransferError> {
    READING.set(Some(Reading { buffers: Box::new(buffers), failure: None }));
    let message = postcard::from_bytes(head);
    let failure = READING.take().and_then(|reading| reading.failure);
    message.map_err(|error| failure.unwrap_or_else(|| TransferError::Head { error: error.to_string() }))
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
                let values = bytemuck::allocation::try_zeroed_slice_box::<T>(length / element);
                let mut values = values.map_err(|()| TransferError::Memory { bytes: length })?;
                buffers.copy(index, cast_slice_mut(&mut values));
                Ok(values.into_vec())
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
    use super::{Bulk, Deserialize, Deserializer, Serialize, Serializer, WRITING, arrived};

    /// Puts an array beside the head.
    ///
    /// # Errors
    /// Where no message is written, or the array cannot be copied; those of the serializer.
    pub fn serialize<S: Serializer>(array: &impl Bulk, to: S) -> Result<S::Ok, S::Error> {
        let copied = WRITING.with_borrow_mut(|writing| writing.as_mut().and_then(|copy| copy(array.bytes())));
        copied.ok_or_else(|| serde::ser::Error::custom("an array beside no message"))?.serialize(to)
    }

    /// Takes an array from beside the head.
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

    /// Puts an array beside the head, if there is one.
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

    /// Takes an array from beside the head, if there is one.
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

/// Sends `message` within this thread: its head, and what arrives. For tests of messages.
#[doc(hidden)]
pub fn sent<M: Message>(message: &M) -> (Vec<u8>, Result<M, TransferError>) {
    let Ok((head, buffers)) = encode(message, |array| Ok::<_, std::convert::Infallible>(array.to_vec()));
    let arrived = decode(&head, buffers);
    (head, arrived)
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
    fn arrays_stand_in_the_head_as_numbers_of_buffers() {
        // Numbers, that there is one, the length of the name and its letter: postcard's wire format.
        let (head, arrived) = sent(&parcel(Some(vec![[0.5; 3]; 2])));
        assert_eq!(head, [0, 1, 1, 1, b'a', 2]);
        assert_eq!(arrived.unwrap(), parcel(Some(vec![[0.5; 3]; 2])));
        let (head, arrived) = sent(&parcel(None));
        assert_eq!(head, HEAD);
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

    const HEAD: &[u8] = &[0, 0, 1, b'a', 1];

    #[test]
    fn a_buffer_that_no_memory_can_hold_is_an_error() {
        let bytes = isize::MAX as usize / 8 * 4;
        let read = decode::<Parcel>(HEAD, Claim(bytes));
        assert!(matches!(read, Err(TransferError::Memory { bytes: claimed }) if claimed == bytes), "{read:?}");
    }

    #[test]
    fn messages_of_others_are_refused() {
        let read = |head, buffers: Vec<Vec<u8>>| decode::<Parcel>(head, buffers).unwrap_err();
        assert!(matches!(read(&[], vec![]), TransferError::Head { .. }));
        assert!(matches!(read(HEAD, vec![]), TransferError::Missing { index: 0 }));
        assert!(matches!(read(HEAD, vec![vec![1; 7]]), TransferError::Buffer { bytes: 7, .. }));
        assert!(matches!(read(HEAD, vec![vec![1; 8], vec![0xFF]]), TransferError::Text { index: 1 }));
        assert!(postcard::from_bytes::<Parcel>(HEAD).is_err(), "outside a message there are no arrays");
        assert!(postcard::to_allocvec(&parcel(None)).is_err());
    }
}
