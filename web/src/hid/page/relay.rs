//! A device that the page opens in the Worker's place, where Workers have no WebHID: what it reports goes there as messages,
//! and what it is to be sent comes from there. All that is decided of it, the force and its end too, is decided there.

use std::rc::Rc;

use lumen::haptics::force::Request;
use lumen::language::Key;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;

use super::Devices;
use super::relayer::{Beat, Open, Unplugged};
use crate::hid::api::HidConnectionEvent;
use crate::hid::interfaces::{Interfaces, NO_TIMER, NOT_THERE};
use crate::hid::{Answer, Asked, Choice, Relay, Relayed};

/// Between two times that the Worker is told that the page still hears its device, in ms.
const BEAT_MS: i32 = 40;

impl Devices {
    /// Does with a device what the Worker asks; `number` is what the Worker knows it by.
    pub(super) fn relay(&self, number: u32, relay: Relay) {
        match relay {
            Relay::Open(choice) => {
                let turn = self.end_relay(Vec::new());
                let devices = self.clone();
                spawn_local(async move {
                    let opened = devices.open_relay(&choice, number, turn).await;
                    if let Err(why) = opened
                        && devices.0.relayer.borrow().turn == turn
                    {
                        devices.hand_on(number, Relayed::Ended(why.say()));
                    }
                });
            }
            Relay::Carry(request) => {
                let relayer = self.0.relayer.borrow();
                let (turn, open) = (relayer.turn, relayer.open.clone());
                drop(relayer);
                let devices = self.clone();
                spawn_local(async move {
                    let answer = match open {
                        Some(open) => open.device.carry_out(&request).await,
                        None => Answer::Failed,
                    };
                    if devices.0.relayer.borrow().turn == turn {
                        devices.hand_on(number, Relayed::Answer(answer));
                    }
                });
            }
            Relay::Close(farewell) => _ = self.end_relay(farewell),
        }
    }

    /// Closes what is open, with these requests as its last, and counts on.
    pub(super) fn end_relay(&self, farewell: Vec<Request>) -> u32 {
        let mut relayer = self.0.relayer.borrow_mut();
        relayer.turn += 1;
        if let Some(open) = relayer.open.take() {
            spawn_local(async move { open.device.close(&farewell).await });
        }
        relayer.turn
    }

    async fn open_relay(&self, choice: &Choice, number: u32, turn: u32) -> Result<(), Key> {
        let hid = self.0.hid.clone().ok_or(NOT_THERE)?;
        let (device, (axes, force)) = Interfaces::find(&hid, &choice.identity()).await?;
        let devices = self.clone();
        let input = device
            .open(move |id, data| {
                let clock = web_sys::window().and_then(|window| window.performance());
                let at_ms = clock.map_or(0.0, |clock| clock.time_origin() + clock.now());
                devices.hand_on(number, Relayed::Input { at_ms, id, data });
            })
            .await?;
        if self.0.relayer.borrow().turn != turn {
            // Another was chosen meanwhile.
            device.close(&[]).await;
            return Ok(());
        }
        let (devices, gone) = (self.clone(), device.clone());
        let hear = Closure::<dyn Fn(HidConnectionEvent)>::new(move |event: HidConnectionEvent| {
            if gone.have(&event.device()) {
                devices.hand_on(number, Relayed::Ended(NOT_THERE.say()));
            }
        });
        // Where it cannot be heard, the next request that fails says it.
        let _ = hid.add_event_listener_with_callback("disconnect", hear.as_ref().unchecked_ref());
        let Some(beat) = self.beat(number) else {
            device.close(&[]).await;
            return Err(NO_TIMER);
        };
        let open = Open { device, _input: input, _unplugged: Unplugged { hid, hear }, _beat: beat };
        self.0.relayer.borrow_mut().open = Some(Rc::new(open));
        self.hand_on(number, Relayed::Opened(axes, force));
        Ok(())
    }

    fn beat(&self, number: u32) -> Option<Beat> {
        let (devices, window) = (self.clone(), web_sys::window()?);
        let say = Closure::<dyn Fn()>::new(move || devices.hand_on(number, Relayed::Beat));
        let callback = say.as_ref().unchecked_ref();
        let handle = window.set_interval_with_callback_and_timeout_and_arguments_0(callback, BEAT_MS).ok()?;
        Some(Beat { window, handle, _say: say })
    }

    fn hand_on(&self, number: u32, what: Relayed) {
        self.send(&Asked::Relayed(number, what));
    }
}
