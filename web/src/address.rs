//! What the user asks for at the end of the page's address, after `?`.

use web_sys::UrlSearchParams;

/// What is asked of `name`, if anything is.
pub(crate) fn asked(name: &str) -> Option<String> {
    let search = web_sys::window()?.location().search().ok()?;
    UrlSearchParams::new_with_str(&search).ok()?.get(name)
}
