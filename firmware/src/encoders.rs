//! Two encoders on the programmable I/O: a state machine each samples both lines, 16 times a word.

use core::cell::Cell;

use embassy_executor::Spawner;
use embassy_rp::Peri;
use embassy_rp::gpio::Pull;
use embassy_rp::peripherals::{PIN_2, PIN_3, PIN_4, PIN_5, PIO0};
use embassy_rp::pio::{
    Common, Config, Direction, FifoJoin, LoadedProgram, Pio, PioPin, ShiftConfig, ShiftDirection, StateMachine,
};
use embassy_sync::blocking_mutex::Mutex;
use fixed::FixedU32;
use fixed::types::extra::U8;
use lumen_feeder::quadrature::{Decoder, SAMPLES, Steps};

use crate::Shared;

/// Samples a second: a wheel of 20 mm with 4000 counts is followed up to 3 m/s.
const RATE: u32 = 200_000;

/// Of feed and roll, since they were last taken.
static STEPS: [Shared<Cell<Steps>>; 2] = [const { Mutex::new(Cell::new(Steps { counts: 0, missed: 0 })) }; 2];

/// The two lines of an encoder; B's pin is the one after A's.
pub(crate) struct Lines<A: PioPin, B: PioPin> {
    /// The one that leads on the way up.
    pub(crate) a: Peri<'static, A>,
    /// The other.
    pub(crate) b: Peri<'static, B>,
}

/// Begins to follow both.
pub(crate) fn start(spawner: Spawner, pio: Pio<'static, PIO0>, feed: Lines<PIN_2, PIN_3>, roll: Lines<PIN_4, PIN_5>) {
    let Pio { mut common, mut sm0, mut sm1, .. } = pio;
    let program = common.load_program(&pio::pio_asm!(".wrap_target", "in pins, 2", ".wrap").program);
    sample(&mut common, &mut sm0, &program, feed);
    sample(&mut common, &mut sm1, &program, roll);
    spawner.spawn(follow_feed(sm0).expect("it is spawned once"));
    spawner.spawn(follow_roll(sm1).expect("it is spawned once"));
}

/// What the encoders of feed and roll have done since this was last asked.
pub(crate) fn taken() -> [Steps; 2] {
    STEPS.each_ref().map(|steps| steps.lock(Cell::take))
}

fn sample<const N: usize>(
    common: &mut Common<'static, PIO0>,
    machine: &mut StateMachine<'static, PIO0, N>,
    program: &LoadedProgram<'static, PIO0>,
    lines: Lines<impl PioPin + 'static, impl PioPin + 'static>,
) {
    let mut pins = [common.make_pio_pin(lines.a), common.make_pio_pin(lines.b)];
    pins.iter_mut().for_each(|pin| pin.set_pull(Pull::Up));
    let [a, b] = &pins;
    machine.set_pin_dirs(Direction::In, &[a, b]);
    let mut config = Config::default();
    config.use_program(program, &[]);
    config.set_in_pins(&[a, b]);
    config.fifo_join = FifoJoin::RxOnly;
    // To the left: the oldest sample ends in the highest bits.
    config.shift_in = ShiftConfig { auto_fill: true, threshold: 2 * SAMPLES as u8, direction: ShiftDirection::Left };
    config.clock_divider = FixedU32::<U8>::from_num(embassy_rp::clocks::clk_sys_freq() / RATE);
    machine.set_config(&config);
}

#[embassy_executor::task]
async fn follow_feed(machine: StateMachine<'static, PIO0, 0>) {
    follow(machine, &STEPS[0]).await;
}

#[embassy_executor::task]
async fn follow_roll(machine: StateMachine<'static, PIO0, 1>) {
    follow(machine, &STEPS[1]).await;
}

async fn follow<const N: usize>(mut machine: StateMachine<'static, PIO0, N>, steps: &Shared<Cell<Steps>>) {
    let mut decoder = Decoder::default();
    // Not sooner, or samples would have been lost before anybody counts.
    machine.set_enable(true);
    loop {
        let more = decoder.take(machine.rx().wait_pull().await);
        // Where the queue was full the samples paused, and steps may be lost.
        let stalled = u32::from(machine.rx().stalled());
        steps.lock(|steps| {
            let Steps { counts, missed } = steps.get();
            steps.set(Steps {
                counts: counts.saturating_add(more.counts),
                missed: missed.saturating_add(more.missed).saturating_add(stalled),
            });
        });
    }
}
