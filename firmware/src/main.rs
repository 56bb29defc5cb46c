//! The open feeder on an RP2040: pins, timers and USB. What it does with them is `lumen-feeder`, which runs anywhere.
//!
//! | task | when | what |
//! |---|---|---|
//! | [`follow_feed`], [`follow_roll`] | a word of samples | lines to counts |
//! | [`control`] | every ms | counts to motors and to the next input report |
//! | `main` | USB | reports in and out |
//!
//! All share one executor in thread mode; no task works for longer than the 0.6 ms for which samples wait.

#![no_std]
#![no_main]

mod board;
mod usb;

use core::cell::{Cell, RefCell};

use embassy_executor::Spawner;
use embassy_rp::Peri;
use embassy_rp::gpio::{Input, Level, Output, Pull};
use embassy_rp::peripherals::{PIO0, WATCHDOG};
use embassy_rp::pio::{self, StateMachine};
use embassy_rp::pwm::Pwm;
use embassy_rp::watchdog::Watchdog;
use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::ThreadModeRawMutex;
use embassy_sync::signal::Signal;
use embassy_time::{Duration, Ticker};
use lumen_feeder::device::{Device, Seen};
use lumen_feeder::quadrature::{Decoder, Steps};
use panic_halt as _;

embassy_rp::bind_interrupts!(struct Interrupts {
    PIO0_IRQ_0 => pio::InterruptHandler<PIO0>;
    USBCTRL_IRQ => embassy_rp::usb::InterruptHandler<embassy_rp::peripherals::USB>;
});

/// A value of the tasks', one at a time.
type Shared<T> = Mutex<ThreadModeRawMutex, T>;

/// What is sent to the host: the state, and what plays.
type Reports = ([u8; 6], [u8; 2]);

/// ms after which the chip starts anew, with its pins let go, if [`control`] has not run.
const STUCK_MS: u64 = 20;

static DEVICE: Shared<RefCell<Device>> = Mutex::new(RefCell::new(Device::new()));
static STEPS: [Shared<Cell<Steps>>; 2] = [const { Mutex::new(Cell::new(Steps { counts: 0, missed: 0 })) }; 2];
static REPORTS: Signal<ThreadModeRawMutex, Reports> = Signal::new();

/// What the control has its hands on.
struct Hardware {
    /// Of feed and roll.
    motors: [Pwm<'static>; 2],
    clutch: Input<'static>,
    centre: Input<'static>,
    power: Input<'static>,
    fault: Input<'static>,
    driver: Output<'static>,
    light: Output<'static>,
    watchdog: Peri<'static, WATCHDOG>,
}

#[embassy_executor::main]
async fn main(spawner: Spawner) {
    let p = embassy_rp::init(embassy_rp::config::Config::default());
    let [feed, roll] = board::motor_timer(&Default::default());
    // The numbers of the pins are those of `docs/haptic-device.md`.
    let hardware = Hardware {
        motors: [
            Pwm::new_output_ab(p.PWM_SLICE0, p.PIN_16, p.PIN_17, feed),
            Pwm::new_output_ab(p.PWM_SLICE1, p.PIN_18, p.PIN_19, roll),
        ],
        clutch: Input::new(p.PIN_6, Pull::Up),
        centre: Input::new(p.PIN_7, Pull::Up),
        power: Input::new(p.PIN_22, Pull::Down),
        fault: Input::new(p.PIN_21, Pull::Up),
        driver: Output::new(p.PIN_20, Level::Low),
        light: Output::new(p.PIN_25, Level::Low),
        watchdog: p.WATCHDOG,
    };
    let [feed, roll] = board::encoders(p.PIO0, [(p.PIN_2.into(), p.PIN_3.into()), (p.PIN_4.into(), p.PIN_5.into())]);
    usb::run(p.USB).await;
}
