//! The files that the page has handed over. They are read here, piece by piece, so that the page's own memory never holds a
//! scan; the browser has them on the disk.

use std::cell::RefCell;
use std::rc::Rc;

use js_sys::{Array, Uint8Array};
use lumen::engine::scan::Shelf;
use lumen::language::Key;
use wasm_bindgen::prelude::*;
use web_sys::{File, FileReaderSync};

const GONE: Key = Key("scan-part-gone");
const FULL: Key = Key("scan-part-memory");

/// The files that were handed over, by their numbers; clones share them.
#[derive(Clone)]
pub(crate) struct Handed {
    files: Rc<RefCell<Vec<(u32, File)>>>,
    reader: FileReaderSync,
}

impl Handed {
    /// No files yet.
    ///
    /// # Errors
    ///
    /// Where this is no Worker: a page has no such reader.
    pub(crate) fn new() -> Result<Self, JsValue> {
        Ok(Self { files: Rc::default(), reader: FileReaderSync::new()? })
    }

    /// Takes the files of a message, the number of the first before them; whether it is such a message.
    pub(crate) fn take(&self, data: &JsValue) -> bool {
        let Some((values, first)) = data.dyn_ref::<Array>().and_then(|all| Some((all, all.get(0).as_f64()?))) else {
            return false;
        };
        let files = values.iter().skip(1).filter_map(|file| file.dyn_into().ok());
        self.files.borrow_mut().extend((first as u32..).zip(files));
        true
    }
}

impl Shelf for Handed {
    fn read(&mut self, number: u32, begin: u64, target: &mut [u8]) -> Result<(), String> {
        let files = self.files.borrow();
        let (_, file) = files.iter().find(|(known, _)| *known == number).ok_or_else(|| GONE.say())?;
        let end = begin as f64 + target.len() as f64;
        let piece = file.slice_with_f64_and_f64(begin as f64, end).map_err(|_| GONE.say())?;
        let bytes = self.reader.read_as_array_buffer(&piece).map_err(|why| {
            let is_full = why.is_instance_of::<js_sys::RangeError>();
            if is_full { FULL.say() } else { GONE.say() }
        })?;
        let bytes = Uint8Array::new(&bytes);
        if bytes.length() as usize != target.len() {
            return Err(GONE.say());
        }
        bytes.copy_to(target);
        Ok(())
    }

    fn forget_before(&mut self, number: u32) {
        self.files.borrow_mut().retain(|(known, _)| *known >= number);
    }
}
