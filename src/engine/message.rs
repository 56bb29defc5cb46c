//! What passes between the app and the engine: it can cross between threads that share no memory, large arrays as buffers
//! of their own ([`transfer`](crate::transfer)).

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::found::{
    Averaged, Calibre, Compared, CutsPlanned, Deviated, Differed, FaultsFound, FilesCompared, LevelArrays, Opened,
    Reduced, SolverReady,
};
use super::source::Source;
use super::surfaces::surface;
use crate::io::{Axes, Format};
use crate::language::tell;
use crate::mesh::TriMesh;
use crate::pipeline::beside::{Align, FileFrame};
use crate::pipeline::connectivity::Component;
use crate::pipeline::report::Report;
use crate::pipeline::safe::Safe;
use crate::pipeline::settings::Settings;
use crate::pipeline::stage::Stage;
use crate::prepare::Patch;
use crate::prepare::prepare::Plan;
use crate::prepare::write::SolverFormat;
use crate::report::{Heading, ReportFormat};
use crate::say;
use crate::sharing::Digest;
use crate::sharing::measures::Measure;
use crate::transfer::{bulk, optional};
use crate::vessel::CentrelineFormat;

/// What the engine is asked to do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Command {
    /// Read a surface and run the pipeline on it.
    Open {
        /// Comes back with the answer, and with the results until the settings change: it is counted with the
        /// generations.
        id: u64,
        /// Where from.
        source: Source,
        /// The settings to begin with.
        settings: Settings,
    },
    /// Change the settings of what is open; passed over where nothing is yet.
    Set {
        /// Comes back with the results; each command's is larger than the one before.
        generation: u64,
        /// All of them.
        settings: Settings,
    },
    /// Run the pipeline at several settings of the open surface beside the ones in force, once these are done with,
    /// in place of what was compared before. Forgotten when another surface is opened, and by a cancel.
    Compare {
        /// Comes back with the answers; counted with the generations.
        id: u64,
        /// The settings, each of which is answered once; none to stop.
        settings: Vec<Settings>,
    },
    /// Measure how far a compared surface is from the first of them, in place of what was measured so before. Forgotten
    /// by a cancel.
    Differ {
        /// Comes back with the answer; counted with the generations.
        id: u64,
        /// The first.
        #[serde(with = "surface")]
        first: Arc<TriMesh>,
        /// The other.
        #[serde(with = "surface")]
        other: Arc<TriMesh>,
    },
    /// Smooth what is kept of the surface that is open by so many passes of plain Laplacian smoothing, in place of what was
    /// asked for so before: only to be shown.
    Average {
        /// Comes back with the answer; counted with the generations.
        id: u64,
        /// From 0.
        passes: u32,
    },
    /// Make a surface ready for a solver, in place of what was asked for so before. Forgotten by a cancel.
    Prepare {
        /// Comes back with the answer; counted with the generations.
        id: u64,
        /// The surface.
        #[serde(with = "surface")]
        mesh: Arc<TriMesh>,
        /// What is done to it.
        plan: Plan,
    },
    /// Turn the surface that was made ready last into a file.
    WriteSolver {
        /// That of the command that made it.
        id: u64,
        /// The name of the file, with extension.
        name: String,
        /// Its format.
        format: SolverFormat,
        /// The names of the patches, the wall first.
        names: Vec<String>,
    },
    /// Stop, and go back to the last result; nothing goes on until there are other settings.
    Cancel,
    /// Turn the centrelines of the surface that is open into a file.
    WriteCentrelines {
        /// The name of the file, with extension.
        name: String,
        /// Its format.
        format: CentrelineFormat,
    },
    /// Turn the newest level of the surface that is open into a file: for a page whose program has stopped, which has no
    /// surface to send (`www/boot.js` says this by itself).
    WriteLevel {
        /// The name of the file, with extension.
        name: String,
        /// Its format.
        format: Format,
    },
    /// Make a report on the surface that is open.
    WriteReport {
        /// The name of the file, with extension.
        name: String,
        /// What it is written as.
        format: ReportFormat,
        /// What stands at its head.
        heading: Heading,
        /// What the surface's coordinates grow towards.
        axes: Axes,
        /// What a user has measured.
        measures: Vec<Measure>,
        /// The patches of the level as it was made ready for a solver, under their names; none where it was not.
        patches: Vec<Patch>,
        /// Its pictures.
        pictures: Vec<Frame>,
    },
    /// Take the next frame of a picture, the last of which completes the file (PNG).
    WriteFrame {
        /// The name of the file, with extension.
        name: String,
        /// Its number, from 0, which begins another picture.
        index: u32,
        /// How many there are.
        count: u32,
        /// Whether the picture has an alpha channel.
        has_alpha: bool,
        /// The frame.
        frame: Frame,
    },
    /// Turn a surface into a file.
    Write {
        /// The name of the file, with extension.
        name: String,
        /// Its format.
        format: Format,
        /// The surface.
        #[serde(with = "surface")]
        mesh: TriMesh,
        /// What its coordinates grow towards.
        axes: Axes,
        /// What those of the file are to grow towards.
        to: Axes,
    },
    /// Turn the newest level of the surface that is open and coarser ones into a GLB file.
    WriteLevels {
        /// The name of the file, with extension.
        name: String,
        /// What the coordinates of the surface grow towards.
        axes: Axes,
        /// What those of the file are to grow towards.
        to: Axes,
    },
    /// Compare a surface with another file, in place of what was compared so before. Forgotten by a cancel.
    Beside {
        /// Comes back with the answer; counted with the generations.
        id: u64,
        /// What it is compared with.
        reference: Source,
        /// The surface.
        #[serde(with = "surface")]
        mesh: Arc<TriMesh>,
        /// Whose it is.
        of: Judged,
        /// How it is moved first.
        align: Align,
        /// The change of a vessel's radius that counts as kept, in percent.
        tolerance_percent: f64,
    },
    /// Find where the ends of a surface are cut, and what goes, in place of what was to be made ready or planned before.
    /// Forgotten by a cancel.
    PlanCuts {
        /// Comes back with the answer; counted with the generations.
        id: u64,
        /// The surface.
        #[serde(with = "surface")]
        mesh: Arc<TriMesh>,
        /// What is to be done to it.
        plan: Plan,
    },
}

