//! A motor on an H bridge with two inputs: high and low drives it one way, low and high the other, both high short its winding,
//! both low let it go.
//!
//! Between driving it is shorted (slow decay): then the current follows the duty from the first percent on. A winding that
//! stands still draws duty x supply / resistance. That bounds the duty, once and for all reports. A hand that turns the motor
//! against its force adds what the motor induces; the driver's own current limit is there for that
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

/// How long each of the bridge's inputs is high in a period, in counts of its timer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inputs {
    /// The one that pushes to greater places.
    pub up: u16,
    /// The one that pushes to smaller ones.
    pub down: u16,
}

impl Motor {
    /// The greatest part of the time that it may be on, 0 to 1.
    pub fn most_duty(&self) -> f32 {
        let most = self.most_a * self.winding_ohm / self.supply_v;
        if most.is_finite() { most.clamp(0.0, 1.0) } else { 0.0 }
    }

    /// The inputs for a part of its greatest force, -1 to 1, with a period of so many counts. Without a force both are low;
    /// no number is no force.
    pub fn inputs(&self, part: f32, period: u16) -> Inputs {
        let part = if part.is_nan() { 0.0 } else { part.clamp(-1.0, 1.0) };
        let driven = libm::floorf(part.abs() * self.most_duty() * f32::from(period)) as u16;
        let shorted = period.saturating_sub(driven);
        match driven {
            0 => Inputs::default(),
            _ if part < 0.0 => Inputs { up: shorted, down: period },
            _ => Inputs { up: period, down: shorted },
        }
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
            assert_eq!(MOTOR.inputs(part, 1000), Inputs { up: 1000, down: 600 });
            assert_eq!(MOTOR.inputs(-part, 1000), Inputs { up: 600, down: 1000 });
        }
        assert_eq!(MOTOR.inputs(0.5, 1000), Inputs { up: 1000, down: 800 });
        assert_eq!(MOTOR.inputs(0.001, 1000), Inputs::default(), "less than a count");
    }

    #[test]
    fn no_number_is_no_force() {
        assert_eq!(MOTOR.inputs(f32::NAN, 1000), Inputs::default());
        assert_eq!(Motor { supply_v: 0.0, ..MOTOR }.inputs(0.0, 1000), Inputs::default());
        assert_eq!(Motor { most_a: f32::NAN, ..MOTOR }.inputs(1.0, 1000), Inputs::default());
    }
}
