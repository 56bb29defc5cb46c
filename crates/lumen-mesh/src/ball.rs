//! A ball inside of a surface: what fits there, and what fits through to another.

use glam::Vec3;

/// A ball inside that touches the wall, or nearly does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its middle, in mm.
    pub centre: Vec3,
    /// Its radius in mm.
    pub radius: f32,
}

impl Ball {
    /// The radius of the circle in which two balls meet, or of the smaller one if its middle is inside the other: what
    /// fits through between them. 0 if they do not overlap.
    pub fn passage(&self, other: &Ball) -> f32 {
        let d = f64::from(self.centre.distance(other.centre));
        let (a, b) = (f64::from(self.radius), f64::from(other.radius));
        if d >= a + b {
            return 0.0;
        }
        // Where the plane of the circle lies, from the middle of the first.
        let to = (d * d + a * a - b * b) / (2.0 * d);
        if d == 0.0 || to <= 0.0 || to >= d { a.min(b) as f32 } else { (a * a - to * to).max(0.0).sqrt() as f32 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fits_through_between_two_balls_is_the_circle_in_which_they_meet() {
        let at = |x: f32, radius: f32| Ball { centre: Vec3::X * x, radius };
        // A right-angled triangle of 3, 4 and 5: the circle has the height over the longest side.
        assert!((at(0.0, 3.0).passage(&at(5.0, 4.0)) - 2.4).abs() < 1e-6);
        assert_eq!(at(0.0, 1.0).passage(&at(2.0, 1.0)), 0.0);
        assert_eq!(at(0.0, 1.0).passage(&at(0.5, 4.0)), 1.0);
    }
}
