//! What a user should hear about the numbers of a run.

use super::pinch::PinchMessage;
use super::report::Report;
use lumen_mesh::mending::MendWarning;
use lumen_message::{Signed, grouped, messages};
use lumen_vessel::width::{Narrowing, SHUT};

/// A change of volume, in percent, above which a report warns.
const LARGE_CHANGE: f64 = 10.0;

messages! {
    /// The volume was to be held and could not be.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum VolumeNotHeld {
        /// Vertices were put back afterwards.
        "verdict-volume-put-back" PutBack =>
            "The volume is not held to 0.01 %: vertices were put back, so that no triangles cross.",
        /// The surface has none.
        "verdict-volume-none" NoVolume =>
            "The volume could not be held, because the surface encloses none: it is smoothed as without it.",
        /// The vessels are too thin for it.
        "verdict-volume-thin" Thin =>
            "The volume could not be held, because vessels as thin as these would tear or swell at this pass band: the \
             surface is smoothed as without it.",
    }
}

messages! {
    /// Smoothing has drawn a vessel shut.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum DrawnShut {
        /// Though it was adapted to the calibre.
        "verdict-all-but-shut" AllButShut {
            /// In mm.
            x: f32 [1],
            /// In mm.
            y: f32 [1],
            /// In mm.
            z: f32 [1],
            /// What is left of the vessel, in mm.
            diameter: f64 [2],
        } => "A vessel is all but shut at ({x:.1}, {y:.1}, {z:.1}): {diameter:.2} mm are left of it.",
        /// Its pass band is too narrow.
        "verdict-drawn-shut" TooNarrow {
            /// In mm.
            x: f32 [1],
            /// In mm.
            y: f32 [1],
            /// In mm.
            z: f32 [1],
            /// The length of the waves of which half passes, in mm.
            wave: f64 [1],
            /// The diameter of a vessel with that circumference, in mm.
            around: f64 [1],
        } =>
            "Smoothing has drawn a vessel shut at ({x:.1}, {y:.1}, {z:.1}): it takes away waves below {wave:.1} mm, the way \
             around a vessel of {around:.1} mm. A wider pass band keeps thin vessels open.",
    }
}

messages! {
    /// Where the output has narrowed a vessel most.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum NarrowedAt {
        /// Something of the vessel is left.
        "verdict-pinched-to" Pinched {
            /// Diameter before, in mm.
            before: f64 [1],
            /// Diameter that is left, in mm.
            after: f64 [1],
            /// In mm.
            x: f32 [1],
            /// In mm.
            y: f32 [1],
            /// In mm.
            z: f32 [1],
        } => "A vessel of {before:.1} mm is pinched to {after:.1} mm at ({x:.1}, {y:.1}, {z:.1}).",
        /// The vessel is gone.
        "verdict-lost-at" Lost {
            /// Diameter before, in mm.
            before: f64 [1],
            /// In mm.
            x: f32 [1],
            /// In mm.
            y: f32 [1],
            /// In mm.
            z: f32 [1],
        } => "A vessel of {before:.1} mm is lost at ({x:.1}, {y:.1}, {z:.1}).",
    }
}

messages! {
    /// The output pinches a vessel.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum Pinches {
        /// The rate at which it began, which says more.
        "verdict-sentence" First {
            /// The first of all rates.
            words: PinchMessage,
        } => "{words}.",
        /// One of several places.
        "verdict-worst-of" WorstOf {
            /// The worst.
            sentence: NarrowedAt,
            /// 2 at least.
            count: usize,
        } => { format!("{sentence} It is the worst of {} places.", grouped(count)) },
    } or {
        /// The only place.
        At(NarrowedAt),
    }
}

messages! {
    /// What made the most of a change of volume.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum VolumeCause {
        /// Smoothing, as of vessels whose circumference is shorter than the waves that it stops.
        "verdict-volume-narrow" Smoothing => "the pass band is too narrow for vessels as thin as these",
        /// The reduction.
        "verdict-volume-few" Reduction => "so few triangles do not carry this shape",
    }
}

messages! {
    /// A large change of volume.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum VolumeChange {
        /// How large.
        "verdict-volume-changed" Changed {
            /// In percent.
            change: Signed<1>,
            /// What made the most of it.
            cause: VolumeCause,
        } => "The volume changed by {change} %: {cause}.",
    }
}

messages! {
    /// The volume changed so much that the settings do not suit the surface.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum VolumeWarning {
        /// Adapting to the calibre would help.
        "verdict-volume-adapt" Adapt {
            /// The change.
            sentence: VolumeChange,
        } => "{sentence} Adapt to calibre (--smoothing auto) keeps it.",
    } or {
        /// The change alone.
        Change(VolumeChange),
    }
}

