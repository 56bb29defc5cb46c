//! Settings in words, for reports and comparisons.

use crate::language::{Message, exact, text};
use crate::pipeline::settings::Settings;
use crate::pipeline::settings::table::{self, Kind, Setting, Value};

/// What a list of settings says of the setting named `key`; `None` where there is nothing to say: a switch or a limit is
/// off, or the setting does not matter beside the others.
pub fn said(key: &str, settings: &Settings) -> Option<String> {
    say(table::find(key)?, settings)
}

/// What is to be said of the settings of a stage that are not among `known` and not as by default.
pub fn others<'a>(stage: &'a str, known: &'a [&str], settings: &'a Settings) -> impl Iterator<Item = String> + 'a {
    table::of(stage)
        .filter(|setting| !known.contains(&setting.key) && setting.value(settings) != setting.default())
        .filter_map(|setting| say(setting, settings))
}

fn say(setting: &Setting, settings: &Settings) -> Option<String> {
    let name = setting.messages.said;
    let value = setting.value(settings).filter(|_| !name.is_empty() && (setting.matters)(settings))?;
    let put = |value: crate::language::Value<'_>| {
        let mut message = Message::new(name);
        message.put("value", value);
        message.say()
    };
    match (value, &setting.kind) {
        (Value::Switch(is_on), _) => is_on.then(|| text(name)),
        (Value::Number(number), Kind::Limit { .. }) => Some(put(exact(number).into())),
        (Value::Number(number), _) => Some(put(number.into())),
        (Value::Name(name), _) => Some(put(name.into())),
        (Value::Pieces(_), _) => None,
    }
}
