//! Settings of the windowed-sinc filter, those that have a name, and their rows in the table of settings.

use serde::{Deserialize, Serialize};

use super::table::{CommandOption, InLink, Kind, Messages, Range, Setting};
use super::{OutOfRange, Settings};
use lumen_message::messages;

/// Settings of the windowed-sinc filter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Smoothing {
    /// The window that tapers the Chebyshev coefficients.
    pub window: Window,
    /// Pass band: eigenvalues k of the Laplacian below this pass; `0 < pass_band <= 2`, without unit.
    pub pass_band: f64,
    /// Degree of the polynomial; `0` skips smoothing.
    pub iterations: u32,
    /// What happens at open ends.
    pub boundary: Boundary,
    /// Whether the volume enclosed, open ends capped, is held to 0.01 % of what it was.
    #[serde(default)]
    pub preserve_volume: bool,
    /// Whether each vessel is smoothed by a pass band that leaves it its calibre: nowhere less than [`Self::pass_band`].
    #[serde(default)]
    pub adapt: bool,
    /// Whether the filter is weakened where it would make triangles cross that did not.
    #[serde(default)]
    pub guard: bool,
    /// Whether flat caps of a closed surface stay flat, with their areas, in smoothing and in decimation.
    #[serde(default)]
    pub hold_caps: bool,
}

impl Smoothing {
    /// The range of the pass band.
    pub const PASS_BAND: std::ops::RangeInclusive<f64> = 0.001..=2.0;
    /// The largest number of iterations.
    pub const MAX_ITERATIONS: u32 = 200;

    /// The setting that the paper chose: Hamming window, pass band 0.01, 100 iterations, the same everywhere.
    pub const PAPER: Self = Self {
        window: Window::Hamming,
        pass_band: 0.01,
        iterations: 100,
        boundary: Boundary::Loop,
        preserve_volume: false,
        adapt: false,
        guard: false,
        hold_caps: false,
    };

    /// What suits a surface whatever its calibres: as [`Self::PAPER`] where vessels are wide, and nowhere so much that a
    /// vessel loses its calibre, triangles cross or a flat cap is rounded.
    pub const AUTO: Self = Self { adapt: true, guard: true, hold_caps: true, ..Self::PAPER };

    /// No smoothing.
    pub const NONE: Self = Self { iterations: 0, ..Self::AUTO };
}

impl Default for Smoothing {
    /// [`Self::AUTO`].
    fn default() -> Self {
        Self::AUTO
    }
}

impl Smoothing {
    /// Whether these make the same surface and levels: without iterations, only whether caps are held matters.
    pub fn gives_same(&self, other: &Self) -> bool {
        self == other || (self.iterations == 0 && other.iterations == 0 && self.hold_caps == other.hold_caps)
    }
}

messages! {
    /// Settings of the filter that have a name. Its words are what it is called where a user chooses.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum Preset {
        /// [`Smoothing::AUTO`].
        #[default]
        "panel-preset-auto" Auto => "Suits this surface",
        /// [`Smoothing::PAPER`].
        "panel-preset-paper" Paper => "The paper's",
        /// [`Smoothing::NONE`].
        "panel-preset-none" None => "None",
    }
}

impl Preset {
    /// All, the default first.
    pub const ALL: [Self; 3] = [Self::Auto, Self::Paper, Self::None];

    /// The preset's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Paper => "paper",
            Self::None => "none",
        }
    }

    /// The settings.
    pub fn smoothing(self) -> Smoothing {
        match self {
            Self::Auto => Smoothing::AUTO,
            Self::Paper => Smoothing::PAPER,
            Self::None => Smoothing::NONE,
        }
    }

    /// The one that makes the same surface as `smoothing`, if one does.
    pub fn of(smoothing: &Smoothing) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.smoothing().gives_same(smoothing))
    }
}

/// The window of the windowed-sinc filter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Window {
    /// 0.54 + 0.46 cos t: the paper's.
    #[default]
    Hamming,
    /// 0.5 + 0.5 cos t.
    Hanning,
    /// 0.42 + 0.5 cos t + 0.08 cos 2t.
    Blackman,
    /// Four terms, the lowest side lobes.
    Nuttall,
}

impl Window {
    /// All windows, the default first.
    pub const ALL: [Self; 4] = [Self::Hamming, Self::Hanning, Self::Blackman, Self::Nuttall];
    /// Their names.
    const NAMES: [&'static str; 4] = ["Hamming", "Hanning", "Blackman", "Nuttall"];

    /// What the cosines of 0, t, 2t and so on are multiplied by; their sum is the window at t, 0 to pi.
    pub fn terms(self) -> &'static [f64] {
        match self {
            Self::Hamming => &[0.54, 0.46],
            Self::Hanning => &[0.5, 0.5],
            Self::Blackman => &[0.42, 0.5, 0.08],
            Self::Nuttall => &[0.355768, 0.487396, 0.144232, 0.012604],
        }
    }

    /// The window's name.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// What the filter does at the boundary of an open surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Boundary {
    /// A boundary vertex is smoothed along its loop: its neighbours are the two on the boundary.
    #[default]
    Loop,
    /// VTK's rule, for comparison: as `Loop`, but a vertex where the boundary turns by more than 15 degrees stays.
    Vtk15,
}

