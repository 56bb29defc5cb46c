//! Guidewires: what they are made of, as numbers.

mod elements;

use serde::{Deserialize, Serialize};

use lumen_message::messages;
use lumen_vessel::phantom::Sample;

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
const PRESETS: [Numbers; 9] = [
    // 0.06 mm of steel at the tip; a shaft of nitinol of 0.356 mm. The tip is bent by 45 degrees 3 mm from its end, for a
    // main stem of 4 mm.
    ("floppy", 0.356, [0.05, 38.0], [30.0, 300.0], 5.0, 45.0, 3.0),
    // 0.10 mm of steel at the tip gives 1; a tip load of 1 gf is 0.02 to 0.4. Its bend was shaped on the coronary sample: one
    // of 45 degrees goes past the fork at 17 mm, which turns by more, once that is reduced by 99 %.
    ("workhorse", 0.356, [0.1, 40.0], [30.0, 300.0], 5.0, 60.0, 3.0),
    // A tip load of 12 gf is 0.6 to 4.8; a shaft of solid steel of 0.356 mm.
    ("stiff", 0.356, [1.5, 150.0], [20.0, 200.0], 5.0, 45.0, 3.0),
    // The workhorse with its end rolled to a J of 2 mm radius.
    ("workhorse-j", 0.356, [0.1, 40.0], [30.0, 300.0], 6.3, 180.0, 0.0),
    // A plain 0.035 in wire, 9.5 GPa: 291; bent by 60 degrees 8 mm from its end, which reaches 9 mm aside. The bend was
    // shaped on the test vessels (45 degrees and 6 mm were too short for their wide forks), so how it does there proves
    // little for others.
    ("035-angled", 0.889, [1.0, 291.0], [30.0, 150.0], 12.0, 60.0, 8.0),
    // The same with a longer end, which reaches 16 mm aside: for gentle forks of lumens up to 26 mm wide.
    ("035-angled-20", 0.889, [1.0, 291.0], [30.0, 150.0], 20.0, 60.0, 16.0),
    // The same with the curve of a shaped catheter, which reaches 23 mm aside: for forks that are too wide for a wire's own bend.
    // It was shaped on two surfaces, steve_vessel_architecture and SimVascular's aorta.
    ("035-curve", 0.889, [1.0, 291.0], [30.0, 150.0], 28.0, 90.0, 14.0),
    // The same with a J of 3 mm radius.
    ("035-j", 0.889, [1.0, 291.0], [30.0, 150.0], 9.4, 180.0, 0.0),
    // Amplatz stiff, 17 GPa: 521.
    ("035-stiff-j", 0.889, [2.0, 521.0], [30.0, 150.0], 9.4, 180.0, 0.0),
];

/// Density of steel in t/mm3, and its Young's modulus in MPa.
const STEEL: (f64, f64) = (7.9e-9, 200_000.0);
/// The shortest element in mm.
const SHORTEST: f64 = 0.05;
/// The most that a wire may be bent from one element to the next, in degrees.
const SHARPEST: f64 = 90.0;

messages! {
    /// A number that makes no wire.
    #[derive(Clone, Debug, PartialEq)]
    pub enum WireError {
        /// It is out of range, or does not go with the others.
        "trial-wire-impossible" Impossible {
            /// Which number.
            what: WireNumber,
            /// It.
            value: f64,
        } => "the wire's {what} of {value} is not possible",
    }
}