/// Whose surface is compared with a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Judged {
    /// Its name.
    pub name: String,
    /// The hash of its file, where it is as that has it.
    pub digest: Option<Digest>,
    /// Where its coordinates lie.
    pub frame: FileFrame,
}

/// A picture that was drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// What it shows.
    pub caption: String,
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Red, green, blue and alpha of each pixel, from the top left.
    #[serde(with = "bulk")]
    pub rgba: Vec<u8>,
}

/// What the engine is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Work {
    /// Reading a file or making a sample.
    Reading,
    /// A stage of the pipeline.
    Stage(Stage),
    /// The pipeline at several settings.
    Comparing,
    /// Comparing a surface with another file.
    Beside,
    /// Making a level ready for a solver.
    Preparing,
}

impl Work {
    /// What the work is called while it goes on, in the language that is spoken.
    pub fn label(self) -> String {
        match self {
            Self::Reading => say!("panel-work-reading"),
            Self::Stage(stage) => tell(&stage),
            Self::Comparing => say!("panel-work-comparing"),
            Self::Beside => say!("reference-work"),
            Self::Preparing => say!("solver-work"),
        }
    }

    /// Whether it only adds numbers to a level that is shown already, with its deviation.
    pub fn adds_to_what_is_shown(self) -> bool {
        matches!(self, Self::Stage(Stage::Arrays | Stage::SmoothedMeasures | Stage::Measures))
    }
}

