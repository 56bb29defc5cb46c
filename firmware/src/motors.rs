//! Two motors on a dual H bridge, two inputs each, switched at 25 kHz, where nobody hears it.

use embassy_rp::Peri;
use embassy_rp::clocks::clk_sys_freq;
use embassy_rp::peripherals::{PIN_16, PIN_17, PIN_18, PIN_19, PWM_SLICE0, PWM_SLICE1};
use embassy_rp::pwm::{Config, Pwm};
use lumen_feeder::motor::{Inputs, Motor};

/// The feed's motor. Its current is the limit of its force: what stands here is what docs/haptic-device.md says.
const FEED: Motor = Motor { supply_v: 6.0, winding_ohm: 6.0, most_a: 0.5 };
/// The roll's.
const ROLL: Motor = Motor { supply_v: 6.0, winding_ohm: 12.0, most_a: 0.25 };

/// Periods a second.
const RATE: u32 = 25_000;

/// Both motors.
pub(crate) struct Motors {
    timers: [Pwm<'static>; 2],
    /// Counts of a timer's period.
    period: u16,
}

impl Motors {
    /// At rest. Of each motor: its timer, the pin that pushes up, the pin that pushes down.
    pub(crate) fn new(
        feed: (Peri<'static, PWM_SLICE0>, Peri<'static, PIN_16>, Peri<'static, PIN_17>),
        roll: (Peri<'static, PWM_SLICE1>, Peri<'static, PIN_18>, Peri<'static, PIN_19>),
    ) -> Self {
        let period = (clk_sys_freq() / RATE) as u16;
        let rest = config(period, Inputs::default());
        let feed = Pwm::new_output_ab(feed.0, feed.1, feed.2, rest.clone());
        let roll = Pwm::new_output_ab(roll.0, roll.1, roll.2, rest);
        Self { timers: [feed, roll], period }
    }

    /// Pushes with these parts of the greatest forces, -1 to 1, until told otherwise.
    pub(crate) fn push(&mut self, parts: [f32; 2]) {
        for ((timer, motor), part) in self.timers.iter_mut().zip([FEED, ROLL]).zip(parts) {
            timer.set_config(&config(self.period, motor.inputs(part, self.period)));
        }
    }
}

fn config(period: u16, inputs: Inputs) -> Config {
    let mut config = Config::default();
    (config.top, config.compare_a, config.compare_b) = (period - 1, inputs.up, inputs.down);
    config
}
