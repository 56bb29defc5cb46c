//! Settings as a program says them, over the defaults: any part of what a settings file has under `settings`, or a setting by
//! the name that links and the command line have for it, such as `"pass-band": 0.01`.

use lumen_message::Value as Told;
use lumen_pipeline::settings::{Settings, table};
use serde_json::{Map, Value};
use wasm_bindgen::prelude::*;

use crate::refusal::{refusal, refused};

/// Reads settings from JSON.
///
/// # Errors
/// Where a field is unknown, of another kind than it has to be, or out of range.
pub(crate) fn read(json: &str) -> Result<Settings, JsValue> {
    let given: Map<String, Value> = serde_json::from_str(json).map_err(|why| unread(why.to_string()))?;
    let whole = serde_json::to_value(Settings::default()).map_err(|why| unread(why.to_string()))?;
    let (mut whole, mut named) = (whole, Vec::new());
    for (name, value) in given {
        match (table::find(&name), whole.get_mut(&name), value) {
            // `smoothing` and its like; a choice, which may be an object too, is replaced.
            (_, Some(Value::Object(fields)), Value::Object(part)) => fields.extend(part),
            (Some(setting), None, value) => named.push((setting, value)),
            (_, _, value) => whole[name] = value,
        }
    }
    let mut settings: Settings = serde_json::from_value(whole).map_err(|why| unread(why.to_string()))?;
    for (setting, value) in named {
        let text = match &value {
            Value::String(word) => word.to_lowercase(),
            Value::Bool(is_on) => table::Value::Switch(*is_on).to_string(),
            other => other.to_string(),
        };
        let cannot = |_| unread(format!("`{}` cannot be {value}", setting.key));
        setting.read(&mut settings, &text).map_err(cannot)?;
    }
    settings.check().map_err(|why| refusal(&why))?;
    Ok(settings)
}

/// The same error as of a settings file.
fn unread(why: String) -> JsValue {
    let english = format!("The settings cannot be read: {why}.");
    refused("app-settings-field", &[("why", Told::Text(why))], &english)
}
