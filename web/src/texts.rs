//! The messages of other languages than English, which a first visit goes without: `lumen-de.ftl` and its like, which the build
//! puts together (`xtask/src/build.rs`). All are fetched right after the first picture, so that no request depends on what
//! a user chooses; one that is wanted before that, or was not to be had then, is fetched at once.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use js_sys::{Function, Object, Promise, Reflect};
use lumen::language::Language;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};

use crate::worker::beside_page;

/// Waits for the messages of a language.
type Take = Box<dyn Fn(Result<String, String>)>;

/// How far the messages of a language are.
enum Texts {
    Coming(Vec<Take>),
    There(String),
}

/// The messages by the languages' tags; clones share them.
#[derive(Clone, Default)]
pub(crate) struct AllTexts(Rc<RefCell<BTreeMap<&'static str, Texts>>>);

impl AllTexts {
    /// Fetches those of all languages. What cannot be had now is asked for again once it is wanted.
    pub(crate) fn fetch_all(&self) {
        for language in Language::ALL.into_iter().filter(|&language| language != Language::English) {
            self.want(language, Box::new(|_| {}));
        }
    }

    /// Gives the messages of `language` to `take`, or why they are not to be had; now or later. They are fetched once.
    pub(crate) fn want(&self, language: Language, take: Take) {
        let tag = language.tag();
        let mut all = self.0.borrow_mut();
        match all.get_mut(tag) {
            Some(Texts::Coming(takers)) => takers.push(take),
            Some(Texts::There(texts)) => {
                let texts = texts.clone();
                drop(all);
                take(Ok(texts));
            }
            None => {
                all.insert(tag, Texts::Coming(vec![take]));
                self.clone().fetch(tag);
            }
        }
    }

    fn fetch(self, tag: &'static str) {
        spawn_local(async move {
            let fetched = download(&format!("lumen-{tag}.ftl")).await.map_err(|error| words(&error));
            let before = match &fetched {
                Ok(texts) => self.0.borrow_mut().insert(tag, Texts::There(texts.clone())),
                Err(_) => self.0.borrow_mut().remove(tag),
            };
            if let Some(Texts::Coming(takers)) = before {
                takers.iter().for_each(|take| take(fetched.clone()));
            }
        });
    }
}

/// The text of a file of this build.
async fn download(name: &str) -> Result<String, JsValue> {
    let window = web_sys::window().ok_or("there is no page")?;
    let response = JsFuture::from(window.fetch_with_str(&beside_page(name)?)).await?;
    if Reflect::get(&response, &"ok".into())? != JsValue::TRUE {
        return Err(Reflect::get(&response, &"status".into())?);
    }
    let text: Function = Reflect::get(&response, &"text".into())?.dyn_into()?;
    let text: Promise = text.call0(&response)?.dyn_into()?;
    JsFuture::from(text).await?.as_string().ok_or_else(|| "it is no text".into())
}

/// What a script has thrown, or the status of an answer.
fn words(error: &JsValue) -> String {
    let plain = error.as_string().or_else(|| error.as_f64().map(|status| status.to_string()));
    plain.unwrap_or_else(|| String::from(Object::from(error.clone()).to_string()))
}
