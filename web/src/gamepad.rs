//! Gamepads, as the Gamepad API of the W3C has them: the left stick feeds, the right stick rolls.

use lumen::app;
use wasm_bindgen::JsCast as _;
use web_sys::{Gamepad, GamepadButton};

/// Sticks rest a little off the middle.
const DEAD: f64 = 0.15;
/// Where the standard mapping has the shoulder buttons.
const SHOULDERS: [u32; 4] = [4, 5, 6, 7];

/// The state of the first gamepad that is plugged in.
pub(crate) fn read() -> Option<app::Gamepad> {
    let pads = web_sys::window()?.navigator().get_gamepads().ok()?;
    let pad: Gamepad = pads.iter().find_map(|pad| pad.dyn_into().ok())?;
    let axis = |index: u32| {
        let value = pad.axes().get(index).as_f64().unwrap_or(0.0);
        if value.abs() < DEAD { 0.0 } else { value as f32 }
    };
    let is_held = |&index: &u32| {
        let button = pad.buttons().get(index).dyn_into::<GamepadButton>();
        button.is_ok_and(|button| button.pressed())
    };
    Some(app::Gamepad { feed: -axis(1), roll: axis(2), fast: SHOULDERS.iter().any(is_held) })
}