messages! {
    /// A number of a wire.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum WireNumber {
        /// Outer diameter.
        "trial-wire-diameter" Diameter => "diameter",
        /// Bending stiffness of the shaft.
        "trial-wire-shaft-stiffness" ShaftStiffness => "stiffness of the shaft",
        /// Bending stiffness at the tip.
        "trial-wire-tip-stiffness" TipStiffness => "stiffness of the tip",
        /// Torsional stiffness over bending stiffness.
        "trial-wire-torsion-ratio" TorsionRatio => "torsion ratio",
        /// Length of the wire.
        "trial-wire-length" Length => "length",
        /// Density of the material.
        "trial-wire-density" Density => "density",
        /// Length of an element at the tip.
        "trial-wire-tip-element" TipElement => "element at the tip",
        /// Length of an element of the shaft.
        "trial-wire-shaft-element" ShaftElement => "element of the shaft",
        /// Length that is as soft as the tip.
        "trial-wire-soft-part" SoftPart => "soft part",
        /// From the tip to where it is as stiff as the shaft.
        "trial-wire-taper" Taper => "taper",
        /// Length of the bent tip.
        "trial-wire-bend" Bend => "bend",
        /// Angle by which the tip is bent.
        "trial-wire-bend-angle" BendAngle => "angle of the bend",
        /// Length of the straight end beyond the bend.
        "trial-wire-straight-end" StraightEnd => "straight end",
        /// Coefficient of friction while it sticks.
        "trial-wire-static-friction" StaticFriction => "static friction",
        /// Coefficient of friction while it slides.
        "trial-wire-kinetic-friction" KineticFriction => "kinetic friction",
    }
}

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
            density: STEEL.0,
            elements_mm: if diameter_mm < 0.6 { [0.5, 2.0] } else { [1.0, 3.0] },
        })
    }

    /// The name of the wire for coronary arteries, and of that for wide vessels with forks.
    pub(super) const USUAL: &str = "workhorse";
    pub(super) const LONG_BEND: &str = "035-angled";
    pub(super) const LONG_TIP: &str = "035-angled-20";
    pub(super) const CURVE: &str = "035-curve";

    /// One of the presets.
    pub(super) fn named(name: &'static str) -> Self {
        Self::preset(name).unwrap_or_else(|| unreachable!("{name} is a preset"))
    }

    /// The wire that a sample is tried with: for the abdominal aorta one of 0.035 in, which passes its branches.
    pub fn for_sample(sample: Sample) -> Self {
        Self::named(if sample == Sample::Aorta { "035-j" } else { Self::USUAL })
    }

    /// Radius in mm.
    pub fn radius(&self) -> f64 {
        self.diameter_mm / 2.0
    }

    /// Refuses numbers that make no wire.
    ///
    /// # Errors
    /// Names the number.
    pub fn check(&self) -> Result<(), WireError> {
        let positive = [
            (WireNumber::Diameter, self.diameter_mm, 10.0),
            (WireNumber::ShaftStiffness, self.shaft_ei, 1e5),
            (WireNumber::TipStiffness, self.tip_ei, 1e5),
            (WireNumber::TorsionRatio, self.torsion_ratio, 100.0),
            (WireNumber::Length, self.length_mm, 10_000.0),
            (WireNumber::Density, self.density, 1e-6),
        ];
        let elements = [
            (WireNumber::TipElement, self.elements_mm[0], 20.0),
            (WireNumber::ShaftElement, self.elements_mm[1], 20.0),
        ];
        let others = [
            (WireNumber::SoftPart, self.soft_mm, 10_000.0),
            (WireNumber::Taper, self.taper_mm, 10_000.0),
            (WireNumber::Bend, self.bend_mm, 100.0),
            (WireNumber::BendAngle, self.bend_degrees, 360.0),
            (WireNumber::StraightEnd, self.straight_end_mm, 100.0),
            (WireNumber::StaticFriction, self.friction[0], 2.0),
            (WireNumber::KineticFriction, self.friction[1], 2.0),
        ];
        let wrong = |&(what, value, most): &(WireNumber, f64, f64), least: f64| {
            (!(least..=most).contains(&value)).then_some(WireError::Impossible { what, value })
        };
        let found = positive.iter().find_map(|number| wrong(number, 1e-9));
        let found = found.or_else(|| others.iter().find_map(|number| wrong(number, 0.0)));
        let found = found.or_else(|| elements.iter().find_map(|number| wrong(number, SHORTEST)));
        if let Some(error) = found {
            return Err(error);
        }
        if self.length_mm < 20.0 * self.elements_mm[0].max(self.elements_mm[1]) {
            return Err(WireError::Impossible { what: WireNumber::Length, value: self.length_mm });
        }
        let bent = (self.bend_mm - self.straight_end_mm).max(self.elements_mm[0]);
        if self.bend_degrees * self.elements_mm[0] > SHARPEST * bent {
            return Err(WireError::Impossible { what: WireNumber::BendAngle, value: self.bend_degrees });
        }
        Ok(())
    }
}
