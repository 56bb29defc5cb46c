//! Gamepads, as the Gamepad API of the W3C has them: the left stick feeds, the right stick rolls, and the motors shake.

use js_sys::{Object, Promise, Reflect};
use lumen::app::{self, SHAKE_MS};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{Gamepad, GamepadButton};

/// Sticks rest a little off the middle.
const DEAD: f64 = 0.15;
/// Where the standard mapping has the shoulder buttons.
const SHOULDERS: [u32; 4] = [4, 5, 6, 7];

#[wasm_bindgen]
extern "C" {
    /// A gamepad's `vibrationActuator`: a `GamepadHapticActuator` of its own, as `web-sys` has the older one alone.
    type Motors;

    #[wasm_bindgen(method, catch, js_name = playEffect)]
    fn play_effect(this: &Motors, kind: &str, how: &Object) -> Result<Promise, JsValue>;

    #[wasm_bindgen(method, catch)]
    fn reset(this: &Motors) -> Result<Promise, JsValue>;
}

/// The first gamepad that is plugged in.
fn first() -> Option<Gamepad> {
    let pads = web_sys::window()?.navigator().get_gamepads().ok()?;
    pads.iter().find_map(|pad| pad.dyn_into().ok())
}

/// What it can be shaken by, where the browser has that.
fn motors(pad: &Gamepad) -> Option<Motors> {
    let motors = Reflect::get(pad.as_ref(), &"vibrationActuator".into()).ok()?;
    let can_play = motors.is_object() && Reflect::has(&motors, &"playEffect".into()).unwrap_or(false);
    can_play.then(|| motors.unchecked_into())
}

/// The state of the first gamepad that is plugged in.
pub(crate) fn read() -> Option<app::Gamepad> {
    let pad = first()?;
    let axis = |index: u32| {
        let value = pad.axes().get(index).as_f64().unwrap_or(0.0);
        if value.abs() < DEAD { 0.0 } else { value as f32 }
    };
    let is_held = |&index: &u32| {
        let button = pad.buttons().get(index).dyn_into::<GamepadButton>();
        button.is_ok_and(|button| button.pressed())
    };
    let (fast, can_rumble) = (SHOULDERS.iter().any(is_held), motors(&pad).is_some());
    Some(app::Gamepad { feed: -axis(1), roll: axis(2), fast, can_rumble })
}

/// Shakes it with a part of its strength, 0 to 1, for [`SHAKE_MS`]; 0 ends it at once.
pub(crate) fn shake(strength: f64) {
    let Some(motors) = first().as_ref().and_then(motors) else { return };
    let done = if strength > 0.0 {
        let how = Object::new();
        for (key, value) in [("duration", SHAKE_MS), ("strongMagnitude", strength), ("weakMagnitude", strength)] {
            // A plain object takes any entry.
            let _ = Reflect::set(&how, &key.into(), &value.into());
        }
        motors.play_effect("dual-rumble", &how)
    } else {
        motors.reset()
    };
    // A browser that does not do it has nothing that would have to end.
    if let Ok(done) = done {
        spawn_local(async move {
            let _ = JsFuture::from(done).await;
        });
    }
}