/// What the engine has to say.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Event {
    /// A surface is open; its pieces and results follow.
    Opened(Box<Opened>),
    /// A surface could not be read; what was open still is.
    OpenFailed {
        /// That of the command.
        id: u64,
        /// The surface's name.
        name: String,
        /// One plain sentence.
        message: String,
    },
    /// What goes through the stages is another surface than it was: the open one mended, or as it was opened again. Its
    /// pieces follow.
    Mended {
        /// All of it.
        #[serde(with = "surface")]
        mesh: Arc<TriMesh>,
    },
    /// What is wrong with the surface as it was opened; it is looked for in the background.
    Faults(Box<FaultsFound>),
    /// The pieces of the open surface.
    Pieces {
        /// The piece of each triangle.
        #[serde(with = "bulk")]
        labels: Vec<u32>,
        /// The pieces.
        components: Vec<Component>,
    },
    /// How far the work is.
    Progress {
        /// What is being done.
        work: Work,
        /// The part of it that is done, 0 to 1.
        fraction: f32,
    },
    /// New levels.
    Reduced(Box<Reduced>),
    /// The numbers of the level that the settings ask for.
    Measured {
        /// That of the settings.
        generation: u64,
        /// Whether the deviation is among them.
        complete: bool,
        /// The numbers, but for those of the vessels, which come by themselves.
        report: Box<Report>,
        /// How far a reduction is safe, once it is known.
        safe: Option<Box<Safe>>,
        /// For each node of the level, the mean deviation around it, in mm; empty until `complete`. `None`: as in the
        /// event before.
        #[serde(with = "optional")]
        deviation: Option<Vec<f32>>,
    },
    /// More of the deviation of the level that the settings ask for; after its numbers.
    Deviated(Box<Deviated>),
    /// What the file says of the level that the settings ask for; only where it says something.
    LevelArrays(Box<LevelArrays>),
    /// What the level that the settings ask for makes of the vessels; it is measured in the background.
    Certified(Box<Calibre>),
    /// The work was stopped; these settings, and their results, are in force.
    Cancelled {
        /// That of the settings.
        generation: u64,
        /// All of them.
        settings: Settings,
    },
    /// One of the settings to compare is done with.
    Compared(Box<Compared>),
    /// A surface is ready for a solver, or cannot be made so.
    Prepared(Box<SolverReady>),
    /// How far a compared surface is from the first.
    Differed(Box<Differed>),
    /// The surface that is open, smoothed by plain Laplacian passes.
    Averaged(Box<Averaged>),
    /// One of the settings to compare cannot be worked on.
    NotCompared {
        /// That of the command.
        id: u64,
        /// Which of its settings.
        index: u32,
        /// One plain sentence.
        message: String,
    },
    /// A file is ready.
    Written {
        /// Its name.
        name: String,
        /// Its bytes.
        #[serde(with = "bulk")]
        bytes: Vec<u8>,
        /// A sentence on what is not in it that is shown, if anything is.
        left_out: Option<String>,
    },
    /// A file could not be made.
    NotWritten {
        /// Its name.
        name: String,
        /// One plain sentence.
        message: String,
    },
    /// Something could not be done; what was there before still is.
    Failed {
        /// One plain sentence.
        message: String,
    },
    /// A surface was compared with another file, or cannot be.
    Beside(Box<FilesCompared>),
    /// Where the ends of a surface are cut, or why none is.
    CutsPlanned(Box<CutsPlanned>),
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::engine::Engine;
    use crate::io::{ImportOptions, ScanWarning, ThresholdReport};
    use crate::phantom::Sample;
    use crate::pipeline::settings::Keep;
    use crate::transfer::sent;

    #[test]
    fn every_event_of_a_run_and_every_command_comes_through_unchanged() {
        let mut engine = Engine::new();
        let stl = {
            let sample = crate::phantom::generate(Sample::Aorta, 10_000).unwrap();
            Arc::new(crate::io::write(&sample, None, Format::Stl).unwrap())
        };
        let mesh = TriMesh { positions: vec![glam::Vec3::X; 3], triangles: vec![[0, 1, 2]] };
        let source = Source::File { name: "a.stl".into(), bytes: stl, options: ImportOptions::default() };
        let bad = Source::File { name: "b.stl".into(), bytes: Arc::new(vec![0; 3]), options: ImportOptions::default() };
        let sphere = crate::mesh::shapes::icosphere(1, 30.0, glam::Vec3::ZERO);
        let small = Arc::new(sphere.clone());
        let tube = Arc::new(crate::mesh::shapes::tube(24, 40, 40.0, |_| 2.0));
        let made = Source::Made {
            name: "d".into(),
            format: "DICOM".into(),
            mesh: Arc::new(sphere),
            axes: Axes::Lps,
            warnings: vec![ScanWarning::Silent { format: "DICOM".into() }.into()],
            threshold: Some(ThresholdReport { value: 180.0, lower_mm: 0.1, higher_mm: -0.1 }),
        };
        let holed = crate::mesh::shapes::icosphere(3, 30.0, glam::Vec3::ZERO).filtered(|t| t != 7);
        let holed = Source::Made {
            name: "e".into(),
            format: "DICOM".into(),
            mesh: Arc::new(holed),
            axes: Axes::Unknown,
            warnings: Vec::new(),
            threshold: None,
        };
        let mending = crate::pipeline::settings::Mending { fill_mm: Some(50.0), ..Default::default() };
        let settings = Settings::default();
        let frame = Frame { caption: "c".into(), width: 1, height: 1, rgba: vec![1, 2, 3, 4] };
        let impossible = Settings { keep: Keep::Component(10_000), ..Settings::default() };
        let commands = [
            Command::Open { id: 1, source, settings: settings.clone() },
            Command::Open { id: 2, source: bad, settings: settings.clone() },
            Command::Write { name: "c.stl".into(), format: Format::Stl, mesh, axes: Axes::Lps, to: Axes::Ras },
            Command::WriteCentrelines { name: "c.vtp".into(), format: CentrelineFormat::Vtp },
            Command::WriteReport {
                name: "c.pdf".into(),
                format: ReportFormat::Pdf,
                heading: Heading { date: "2026-11-26".into(), comment: "a\nb".into(), ..Heading::default() },
                axes: Axes::Lps,
                measures: vec![Measure {
                    name: "Ruler 1".into(),
                    made_on: crate::sharing::measures::MadeOn::Opened,
                    found: crate::sharing::measures::Found::Ruler { ends_mm: [[0.0; 3], [1.0; 3]] },
                }],
                patches: vec![Patch::wall()],
                pictures: vec![frame.clone()],
            },
            Command::WriteFrame { name: "c.png".into(), index: 0, count: 1, has_alpha: true, frame },
            Command::Set { generation: 3, settings: settings.clone() },
            Command::Open { id: 7, source: holed, settings: Settings { mending, ..settings.clone() } },
            Command::Compare { id: 4, settings: vec![settings.clone(), impossible] },
            Command::Beside {
                id: 12,
                reference: Source::Sample { sample: Sample::Aorta, triangles: 10_000 },
                mesh: small.clone(),
                of: Judged { name: "s".into(), digest: None, frame: FileFrame::default() },
                align: Align::Rigid,
                tolerance_percent: 2.0,
            },
            Command::Differ { id: 8, first: small.clone(), other: small },
            Command::Average { id: 9, passes: 3 },
            Command::Prepare { id: 10, mesh: tube.clone(), plan: Plan::flow() },
            Command::PlanCuts { id: 13, mesh: tube, plan: Plan::flow() },
            Command::WriteLevels { name: "c.glb".into(), axes: Axes::Lps, to: Axes::Ras },
            Command::WriteSolver { id: 10, name: "c.msh".into(), format: SolverFormat::Msh, names: vec!["w".into()] },
            Command::Cancel,
            Command::Open { id: 6, source: made, settings: settings.clone() },
            Command::Open { id: 5, source: Source::sample(Sample::Coronary), settings },
        ];
        let mut kinds = std::collections::BTreeSet::new();
        for command in commands {
            let (head, arrived) = sent(&command);
            assert_eq!(arrived.unwrap(), command);
            // A test in the browser watches for these two (responsiveness.test.mjs).
            assert_eq!(head == [7], command == Command::Cancel);
            if matches!(command, Command::Open { id: 5, .. }) {
                break;
            }
            engine.handle(command);
            while engine.advance(Duration::from_millis(1)) {}
            while let Some(event) = engine.poll() {
                let text = format!("{event:?}");
                kinds.insert(text.split(|c: char| !c.is_alphabetic()).next().unwrap_or_default().to_owned());
                let (head, arrived) = sent(&event);
                assert_eq!(arrived.unwrap(), event);
                assert_eq!(head.first() == Some(&11), matches!(event, Event::Cancelled { .. }));
            }
        }
        let expected = [
            "Averaged",
            "Beside",
            "Cancelled",
            "Certified",
            "Compared",
            "CutsPlanned",
            "Differed",
            "Faults",
            "Measured",
            "Mended",
            "NotCompared",
            "OpenFailed",
            "Opened",
            "Pieces",
            "Prepared",
            "Reduced",
            "Written",
        ];
        assert!(expected.iter().all(|kind| kinds.contains(*kind)), "{kinds:?}");
    }
}
