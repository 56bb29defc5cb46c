//! Errors as data for JavaScript: an identifier, values and plain English, as JSON in a string that is thrown. `index.js` makes
//! a `LumenError` of it.

use lumen_message::{Message, Value};
use serde_json::{Map, json};
use wasm_bindgen::prelude::*;

/// What is thrown for an error of Lumen's own.
pub(crate) fn refusal(why: &impl Message) -> JsValue {
    refused(why.id(), &why.values(), &why.to_string())
}

/// What is thrown for an error that is known by its identifier alone.
pub(crate) fn refused(id: &str, values: &[(&str, Value)], english: &str) -> JsValue {
    JsValue::from_str(&told(id, values, english).to_string())
}

fn told(id: &str, values: &[(&str, Value)], english: &str) -> serde_json::Value {
    let values: Map<_, _> = values.iter().map(|(name, value)| ((*name).to_owned(), plain(value))).collect();
    json!({ "id": id, "values": values, "message": english })
}

/// A value without the way in which it is written.
fn plain(value: &Value) -> serde_json::Value {
    match value {
        Value::Text(text) => json!(text),
        Value::Count(count) => json!(count),
        Value::Number { value, .. } | Value::Change { value, .. } => json!(value),
        Value::Message(message) => told(message.id(), &message.values(), &message.to_string()),
    }
}

/// A panic ends the module in a trap, which says nothing; the Worker tells what the panic said before.
pub(crate) fn tell_panics() {
    std::panic::set_hook(Box::new(|info| last_words(&info.to_string())));
}

#[wasm_bindgen]
extern "C" {
    // The Worker has it among its globals.
    #[wasm_bindgen(js_name = lumenLastWords)]
    fn last_words(words: &str);
}
