//! Guidewires: what they are made of, as numbers.

use serde::{Deserialize, Serialize};

/// A guidewire.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Wire {
    /// Its name on the command line and in lists.
    pub name: String,
    /// Outer diameter in mm.
    pub diameter_mm: f64,
    /// Bending stiffness EI of the shaft, in N mm2.
    pub shaft_ei: f64,
    /// Bending stiffness at the tip, in N mm2.
    pub tip_ei: f64,
    /// From the tip, in mm: up to here it is as soft as the tip.
    pub soft_mm: f64,
    /// From the tip, in mm: from here on it is as stiff as the shaft. Between the two the logarithm is linear.
    pub taper_mm: f64,
    /// Torsional stiffness over bending stiffness, GJ / EI.
    pub torsion_ratio: f64,
    /// Length of the pre-bent tip in mm, measured from its end.
    pub bend_mm: f64,
    /// The angle by which it is bent, in degrees.
    pub bend_degrees: f64,
    /// From the tip, in mm: up to here, beyond the bend, the end is straight. 0 for a J.
    pub straight_end_mm: f64,
    /// Length of the wire in mm.
    pub length_mm: f64,
    /// Coefficients of friction against the wall, sticking and sliding.
    pub friction: [f64; 2],
    /// Density of the material in t/mm3.
    pub density: f64,
    /// Lengths of an element at the tip and of the shaft, in mm.
    pub elements_mm: [f64; 2],
}

impl Default for Wire {
    fn default() -> Self {
        Self::preset("workhorse").unwrap_or_else(|| unreachable!("workhorse is a preset"))
    }
}

/// Name, diameter, EI at the tip and of the shaft, soft part and taper, bend, its angle, straight end.
type Numbers = (&'static str, f64, [f64; 2], [f64; 2], f64, f64, f64);

/// The wires that Lumen brings, each with where its numbers are from.
///
/// `guidewire.md` in the notes gives the figures: a solid core's `EI = E pi d^4 / 64`; tip loads as Euler loads over
/// 10 mm; measured moduli of 0.035 in wires (Harrison 2011, J Endovasc Ther 18:797).
const PRESETS: [Numbers; 6] = [
    // 0.06 mm of steel at the tip; a shaft of nitinol of 0.356 mm. The tip is bent by 45 degrees 3 mm from its end, for a
    // main stem of 4 mm.
    ("floppy", 0.356, [0.05, 38.0], [30.0, 300.0], 5.0, 45.0, 3.0),
    // 0.10 mm of steel at the tip gives 1; a tip load of 1 gf is 0.02 to 0.4.
    ("workhorse", 0.356, [0.1, 40.0], [30.0, 300.0], 5.0, 45.0, 3.0),
    // A tip load of 12 gf is 0.6 to 4.8; a shaft of solid steel of 0.356 mm.
    ("stiff", 0.356, [1.5, 150.0], [20.0, 200.0], 5.0, 45.0, 3.0),
    // The workhorse with its end rolled to a J of 2 mm radius.
    ("workhorse-j", 0.356, [0.1, 40.0], [30.0, 300.0], 6.3, 180.0, 0.0),
    // A plain 0.035 in wire, 9.5 GPa: 291; a J of 3 mm radius.
    ("035-j", 0.889, [1.0, 291.0], [30.0, 150.0], 9.4, 180.0, 0.0),
    // Amplatz stiff, 17 GPa: 521.
    ("035-stiff-j", 0.889, [2.0, 521.0], [30.0, 150.0], 9.4, 180.0, 0.0),
];

/// Steel, in t/mm3.
const STEEL: f64 = 7.9e-9;

impl Wire {
    /// The names of the wires that Lumen brings.
    pub fn names() -> impl Iterator<Item = &'static str> {
        PRESETS.iter().map(|preset| preset.0)
    }

    /// The wire of this name, if Lumen brings it.
    pub fn preset(name: &str) -> Option<Self> {
        let &(name, diameter_mm, [tip_ei, shaft_ei], [soft_mm, taper_mm], bend_mm, bend_degrees, straight_end_mm) =
            PRESETS.iter().find(|preset| preset.0 == name)?;
        Some(Self {
            name: name.to_owned(),
            diameter_mm,
            shaft_ei,
            tip_ei,
            soft_mm,
            taper_mm,
            // A solid round of Poisson's ratio 0.3.
            torsion_ratio: 1.0 / 1.3,
            bend_mm,
            bend_degrees,
            straight_end_mm,
            length_mm: 1800.0,
            friction: [0.06, 0.04],
            density: STEEL,
            elements_mm: if diameter_mm < 0.6 { [0.5, 2.0] } else { [1.0, 3.0] },
        })
    }

    /// Radius in mm.
    pub fn radius(&self) -> f64 {
        self.diameter_mm / 2.0
    }
}
