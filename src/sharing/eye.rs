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

    /// With no more digits than can be seen: a ten-thousandth of the distance and of a turn.
    pub fn rounded(self) -> Self {
        let step = libm::powf(10.0, (libm::log10f(self.distance_mm) - 4.0).floor());
        let round = |x: f32, step: f32| (f64::from((x / step).round()) * f64::from(step) * 1e6).round() as f32 / 1e6;
        Self {
            target_mm: self.target_mm.map(|x| round(x, step)),
            rotation: self.rotation.map(|x| round(x, 1e-4)),
            distance_mm: round(self.distance_mm, step),
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
