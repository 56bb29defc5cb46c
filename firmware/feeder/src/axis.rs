//! Where an axis is and how fast it goes, from an encoder's counts.
//!
//! The encoder knows no ends, the report does. At an end the count stands still while the hand goes on, and comes back at
//! once when the hand does; so the middle moves, as a mouse's does at the edge of its table.

/// The time constant of the speed's low pass, in ms: without it a damper would be felt in counts.
const SMOOTHED_MS: f32 = 4.0;

/// An axis and its encoder.
#[derive(Clone, Copy, Debug)]
pub struct Axis {
    /// Counts from the middle to an end.
    half_way: i32,
    counts: i32,
    speed: f32,
}

impl Axis {
    /// An axis whose half way is so many counts, at least one.
    pub const fn new(half_way: i32) -> Self {
        Self { half_way: if half_way < 1 { 1 } else { half_way }, counts: 0, speed: 0.0 }
    }

    /// Lets a ms pass in which so many counts came.
    pub fn advance(&mut self, counts: i32) {
        let place = self.counts.saturating_add(counts).clamp(-self.half_way, self.half_way);
        let part_per_s = (place - self.counts) as f32 / self.half_way as f32 * 1000.0;
        self.speed += (part_per_s - self.speed) / (1.0 + SMOOTHED_MS);
        self.counts = place;
    }

    /// Makes here the middle.
    pub fn centre(&mut self) {
        (self.counts, self.speed) = (0, 0.0);
    }

    /// Where it is on its way, -1 to 1.
    pub fn part(&self) -> f32 {
        self.counts as f32 / self.half_way as f32
    }

    /// How fast it goes, in half ways a second.
    pub fn part_per_s(&self) -> f32 {
        self.speed
    }

    /// What its report says of it, -32767 to 32767.
    pub fn reported(&self) -> i16 {
        libm::roundf(self.part() * 32767.0) as i16
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_end_is_32767_and_the_way_back_begins_at_once() {
        let mut axis = Axis::new(3200);
        axis.advance(3000);
        axis.advance(3000);
        assert_eq!((axis.reported(), axis.part()), (32767, 1.0));
        axis.advance(-3200);
        assert_eq!(axis.reported(), 0);
        axis.advance(i32::MIN);
        assert_eq!(axis.reported(), -32767);
        axis.centre();
        assert_eq!((axis.reported(), axis.part_per_s()), (0, 0.0));
    }

    #[test]
    fn an_even_motion_has_its_speed_after_some_time_constants() {
        let mut axis = Axis::new(3200);
        // 16 counts a ms are 5 half ways a second.
        (0..60).for_each(|_| axis.advance(16));
        assert!((axis.part_per_s() - 5.0).abs() < 0.01, "{}", axis.part_per_s());
        (0..60).for_each(|_| axis.advance(0));
        assert!(axis.part_per_s().abs() < 0.01, "{}", axis.part_per_s());
    }
}
