//! A device that the page opens in the Worker's place, where Workers have no WebHID: what it reports goes there as messages,
//! and what it is to be sent comes from there. All that is decided of it, the force and its end too, is decided there.

use lumen::haptics::force::Request;
use lumen::language::Key;
use wasm_bindgen_futures::spawn_local;

use super::Devices;
use super::relayer::Open;
use crate::hid::api::OnConnection;
use crate::hid::interfaces::{Interfaces, NO_TIMER, NOT_THERE};
use crate::hid::timers::Interval;
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
                self.0.turns.next(async move {
                    let is_turn = || devices.0.relayer.borrow().turn == turn;
                    // Else another was chosen meanwhile.
                    if is_turn()
                        && let Err(why) = devices.open_relay(&choice, number, turn).await
                        && is_turn()
                    {
                        devices.hand_on(number, Relayed::Ended(why.say()));
                    }
                });
            }
            Relay::Carry(request) => {
                let relayer = self.0.relayer.borrow();
                let (turn, device) = (relayer.turn, relayer.open.as_ref().map(|open| open.device.clone()));
                drop(relayer);
                let devices = self.clone();
                spawn_local(async move {
                    let answer = match device {
                        Some(device) => device.carry_out(&request).await,
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
        if let Some(Open { device, .. }) = relayer.open.take() {
            self.0.turns.next(async move { device.close(farewell).await });
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
            device.close(Vec::new()).await;
            return Ok(());
        }
        let (devices, gone) = (self.clone(), device.clone());
        let unplugged = OnConnection::new(&hid, "disconnect", move |interface| {
            if gone.have(&interface) {
                devices.hand_on(number, Relayed::Ended(NOT_THERE.say()));
            }
        });
        let devices = self.clone();
        let Ok(beat) = Interval::new(BEAT_MS, move || devices.hand_on(number, Relayed::Beat)) else {
            device.close(Vec::new()).await;
            return Err(NO_TIMER);
        };
        self.0.relayer.borrow_mut().open = Some(Open { device, _input: input, _unplugged: unplugged, _beat: beat });
        self.hand_on(number, Relayed::Opened(axes, force));
        Ok(())
    }

    fn hand_on(&self, number: u32, what: Relayed) {
        self.send(&Asked::Relayed(number, what));
    }
}
