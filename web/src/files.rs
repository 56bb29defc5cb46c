//! Files: opened through the browser's own dialog, saved as a download. Dropped files come through egui, what is in dropped
//! folders through `www/drop.js`.

use std::cell::RefCell;

use js_sys::Array;
use lumen::language::decimal;
use lumen::say;
use lumen_worker::bytes;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::{Blob, BlobPropertyBag, Document, File, HtmlAnchorElement, HtmlInputElement, Url, Window};

/// The largest file that is read, in bytes: with its mesh it has to fit into the 4 GB a page's memory can have.
const LARGEST: f64 = 1.5e9;

/// Bytes of a file that say what it is.
const HEAD: usize = 4096;

/// Bytes of a file that are copied at a time.
const PIECE: usize = 4 << 20;

thread_local! {
    static DIALOG: RefCell<Option<Dialog>> = const { RefCell::new(None) };
}

/// The hidden field that opens the dialog, and what listens to it. It stays in the page: some browsers open no dialog
/// for a field outside it, and forget one that nothing holds.
struct Dialog {
    input: HtmlInputElement,
    _changed: Closure<dyn Fn()>,
}

/// Lets the user choose files; call it while a click or a key press is being handled.
///
/// `accept` lists extensions (".stl,.ply"). `chosen` is called once, later, with one or more, unless the user thinks better of
/// it.
///
/// # Errors
///
/// What the browser answers when it makes no dialog.
pub(crate) fn open(accept: &str, chosen: impl FnOnce(Vec<File>) + 'static) -> Result<(), JsValue> {
    let document = page()?.1;
    let input: HtmlInputElement = document.create_element("input")?.unchecked_into();
    input.set_type("file");
    input.set_accept(accept);
    input.set_multiple(true);
    input.set_hidden(true);
    let chosen = RefCell::new(Some(chosen));
    let changed = Closure::<dyn Fn()>::new({
        let input = input.clone();
        move || {
            let list = input.files();
            let files: Vec<File> = list.iter().flat_map(|all| (0..all.length()).filter_map(|at| all.get(at))).collect();
            if !files.is_empty()
                && let Some(chosen) = chosen.take()
            {
                chosen(files);
            }
        }
    });
    input.set_onchange(Some(changed.as_ref().unchecked_ref()));
    document.body().ok_or("the page has no body")?.append_child(&input)?;
    DIALOG.with_borrow_mut(|dialog| {
        if let Some(last) = dialog.replace(Dialog { input: input.clone(), _changed: changed }) {
            last.input.remove();
        }
    });
    input.click();
    Ok(())
}

/// The folders and files that were dropped last, as the files in them; `None` where there was no folder.
///
/// # Errors
///
/// One plain sentence: a folder cannot be read.
pub(crate) async fn dropped_folders() -> Result<Option<Vec<File>>, String> {
    let lost = |_| say!("scan-folder-lost");
    let files = folders().await.map_err(lost)?;
    Ok(files.dyn_ref::<Array>().map(|files| files.iter().filter_map(|file| file.dyn_into().ok()).collect()))
}

#[wasm_bindgen]
extern "C" {
    // www/drop.js
    #[wasm_bindgen(js_namespace = lumenDrop, catch)]
    async fn folders() -> Result<JsValue, JsValue>;
}

/// The bytes of a surface's file, or one sentence on why not.
pub(crate) async fn read(file: &File) -> Result<Vec<u8>, String> {
    if file.size() > LARGEST {
        let (gb, limit) = (decimal(file.size() / 1e9, 1), decimal(LARGEST / 1e9, 1));
        return Err(say!("scan-file-large", name = file.name(), gb = gb, limit = limit));
    }
    read_up_to(file, file.size() as usize).await
}

/// The first bytes of a file, which say what it is, or one sentence on why not.
pub(crate) async fn head(file: &File) -> Result<Vec<u8>, String> {
    read_up_to(file, HEAD.min(file.size() as usize)).await
}

/// The first `length` bytes of a file. They are read in pieces, so that the copy of a large file does not hold up a frame.
async fn read_up_to(file: &File, length: usize) -> Result<Vec<u8>, String> {
    let name = file.name();
    let lost = |_| say!("scan-file-lost", name = &name);
    let full = |_| say!("scan-file-memory", name = &name, mb = decimal(file.size() / 1e6, 0));
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(length).map_err(|_| full(JsValue::NULL))?;
    while bytes.len() < length {
        let begin = bytes.len();
        let end = length.min(begin + PIECE);
        let piece = file.slice_with_f64_and_f64(begin as f64, end as f64).map_err(lost)?;
        let piece = JsFuture::from(piece.array_buffer())
            .await
            .map_err(|why| if is_memory(&why) { full(why) } else { lost(why) })?;
        let piece = bytes::view(&piece).map_err(full)?;
        if begin + piece.length() as usize != end {
            return Err(lost(JsValue::NULL));
        }
        bytes.resize(end, 0);
        piece.copy_to(&mut bytes[begin..]);
        bytes::give_back(&piece);
    }
    Ok(bytes)
}

/// Whether a browser says with this that it has no memory.
fn is_memory(why: &JsValue) -> bool {
    why.is_instance_of::<js_sys::RangeError>()
}

/// Gives the user `bytes` as a download called `name`.
///
/// # Errors
///
/// What the browser answers, when there is no memory left for the copy.
pub(crate) fn save(name: &str, bytes: &[u8]) -> Result<(), JsValue> {
    let (window, document) = page()?;
    let options = BlobPropertyBag::new();
    options.set_type("application/octet-stream");
    let parts = Array::of1(&bytes::copied(bytes)?.into());
    let blob = Blob::new_with_u8_array_sequence_and_options(&parts, &options)?;
    let address = Url::create_object_url_with_blob(&blob)?;
    let link: HtmlAnchorElement = document.create_element("a")?.unchecked_into();
    link.set_href(&address);
    link.set_download(name);
    link.click();

    // The download begins after the click has been handled; its copy of the file is let go a little later.
    let release = Closure::once_into_js(move || {
        // It fails only for an address that is none.
        let _ = Url::revoke_object_url(&address);
    });
    window.set_timeout_with_callback_and_timeout_and_arguments_0(release.unchecked_ref(), 10_000)?;
    Ok(())
}

fn page() -> Result<(Window, Document), JsValue> {
    let window = web_sys::window().ok_or("there is no page")?;
    let document = window.document().ok_or("there is no page")?;
    Ok((window, document))
}
