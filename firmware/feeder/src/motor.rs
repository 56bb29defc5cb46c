//! A motor on an H bridge: which of its two inputs is switched, for how much of the time.
//!
//! A winding that stands still draws duty x supply / resistance. That bounds the duty, once and for all reports. A hand that
//! turns the motor against its force adds what the motor induces: the driver's own current limit is there for that
//! (`docs/haptic-device.md`).

/// A motor and its supply.
#[derive(Clone, Copy, Debug)]
pub struct Motor {
    /// The supply, in V.
    pub supply_v: f32,
    /// The winding with its leads, in ohm.
    pub winding_ohm: f32,
    /// The most that it may draw when it stands still, in A.
    pub most_a: f32,
}

/// How long the bridge's inputs are on in a period, in counts of its timer: one of the two, never both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Duty {
    /// The input that pushes to greater places.
    pub up: u16,
    /// The input that pushes to smaller ones.
    pub down: u16,
}

impl Motor {
    /// The greatest part of the time that it may be on, 0 to 1.
    pub fn most_duty(&self) -> f32 {
        let most = self.most_a * self.winding_ohm / self.supply_v;
        if most.is_finite() { most.clamp(0.0, 1.0) } else { 0.0 }
    }

    /// The duty for a part of its greatest force, -1 to 1, of a timer that counts to `top`. No number is no force.
    pub fn duty(&self, part: f32, top: u16) -> Duty {
        let part = if part.is_nan() { 0.0 } else { part.clamp(-1.0, 1.0) };
        let counts = libm::floorf(part.abs() * self.most_duty() * f32::from(top)) as u16;
        if part < 0.0 { Duty { up: 0, down: counts } } else { Duty { up: counts, down: 0 } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MOTOR: Motor = Motor { supply_v: 5.0, winding_ohm: 5.0, most_a: 0.4 };

    #[test]
    fn ohm_s_law_bounds_the_duty() {
        // 0.4 A through 5 ohm are 2 V of the 5 V.
        assert_eq!(MOTOR.most_duty(), 0.4);
        for part in [1.0, 7.0, f32::INFINITY] {
            assert_eq!(MOTOR.duty(part, 1000), Duty { up: 400, down: 0 });
            assert_eq!(MOTOR.duty(-part, 1000), Duty { up: 0, down: 400 });
        }
        assert_eq!(MOTOR.duty(0.5, 1000), Duty { up: 200, down: 0 });
    }

    #[test]
    fn no_number_is_no_force() {
        assert_eq!(MOTOR.duty(f32::NAN, 1000), Duty::default());
        assert_eq!(Motor { supply_v: 0.0, ..MOTOR }.duty(0.0, 1000), Duty::default());
        assert_eq!(Motor { most_a: f32::NAN, ..MOTOR }.duty(1.0, 1000), Duty::default());
    }
}