impl Boundary {
    /// Both, the default first.
    pub const ALL: [Self; 2] = [Self::Loop, Self::Vtk15];
    /// Their names.
    const NAMES: [&'static str; 2] = ["Loop", "Vtk15"];
}

/// Without iterations the rest of the filter does not matter.
fn smooths(settings: &Settings) -> bool {
    settings.smoothing.iterations > 0
}

/// The rows of [`Smoothing`].
pub(super) static ROWS: [Setting; 8] = [
    Setting {
        key: "window",
        field: "smoothing.window",
        kind: Kind::Choice {
            names: &Window::NAMES,
            index: |settings| settings.smoothing.window as usize,
            choose: |settings, i| settings.smoothing.window = Window::ALL[i],
        },
        in_link: InLink::Always,
        matters: smooths,
        option: CommandOption { value: "NAME", help: "Window of the smoothing filter [hamming]" },
        messages: Messages { label: "panel-window", help: "panel-window-help", said: "compare-window", refused: None },
    },
    Setting {
        key: "pass-band",
        field: "smoothing.pass_band",
        kind: Kind::Number {
            at: |settings| &mut settings.smoothing.pass_band,
            range: Range { bounds: Smoothing::PASS_BAND, unit: "", decimals: 4, logarithmic: true },
        },
        in_link: InLink::Always,
        matters: smooths,
        option: CommandOption {
            value: "F",
            help: "Pass band of the smoothing filter, 0.001 to 2; with auto that of wide vessels [auto and paper: 0.01]",
        },
        messages: Messages {
            label: "panel-pass-band",
            help: "panel-pass-band-help",
            said: "compare-pass-band",
            refused: Some(|value| OutOfRange::PassBand { value }),
        },
    },
    Setting {
        key: "iterations",
        field: "smoothing.iterations",
        kind: Kind::Count {
            at: |settings| &mut settings.smoothing.iterations,
            range: Range { bounds: 0.0..=Smoothing::MAX_ITERATIONS as f64, unit: "", decimals: 0, logarithmic: false },
        },
        in_link: InLink::Always,
        matters: smooths,
        option: CommandOption {
            value: "N",
            help: "Iterations of the smoothing filter, 0 to 200; 0 skips smoothing [auto and paper: 100]",
        },
        messages: Messages {
            label: "panel-iterations",
            help: "panel-iterations-help",
            said: "compare-iterations",
            refused: Some(|value| OutOfRange::Iterations { value }),
        },
    },
    Setting {
        key: "boundary",
        field: "smoothing.boundary",
        kind: Kind::Choice {
            names: &Boundary::NAMES,
            index: |settings| settings.smoothing.boundary as usize,
            choose: |settings, i| settings.smoothing.boundary = Boundary::ALL[i],
        },
        in_link: InLink::Always,
        matters: smooths,
        option: CommandOption {
            value: "NAME",
            help: "What the filter does at open ends: loop smooths along them; vtk15 as VTK, which holds vertices where they \
                   turn by more than 15 degrees [loop]",
        },
        messages: Messages { label: "", help: "", said: "compare-boundary", refused: None },
    },
    Setting {
        key: "preserve-volume",
        field: "smoothing.preserve_volume",
        kind: Kind::Switch { at: |settings| &mut settings.smoothing.preserve_volume },
        in_link: InLink::Always,
        matters: smooths,
        option: CommandOption {
            value: "",
            help: "Hold the volume to 0.01 % of what it is before smoothing, open ends capped",
        },
        messages: Messages {
            label: "panel-volume-held",
            help: "panel-volume-held-help",
            said: "compare-volume-preserved",
            refused: None,
        },
    },
    Setting {
        key: "adapt",
        field: "smoothing.adapt",
        kind: Kind::Switch { at: |settings| &mut settings.smoothing.adapt },
        in_link: InLink::Always,
        matters: smooths,
        option: CommandOption {
            value: "",
            help: "Smooth all vessels by the same pass band, though thin ones lose their calibre",
        },
        messages: Messages { label: "panel-adapt", help: "panel-adapt-help", said: "compare-adapted", refused: None },
    },
    Setting {
        key: "guard",
        field: "smoothing.guard",
        kind: Kind::Switch { at: |settings| &mut settings.smoothing.guard },
        in_link: InLink::Always,
        matters: smooths,
        option: CommandOption { value: "", help: "Let smoothing make triangles cross" },
        messages: Messages {
            label: "panel-guard",
            help: "panel-guard-help",
            said: "compare-no-crossing",
            refused: None,
        },
    },
    Setting {
        key: "hold-caps",
        field: "smoothing.hold_caps",
        kind: Kind::Switch { at: |settings| &mut settings.smoothing.hold_caps },
        in_link: InLink::Changed,
        matters: |_| true,
        option: CommandOption { value: "", help: "Treat the flat caps of closed vessels as any wall" },
        messages: Messages {
            label: "panel-hold-caps",
            help: "panel-hold-caps-help",
            said: "compare-caps-held",
            refused: None,
        },
    },
];
