//! Settings as a program says them, over the defaults: any part of what a settings file has under `settings`, or a setting by
//! the name that links and the command line have for it, such as `"pass-band": 0.01`. The target is said once.

use lumen_message::Value as Told;
use lumen_pipeline::settings::Settings;
use lumen_pipeline::settings::table::{self, Setting};
use serde_json::{Map, Value};
use wasm_bindgen::prelude::*;

use crate::refusal::{refusal, refused};

/// Reads settings from JSON.
///
/// # Errors
/// Where a field is unknown, of another kind than it has to be, or out of range.
pub(crate) fn read(json: &str) -> Result<Settings, JsValue> {
    let given: Map<String, Value> = serde_json::from_str(json).map_err(|why| unread(why.to_string()))?;
    let mut whole = serde_json::to_value(Settings::default()).map_err(|why| unread(why.to_string()))?;
    let (mut named, mut targets) = (Vec::new(), Vec::new());
    for (name, value) in given {
        let setting = table::find(&name);
        let is_target = name == "target" || setting.is_some_and(|setting| setting.field == "target");
        if is_target {
            targets.push(name.clone());
        }
        match (setting, whole.get_mut(&name), value) {
            // `smoothing` and its like; a choice, which may be an object too, is replaced.
            (_, Some(Value::Object(fields)), Value::Object(part)) => fields.extend(part),
            // `keep` is named alike in both: the settings file's words that no link has are read there.
            (Some(setting), there, value) if there.is_none() || is_by_name(setting, &value) => {
                named.push((setting, value));
            }
            (_, _, value) => whole[name] = value,
        }
    }
    if let [one, other, ..] = &targets[..] {
        return Err(unread(format!("`{one}` and `{other}` both say the target")));
    }
    let mut settings: Settings = serde_json::from_value(whole).map_err(|why| unread(why.to_string()))?;
    for (setting, value) in named {
        let cannot = |_| unread(format!("`{}` cannot be {value}", setting.key));
        setting.read(&mut settings, &text_of(&value)).map_err(cannot)?;
    }
    settings.check().map_err(|why| refusal(&why))?;
    Ok(settings)
}

/// A value as a link writes it.
fn text_of(value: &Value) -> String {
    match value {
        Value::String(word) => word.to_lowercase(),
        Value::Bool(is_on) => table::Value::Switch(*is_on).to_string(),
        other => other.to_string(),
    }
}

/// Whether the value is one that a link can say.
fn is_by_name(setting: &Setting, value: &Value) -> bool {
    setting.read(&mut Settings::default(), &text_of(value)).is_ok()
}

/// The same error as of a settings file.
fn unread(why: String) -> JsValue {
    let english = format!("The settings cannot be read: {why}.");
    refused("app-settings-field", &[("why", Told::Text(why))], &english)
}
