//! A tone by Web Audio (W3C): one oscillator and a gain, begun by the click that turns the sound on.

use std::cell::RefCell;

use lumen::app::{FOLLOW_S, SHAKE_MS, Tone};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{AudioContext, AudioContextState, AudioParam};

thread_local! {
    /// What plays, once something did.
    static PLAYER: RefCell<Option<Player>> = const { RefCell::new(None) };
}

/// What plays, for as long as the page lives.
struct Player {
    context: AudioContext,
    pitch: AudioParam,
    loudness: AudioParam,
}

impl Player {
    fn new() -> Result<Self, JsValue> {
        let context = AudioContext::new()?;
        let (oscillator, gain) = (context.create_oscillator()?, context.create_gain()?);
        let (pitch, loudness) = (oscillator.frequency(), gain.gain());
        loudness.set_value(0.0);
        oscillator.connect_with_audio_node(&gain)?.connect_with_audio_node(&context.destination())?;
        oscillator.start()?;
        Ok(Self { context, pitch, loudness })
    }

    /// It stands still until the page was clicked, and where the browser has put it to sleep.
    fn wake(&self) {
        if self.context.state() == AudioContextState::Suspended
            && let Ok(resumed) = self.context.resume()
        {
            spawn_local(async move {
                let _ = JsFuture::from(resumed).await;
            });
        }
    }

    fn play(&self, tone: Tone) -> Result<(), JsValue> {
        let now = self.context.current_time();
        self.loudness.cancel_scheduled_values(now)?;
        self.loudness.set_target_at_time(tone.loudness as f32, now, FOLLOW_S)?;
        if tone.loudness > 0.0 {
            self.pitch.cancel_scheduled_values(now)?;
            self.pitch.set_target_at_time(tone.pitch_hz as f32, now, FOLLOW_S)?;
            // A page that hangs renews nothing.
            self.loudness.set_target_at_time(0.0, now + SHAKE_MS / 1000.0, FOLLOW_S)?;
        }
        Ok(())
    }
}

/// Whether the browser has Web Audio.
pub(crate) fn is_there() -> bool {
    js_sys::Reflect::has(&js_sys::global(), &"AudioContext".into()).unwrap_or(false)
}

/// Sounds so until something else does, or for [`SHAKE_MS`].
pub(crate) fn play(tone: Tone) {
    PLAYER.with_borrow_mut(|player| {
        if player.is_none() {
            // Without a loudspeaker, or the memory for it, it stays silent.
            *player = Player::new().ok();
        }
        if let Some(player) = player {
            player.wake();
            // What cannot be scheduled is not heard.
            let _ = player.play(tone);
        }
    });
}

/// Ends what sounds at once; where nothing did, nothing begins.
pub(crate) fn end() {
    PLAYER.with_borrow(|player| {
        if let Some(player) = player {
            let _ = player.play(Tone { pitch_hz: 0.0, loudness: 0.0 });
        }
    });
}
