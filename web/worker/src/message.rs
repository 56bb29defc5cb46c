//! A message as a script's values: its head and any number of byte buffers. There is no shared memory: each buffer is
//! copied once out of the sender's memory, transferred, and copied once into the receiver's.

use js_sys::{Array, Uint8Array};
use lumen::transfer::{self, Buffers, Message, TransferError};
use wasm_bindgen::prelude::*;

use crate::bytes;

/// A message as a script value, and the list of what is to be transferred rather than copied again.
///
/// # Errors
///
/// When the browser has no memory left for the copies.
pub fn pack(message: &impl Message) -> Result<(Array, Array), JsValue> {
    let (head, buffers) = transfer::encode(message, |array| Ok::<_, JsValue>(bytes::copied(array)?.buffer()))?;
    let values = Array::of1(&bytes::copied(&head)?.buffer());
    let transfer = Array::new();
    for buffer in buffers {
        values.push(&buffer);
        transfer.push(&buffer);
    }
    Ok((values, transfer))
}

/// A message that has arrived; its buffers are still outside this instance's memory.
#[derive(Debug)]
pub struct Received {
    /// What it is.
    head: Vec<u8>,
    buffers: Outside,
}

/// Buffers outside this instance's memory.
#[derive(Debug)]
struct Outside(Vec<Uint8Array>);

impl Received {
    /// The reverse of [`pack`]; `None` for anything else.
    pub fn unpack(value: &JsValue) -> Option<Self> {
        let values: &Array = value.dyn_ref()?;
        let head = bytes::view(&values.get(0)).ok()?.to_vec();
        let buffers = values.iter().skip(1).map(|buffer| bytes::view(&buffer).ok()).collect::<Option<_>>()?;
        Some(Self { head, buffers: Outside(buffers) })
    }

    /// What it is, without its buffers.
    pub fn head(&self) -> &[u8] {
        &self.head
    }

    /// The message.
    ///
    /// # Errors
    ///
    /// When it is none such, or there is no memory left for it.
    pub fn read<M: Message>(self) -> Result<M, TransferError> {
        transfer::decode(&self.head, self.buffers)
    }
}

impl Drop for Outside {
    fn drop(&mut self) {
        self.0.iter().for_each(bytes::give_back);
    }
}

impl Buffers for Outside {
    fn len(&self, index: usize) -> Option<usize> {
        self.0.get(index).map(|buffer| buffer.length() as usize)
    }

    fn copy(&self, index: usize, target: &mut [u8]) {
        self.0[index].copy_to(target);
    }
}
