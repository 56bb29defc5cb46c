//! The open feeder on an RP2040: pins, timers and USB. What it does with them is `lumen-feeder`, which runs anywhere.
//!
//! | task | when | what |
//! |---|---|---|
//! | `encoders` | a word of samples came | lines to counts |
//! | [`control`] | every ms | counts to motors and to the next input reports |
//! | `usb`, `serial` | the host asks | reports in and out |
//!
//! All share one executor in thread mode. Samples wait for 0.6 ms; no task works for as long. A panic stops the program, and
//! 20 ms later the chip starts anew.

#![no_std]
#![no_main]

mod encoders;
mod motors;
mod serial;
mod usb;

use core::cell::RefCell;

use cortex_m_rt as _;
use embassy_executor::Spawner;
use embassy_rp::gpio::{Input, Level, Output, Pull};
use embassy_rp::peripherals::{PIO0, USB};
use embassy_rp::watchdog::Watchdog;
use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::ThreadModeRawMutex;
use embassy_time::{Duration, Ticker};
use lumen_feeder::device::{Device, Seen};
use panic_halt as _;

use encoders::Lines;
use motors::Motors;

embassy_rp::bind_interrupts!(struct Interrupts {
    PIO0_IRQ_0 => embassy_rp::pio::InterruptHandler<PIO0>;
    USBCTRL_IRQ => embassy_rp::usb::InterruptHandler<USB>;
});

/// What several tasks use, one at a time.
type Shared<T> = Mutex<ThreadModeRawMutex, T>;

/// How long [`control`] may not have run before the chip starts anew, which lets its pins go.
const STUCK: Duration = Duration::from_millis(20);

static DEVICE: Shared<RefCell<Device>> = Mutex::new(RefCell::new(Device::new()));

/// What [`control`] sees and moves, beside the encoders.
struct Hardware {
    motors: Motors,
    clutch: Input<'static>,
    centre: Input<'static>,
    power: Input<'static>,
    fault: Input<'static>,
    /// The driver sleeps while it is low.
    driver: Output<'static>,
    light: Output<'static>,
    watchdog: Watchdog,
}

// The pins' numbers are those of the wiring table in docs/haptic-device.md.
#[embassy_executor::main]
async fn main(spawner: Spawner) {
    let p = embassy_rp::init(embassy_rp::config::Config::default());
    let hardware = Hardware {
        motors: Motors::new((p.PWM_SLICE0, p.PIN_16, p.PIN_17), (p.PWM_SLICE1, p.PIN_18, p.PIN_19)),
        clutch: Input::new(p.PIN_6, Pull::Up),
        centre: Input::new(p.PIN_7, Pull::Up),
        power: Input::new(p.PIN_22, Pull::Down),
        fault: Input::new(p.PIN_21, Pull::Up),
        driver: Output::new(p.PIN_20, Level::Low),
        light: Output::new(p.PIN_25, Level::Low),
        watchdog: Watchdog::new(p.WATCHDOG),
    };
    let feed = Lines { a: p.PIN_2, b: p.PIN_3 };
    let roll = Lines { a: p.PIN_4, b: p.PIN_5 };
    encoders::start(spawner, embassy_rp::pio::Pio::new(p.PIO0, Interrupts), feed, roll);
    usb::start(spawner, embassy_rp::usb::Driver::new(p.USB, Interrupts));
    spawner.spawn(control(hardware).expect("it is spawned once"));
}

/// Lets the device live, a ms at a time.
#[embassy_executor::task]
async fn control(mut hardware: Hardware) {
    let mut ticker = Ticker::every(Duration::from_millis(1));
    hardware.watchdog.start(STUCK);
    loop {
        ticker.next().await;
        hardware.watchdog.feed(STUCK);
        let seen = Seen {
            steps: encoders::taken(),
            is_clutched: hardware.clutch.is_low(),
            is_centred: hardware.centre.is_low(),
            has_power: hardware.power.is_high(),
            // A driver that sleeps says nothing of itself.
            is_faulty: hardware.driver.is_set_high() && hardware.fault.is_low(),
        };
        let (parts, state, playing) = DEVICE.lock(|device| {
            let mut device = device.borrow_mut();
            (device.advance(&seen), device.state(), device.playing())
        });
        let pushes = parts != [0.0; 2];
        hardware.motors.push(parts);
        hardware.driver.set_level(Level::from(seen.has_power));
        hardware.light.set_level(Level::from(pushes));
        usb::tell(state, playing);
    }
}