impl Report {
    /// What mending left of what it was asked to do.
    pub fn mending_warnings(&self) -> Vec<MendWarning> {
        self.mending.map_or_else(Vec::new, |done| done.warnings(&self.settings.mending))
    }

    /// Why the volume is not held, where it was to be.
    pub fn volume_held_warning(&self) -> Option<VolumeNotHeld> {
        self.volume_held.filter(|is_held| !is_held)?;
        Some(if self.smoothing_weakened.is_some() {
            VolumeNotHeld::PutBack
        } else if self.volume_change_percent.is_none() {
            VolumeNotHeld::NoVolume
        } else {
            VolumeNotHeld::Thin
        })
    }

    /// Where smoothing has drawn a vessel shut, if it has.
    pub fn smoothing_warning(&self) -> Option<DrawnShut> {
        let response = self.smoothing_response.as_ref()?;
        let lumen = self.smoothed_shape.as_ref()?.smallest_lumen?;
        let wave = response.wavelength_mm_at_half_gain?;
        if lumen.diameter_mm >= SHUT * response.edge_length_mm {
            return None;
        }
        let [x, y, z] = lumen.at_mm;
        Some(if self.settings.smoothing.adapt {
            DrawnShut::AllButShut { x, y, z, diameter: lumen.diameter_mm }
        } else {
            DrawnShut::TooNarrow { x, y, z, wave, around: wave / std::f64::consts::PI }
        })
    }

    /// Where the output pinches a vessel, if it does.
    pub fn pinch_warning(&self) -> Option<Pinches> {
        let narrowed = self.narrowing.filter(|found| found.pinched_places > 0)?;
        // The rate at which it began says more, where the search met it.
        if let Some(pinch) = self.pinch.filter(|pinch| pinch.from_percent <= self.reduction_percent + 0.05) {
            return Some(Pinches::First { words: pinch.message() });
        }
        let Narrowing { at_mm: [x, y, z], diameter_before_mm: before, diameter_after_mm: after, .. } = narrowed;
        let sentence = if after > 0.0 {
            NarrowedAt::Pinched { before, after, x, y, z }
        } else {
            NarrowedAt::Lost { before, x, y, z }
        };
        Some(match narrowed.pinched_places {
            1 => Pinches::At(sentence),
            count => Pinches::WorstOf { sentence, count },
        })
    }

    /// The change of volume, where it is so large that the settings do not suit the surface.
    pub fn volume_warning(&self) -> Option<VolumeWarning> {
        let change = self.volume_change_percent.filter(|change| change.abs() > LARGE_CHANGE)?;
        let cause = volume_cause(change, self.volume_change_from_smoothed_percent.unwrap_or(0.0));
        let sentence = VolumeChange::Changed { change: Signed(change), cause };
        Some(if cause == VolumeCause::Smoothing && !self.settings.smoothing.adapt {
            VolumeWarning::Adapt { sentence }
        } else {
            VolumeWarning::Change(sentence)
        })
    }
}

/// What made the most of a change of volume of `change` percent, of which the reduction made `reduction` percent of
/// the smoothed surface's volume.
fn volume_cause(change: f64, reduction: f64) -> VolumeCause {
    let smoothing = ((1.0 + change / 100.0) / (1.0 + reduction / 100.0) - 1.0) * 100.0;
    if smoothing.abs() >= (change - smoothing).abs() { VolumeCause::Smoothing } else { VolumeCause::Reduction }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_of_volume_is_laid_to_the_stage_that_made_most_of_it() {
        let (smoothing, reduction) = (VolumeCause::Smoothing, VolumeCause::Reduction);
        assert_eq!([volume_cause(-20.0, 0.0), volume_cause(-20.0, -20.0)], [smoothing, reduction]);
        // 100 mm3 are smoothed to 5 and reduced to 1: the reduction took four fifths of little.
        assert_eq!(volume_cause(-99.0, -80.0), smoothing);
        // 100 mm3 are smoothed to 98 and reduced to 70.
        assert_eq!(volume_cause(-30.0, (70.0 / 98.0 - 1.0) * 100.0), reduction);
    }

    #[test]
    fn sentences_repeat_what_they_are_made_of() {
        let at = NarrowedAt::Pinched { before: 2.04, after: 0.3, x: 1.0, y: -2.0, z: 3.25 };
        let expected = "A vessel of 2.0 mm is pinched to 0.3 mm at (1.0, -2.0, 3.2). It is the worst of 1,200 places.";
        assert_eq!(Pinches::WorstOf { sentence: at, count: 1200 }.to_string(), expected);
        let sentence = VolumeChange::Changed { change: Signed(-12.34), cause: VolumeCause::Smoothing };
        assert_eq!(
            VolumeWarning::Adapt { sentence }.to_string(),
            "The volume changed by -12.3 %: the pass band is too narrow for vessels as thin as these. \
             Adapt to calibre (--smoothing auto) keeps it."
        );
    }
}
