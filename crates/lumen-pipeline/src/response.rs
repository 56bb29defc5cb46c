//! Which waves on a surface a filter lets through: from eigenvalues of the Laplacian to millimetres.
//!
//! A wave `exp(i w.x)` on the regular triangular lattice of edge length `h` is an eigenvector of the umbrella operator
//! `K x_i = x_i - mean of x_i's neighbours`, with the eigenvalue `k = 1 - 1/6 sum of cos(w.e)` over the six edges `e`
//! of a vertex. Its mean over the directions of `w` is `k = 1 - J0(|w| h)` (Bessel function of the first kind); long
//! waves have `k = |w|^2 h^2 / 4`, and so they have on any mesh whose edges point everywhere alike, with `h` the root
//! of the mean square of the edge lengths. The wavelength `2 pi / |w|` at `k` follows by bisection. It is that of the
//! whole mesh: where edges are longer, so are the waves that pass.

use std::f64::consts::PI;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::filter::Filter;
use lumen_message::{ToValue, Value, messages};

/// Where a filter cuts, without unit and in mm on one surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SmoothingResponse {
    /// The eigenvalue up to which everything passes.
    pub pass_band: f64,
    /// The smallest eigenvalue at which half passes; null where everything does.
    pub half_gain: Option<f64>,
    /// The length of the waves at the pass band: longer ones pass whole. Null where that is shorter than two edges.
    pub wavelength_mm_at_pass_band: Option<f64>,
    /// The length of the waves of which half passes; shorter ones are taken off. Null likewise.
    pub wavelength_mm_at_half_gain: Option<f64>,
    /// Root mean square of the edge lengths, on which the wavelengths rest.
    pub edge_length_mm: f64,
}

impl SmoothingResponse {
    /// The response of `filter`, made for `pass_band`, on a surface with edges of `edge_length` mm.
    pub fn new(filter: &Filter, pass_band: f64, edge_length: f64) -> Self {
        let half_gain = filter.half_gain();
        Self {
            pass_band,
            half_gain,
            wavelength_mm_at_pass_band: wavelength(pass_band, edge_length),
            wavelength_mm_at_half_gain: half_gain.and_then(|k| wavelength(k, edge_length)),
            edge_length_mm: edge_length,
        }
    }

    /// The half gain in words: "k = 0.023: waves of 12.3 mm".
    pub fn half_gain_message(&self) -> Option<HalfGain> {
        let k = ThreeDigits(self.half_gain?);
        Some(match self.wavelength_mm_at_half_gain {
            Some(mm) => HalfGain::Waves { k, length: ThreeDigits(mm) },
            None => HalfGain::Alone { k },
        })
    }
}

messages! {
    /// Where half passes.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum HalfGain {
        /// As an eigenvalue, and as waves on the surface.
        "verdict-half-gain" Waves {
            /// The eigenvalue.
            k: ThreeDigits,
            /// In mm.
            length: ThreeDigits,
        } => "k = {k}: waves of {length} mm",
        /// On this surface no wave has that eigenvalue.
        "verdict-half-gain-alone" Alone {
            /// The eigenvalue.
            k: ThreeDigits,
        } => "k = {k}",
    }
}

/// A positive number that is written with about three significant digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThreeDigits(pub f64);

impl ThreeDigits {
    /// How many decimals are written.
    pub fn places(self) -> u8 {
        match self.0 {
            x if x >= 100.0 => 0,
            x if x >= 10.0 => 1,
            x if x >= 1.0 => 2,
            x if x >= 0.1 => 3,
            _ => 4,
        }
    }
}

impl fmt::Display for ThreeDigits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.places$}", self.0, places = usize::from(self.places()))
    }
}

impl ToValue for ThreeDigits {
    fn to_value(&self) -> Value {
        Value::decimal(self.0, self.places())
    }
}

/// The eigenvalue `k` of waves of `wavelength` on a lattice of edges of `edge_length`, the mean over all directions.
pub fn eigenvalue(wavelength: f64, edge_length: f64) -> f64 {
    1.0 - libm::j0(2.0 * PI * edge_length / wavelength)
}

/// The length of the waves whose eigenvalue is `k` on a mesh with edges of `edge_length`, in the same unit. `None`
/// where there is none of two edges or more, the shortest wave that a mesh can carry.
pub fn wavelength(k: f64, edge_length: f64) -> Option<f64> {
    if !(k > 0.0 && edge_length > 0.0 && k <= eigenvalue(2.0, 1.0)) {
        return None;
    }
    // 1 - J0 climbs from 0 up to that wave.
    let (mut low, mut high) = (0.0, PI);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if 1.0 - libm::j0(middle) < k { low = middle } else { high = middle }
    }
    Some(2.0 * PI * edge_length / high)
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;

    #[test]
    fn the_eigenvalue_is_the_mean_of_the_lattices_over_all_directions() {
        // 1 - 1/6 sum of cos(w.e), by hand.
        for part in 1..40 {
            let (w, directions) = (PI * f64::from(part) / 40.0, 720);
            let exact = |direction: i32| {
                let w = DVec2::from_angle(PI * f64::from(direction) / 360.0) * w;
                let cosines = (0..6).map(|i| (w.dot(DVec2::from_angle(PI / 3.0 * f64::from(i)))).cos());
                1.0 - cosines.sum::<f64>() / 6.0
            };
            let mean = (0..directions).map(exact).sum::<f64>() / f64::from(directions);
            assert!((eigenvalue(2.0 * PI / w, 1.0) - mean).abs() < 1e-9, "{w}");
            if w < 0.3 {
                assert!((mean / (w * w / 4.0) - 1.0).abs() < 0.01, "long waves");
            }
        }
    }

    #[test]
    fn wavelength_and_eigenvalue_undo_each_other_and_scale_with_the_mesh() {
        for k in [1e-4, 0.01, 0.1, 0.5, 1.0, 1.3] {
            let found = wavelength(k, 0.7).unwrap();
            assert!((eigenvalue(found, 0.7) - k).abs() < 1e-9);
            assert!((wavelength(k, 1.4).unwrap() / found - 2.0).abs() < 1e-9);
        }
        for (k, h) in [(0.0, 1.0), (1.4, 1.0), (2.0, 1.0), (0.1, 0.0), (f64::NAN, 1.0)] {
            assert_eq!(wavelength(k, h), None);
        }
    }

    #[test]
    fn the_text_is_short() {
        let response = SmoothingResponse {
            pass_band: 0.01,
            half_gain: Some(0.023_4),
            wavelength_mm_at_pass_band: None,
            wavelength_mm_at_half_gain: Some(12.34),
            edge_length_mm: 1.0,
        };
        assert_eq!(response.half_gain_message().unwrap().to_string(), "k = 0.0234: waves of 12.3 mm");
    }
}
