//! The same device by a serial port over USB, for browsers without human interface devices: the reports in frames, each a
//! packet of its own. The port's speed means nothing.
//!
//! The host says with the line "data terminal ready" that it listens; where it takes that back it has left, and the motors
//! let go.

use core::cell::Cell;

use embassy_executor::Spawner;
use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::ThreadModeRawMutex;
use embassy_sync::channel::Channel;
use embassy_usb::Builder;
use embassy_usb::class::cdc_acm::{CdcAcmClass, ControlChanged, Receiver, Sender, State};
use lumen_feeder::framing::FRAME;
use lumen_feeder::serial::{Line, input};
use lumen_feeder::turn;
use static_cell::StaticCell;

use crate::usb::Bus;
use crate::{DEVICE, Shared};

/// Bytes of a packet, more than those of any frame.
const PACKET: u16 = 64;

/// A frame and its length.
type Packed = ([u8; FRAME], usize);

/// Frames to be sent. Answers wait for their place; what the host is too slow for of the rest is dropped.
static QUEUE: Channel<ThreadModeRawMutex, Packed, 4> = Channel::new();
/// Whether a host listens.
static IS_OPEN: Shared<Cell<bool>> = Mutex::new(Cell::new(false));
/// What the host was last told of what plays.
static TOLD: Shared<Cell<[u8; 2]>> = Mutex::new(Cell::new([0; 2]));

/// Adds the port to the device.
pub(crate) fn start(spawner: Spawner, builder: &mut Builder<'static, Bus>) {
    static STATE: StaticCell<State<'static>> = StaticCell::new();
    let class = CdcAcmClass::new(builder, STATE.init(State::new()), PACKET);
    let (sender, receiver, control) = class.split_with_control();
    spawner.spawn(read(receiver).expect("it is spawned once"));
    spawner.spawn(write(sender).expect("it is spawned once"));
    spawner.spawn(listen(control).expect("it is spawned once"));
}

/// Sends the state where a host listens, and what plays if that has changed.
pub(crate) fn tell(state: &[u8], playing: [u8; 2]) {
    if !IS_OPEN.lock(Cell::get) {
        return;
    }
    send(state);
    if TOLD.lock(Cell::get) != playing && send(&playing) {
        TOLD.lock(|told| told.set(playing));
    }
}

/// Whether there was room for it.
fn send(report: &[u8]) -> bool {
    let mut frame = [0; FRAME];
    let length = input(report, &mut frame);
    QUEUE.try_send((frame, length)).is_ok()
}

#[embassy_executor::task]
async fn read(mut receiver: Receiver<'static, Bus>) {
    let mut packet = [0; PACKET as usize];
    loop {
        receiver.wait_connection().await;
        // What a host before it has begun ends here.
        let mut line = Line::new();
        while let Ok(length) = receiver.read_packet(&mut packet).await {
            for &byte in &packet[..length] {
                let mut answer = [0; FRAME];
                let length = DEVICE.lock(|device| line.take(byte, &mut device.borrow_mut(), &mut answer));
                if length > 0 {
                    QUEUE.send((answer, length)).await;
                }
            }
        }
    }
}

#[embassy_executor::task]
async fn write(mut sender: Sender<'static, Bus>) {
    loop {
        sender.wait_connection().await;
        let (frame, length) = QUEUE.receive().await;
        // A host that is gone has nothing to be told.
        let _ = sender.write_packet(&frame[..length]).await;
    }
}

#[embassy_executor::task]
async fn listen(control: ControlChanged<'static>) {
    loop {
        control.control_changed().await;
        let is_open = control.dtr();
        let was_open = IS_OPEN.lock(|open| open.replace(is_open));
        if is_open && !was_open {
            // One that has just come hears all of it, and nothing of before.
            while QUEUE.try_receive().is_ok() {}
            TOLD.lock(|told| told.set([0; 2]));
        } else if was_open && !is_open {
            DEVICE.lock(|device| device.borrow_mut().leaves(turn::Line::Serial));
        }
    }
}
