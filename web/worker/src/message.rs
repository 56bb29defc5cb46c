//! A message as a script's values: a line of JSON and any number of byte buffers. There is no shared memory: each buffer is
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
    let (line, buffers) = transfer::encode(message, |array| Ok::<_, JsValue>(bytes::copied(array)?.buffer()))?;
    let values = Array::of1(&JsValue::from_str(&line));
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
    /// What it is, as a line of JSON.
    line: String,
    buffers: Outside,
}

/// Buffers outside this instance's memory.
#[derive(Debug)]
struct Outside(Vec<Uint8Array>);

impl Received {
    /// The reverse of [`pack`]; `None` for anything else.
    pub fn unpack(value: &JsValue) -> Option<Self> {
        let values: &Array = value.dyn_ref()?;
        let line = values.get(0).as_string()?;
        let buffers = values.iter().skip(1).map(|buffer| bytes::view(&buffer).ok()).collect::<Option<_>>()?;
        Some(Self { line, buffers: Outside(buffers) })
    }

    /// What it is, as a line of JSON.
    pub fn line(&self) -> &str {
        &self.line
    }

    /// The message.
    ///
    /// # Errors
    ///
    /// When it is none such, or there is no memory left for it.
    pub fn read<M: Message>(self) -> Result<M, TransferError> {
        transfer::decode(&self.line, self.buffers)
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
