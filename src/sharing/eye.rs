//! From where a surface is looked at, as a link and what is kept have it.

use std::fmt::{self, Display};
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Of a place that is looked at or from, in mm.
const FARTHEST_MM: f32 = 1e6;

/// From where a surface is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Eye {
    /// The point in the middle of the view.
    pub target_mm: [f32; 3],
    /// From the camera's axes to the world's: a unit quaternion, its real part last.
    pub rotation: [f32; 4],
    /// From the eye to the target; above zero.
    pub distance_mm: f32,
}

impl Eye {
    /// Whether it is within reach of a surface: no farther than a kilometre, no nearer than a micrometre.
    pub fn is_somewhere(&self) -> bool {
        let length = self.rotation.iter().map(|x| x * x).sum::<f32>();
        (length - 1.0).abs() < 1e-3
            && (1e-3..=FARTHEST_MM).contains(&self.distance_mm)
            && self.target_mm.iter().all(|x| x.abs() <= FARTHEST_MM)
    }

    /// With no more digits than can be seen: to a ten-thousandth of the distance and of a turn.
    pub fn rounded(self) -> Self {
        let round = |x: f32, places: f64| {
            let scale = libm::pow(10.0, places);
            ((f64::from(x) * scale).round() / scale) as f32
        };
        let places = 4.0 - libm::log10(self.distance_mm.into()).floor();
        Self {
            target_mm: self.target_mm.map(|x| round(x, places)),
            rotation: self.rotation.map(|x| round(x, 4.0)),
            distance_mm: round(self.distance_mm, places),
        }
    }
}

/// Target, rotation and distance, with commas between them.
impl Display for Eye {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for x in self.target_mm.iter().chain(&self.rotation) {
            write!(f, "{x},")?;
        }
        write!(f, "{}", self.distance_mm)
    }
}

impl FromStr for Eye {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let numbers: Vec<f32> =
            text.split(',').map(|number| number.parse().map_err(|_| ())).collect::<Result<_, _>>()?;
        let [x, y, z, a, b, c, d, distance_mm] = numbers[..] else { return Err(()) };
        Some(Self { target_mm: [x, y, z], rotation: [a, b, c, d], distance_mm }).filter(Self::is_somewhere).ok_or(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_link_has_no_more_digits_than_can_be_seen_whatever_the_size() {
        for scale in [1e-3, 1.0, 1e3] {
            let eye = Eye {
                target_mm: [1.234_567, -0.012_345_6, 77.777_77].map(|x| x * scale),
                rotation: [0.123_456, -0.5, 0.7, 0.494_949],
                distance_mm: 345.678_9 * scale,
            };
            let rounded = eye.rounded();
            assert!(rounded.to_string().len() < 80, "{rounded}");
            let near = |a: f32, b: f32, within: f32| (a - b).abs() <= 0.6 * within;
            let step = 1e-4 * eye.distance_mm;
            assert!(near(eye.distance_mm, rounded.distance_mm, step) && rounded.distance_mm > 0.0);
            assert!(eye.target_mm.iter().zip(rounded.target_mm).all(|(a, b)| near(*a, b, step)), "{rounded}");
            assert!(eye.rotation.iter().zip(rounded.rotation).all(|(a, b)| near(*a, b, 1e-4)), "{rounded}");
        }
    }
}
