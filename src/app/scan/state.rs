//! What the app knows of a scan: what is chosen of it, what was made of that, and what is on its way.

use std::sync::Arc;

use super::{Action, KeptScan};
use crate::engine::Source;
use crate::engine::scan::{NamedFile, OpenedScan, ScanCommand, ScanEvent, ScanLink, ScanWork};
use crate::language::tell;
use crate::mesh::{Bounds, TriMesh};
use crate::say;
use crate::volume::{Axis, Cut, HalfWay, Method, PRESETS, Region, Selection, VolumeError, WINDOWS};

/// A scan that takes no more bytes than this is kept for its slices unless that is turned off.
const KEPT: u64 = 256_000_000;

/// The scan that is open, and the one that is on its way in.
#[derive(Debug, Default)]
pub struct Scans {
    /// The number of the newest command.
    number: u64,
    opening: Option<Opening>,
    open: Option<Box<OpenScan>>,
    /// The one that the surface which is open was made of.
    kept: Option<Box<KeptScan>>,
}

/// A scan that is on its way in.
#[derive(Debug)]
struct Opening {
    number: u64,
    name: String,
    files: Vec<NamedFile>,
    /// What is done now, and the part of it that is.
    progress: (ScanWork, f32),
}

/// A scan that is open.
#[derive(Debug)]
pub struct OpenScan {
    /// What it is called.
    pub name: String,
    /// What is known of it.
    pub opened: OpenedScan,
    /// Its files, for another volume of theirs.
    files: Vec<NamedFile>,
    /// What of it is the vessel.
    pub selection: Selection,
    /// Where it is looked at.
    pub region: Region,
    /// The voxel that the vessel is connected to.
    pub seed: Option<[usize; 3]>,
    /// What was found around it.
    pub half_way: Option<HalfWay>,
    /// How the surface is made.
    pub method: Method,
    /// The slice that is asked for.
    pub slice: (Axis, usize),
    /// The values that are black and white in it.
    pub window: [f64; 2],
    /// Whether it is kept for its slices once there is a surface of it.
    pub keeps: bool,
    /// The surface at reduced resolution, every how many voxels, and the box around it.
    pub preview: Option<(Arc<TriMesh>, usize, Bounds)>,
    /// The slice that has come.
    pub picture: Option<Picture>,
    /// How far the work is.
    pub progress: Option<(ScanWork, f32)>,
    /// Why there is no surface, in one sentence.
    pub problem: Option<String>,
    /// The preview that is on its way.
    awaited: Option<u64>,
    /// The surface that is on its way.
    making: Option<u64>,
    /// What the newest preview was asked for with.
    previewed: Option<Cut>,
    /// The slice that was asked for last.
    pictured: Option<(Axis, usize, [f64; 2])>,
}

/// A slice as a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Across which axis, and which.
    pub slice: (Axis, usize),
    /// The values that are black and white.
    pub window: [f64; 2],
    /// Pixels along both of its axes.
    pub size: [usize; 2],
    /// A shade of grey for each.
    pub pixels: Vec<u8>,
    /// Its width over its height in mm.
    pub aspect: f32,
}

/// What has to happen outside.
#[derive(Clone, Debug, PartialEq)]
pub enum Told {
    /// A surface was made: it is to be opened.
    Made(Source),
    /// Something could not be done: one plain sentence.
    Refused(String),
    /// The scan that was on its way in is not opened.
    Stopped,
}

impl Scans {
    /// Whether a scan is shown.
    pub fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// The scan that is shown.
    pub fn shown(&self) -> Option<&OpenScan> {
        self.open.as_deref()
    }

    /// The scan that the surface which is open was made of, where it is kept.
    pub fn kept(&self, source: Option<&Source>) -> Option<&KeptScan> {
        self.kept.as_deref().filter(|kept| is_of(kept, source))
    }

    /// Whether a slice of it is on its way.
    pub fn awaits_slice(&self) -> bool {
        self.kept.as_ref().is_some_and(|kept| kept.awaits())
    }

    /// Hears which surface is open: a scan is kept as long as it is the one that was made of it.
    pub fn surface_opened(&mut self, source: Option<&Source>, link: &mut ScanLink) {
        if self.kept.take_if(|kept| !is_of(kept, source)).is_some() {
            self.release(link);
        }
    }

    /// Frees what the engine has, unless that is to be another scan's.
    fn release(&self, link: &mut ScanLink) {
        if self.open.is_none() && self.opening.is_none() {
            link.send(ScanCommand::Close);
        }
    }

    /// The name of the scan that is on its way in, what is done with it now, and the part of that which is done.
    pub fn opening(&self) -> Option<(&str, ScanWork, f32)> {
        self.opening.as_ref().map(|Opening { name, progress: (work, fraction), .. }| (name.as_str(), *work, *fraction))
    }

    /// Reads a scan; the one that is shown stays until it is there.
    pub fn read(&mut self, files: Vec<NamedFile>, link: &mut ScanLink) {
        // The names of DICOM's files often are those of patients.
        let name = match &files[..] {
            [] => return,
            [only] => stem(&only.name).to_owned(),
            several => {
                let header = several.iter().find(|file| is_header(&file.name));
                header.map_or_else(|| say!("scan-name"), |file| stem(&file.name).to_owned())
            }
        };
        self.read_volume(name, files, None, link);
    }

    /// Reads a volume of some files.
    fn read_volume(&mut self, name: String, files: Vec<NamedFile>, volume: Option<usize>, link: &mut ScanLink) {
        self.number += 1;
        let (number, progress) = (self.number, (ScanWork::Reading, 0.0));
        self.opening = Some(Opening { number, name, files: files.clone(), progress });
        link.send(ScanCommand::Open { id: number, files, volume });
    }

    /// Does what is asked for.
    pub fn act(&mut self, action: Action, link: &mut ScanLink) {
        if action == Action::Close {
            (self.open, self.opening, self.kept) = (None, None, None);
            link.send(ScanCommand::Close);
            return;
        }
        if action == Action::Cancel && self.opening.is_some() {
            return link.send(ScanCommand::Cancel);
        }
        let Some(open) = &mut self.open else { return self.act_on_kept(action, link) };
        match action {
            Action::Volume(number) => {
                let (name, files) = (open.name.clone(), open.files.clone());
                self.read_volume(name, files, Some(number), link);
            }
            Action::Select(selection) => open.selection = selection,
            Action::Seed(seed) => {
                (open.seed, open.half_way) = (seed, None);
                if let (Some(seed), Selection::Threshold(_)) = (seed, open.selection) {
                    link.send(ScanCommand::HalfWay { seed });
                }
            }
            Action::Method(method) => open.method = method,
            Action::Bound(region) => open.region = region,
            Action::Slice(axis, index) => open.slice = (axis, index),
            Action::Window(window) => open.window = window,
            Action::Keep(keeps) => open.keeps = keeps,
            Action::Make => {
                self.number += 1;
                // A preview that is on its way gives way; after a cancel it is asked for again.
                open.previewed.take_if(|_| open.awaited.is_some());
                (open.making, open.awaited, open.problem) = (Some(self.number), None, None);
                link.send(ScanCommand::Surface { generation: self.number, cut: open.cut() });
            }
            Action::Cancel => link.send(ScanCommand::Cancel),
            Action::Close | Action::Slices(_) => {}
        }
    }

    fn act_on_kept(&mut self, action: Action, link: &mut ScanLink) {
        match (action, &mut self.kept) {
            (Action::Slices(options), Some(kept)) => kept.options = options,
            (Action::Keep(false), Some(_)) => {
                self.kept = None;
                self.release(link);
            }
            _ => {}
        }
    }

    /// Asks for a preview and a slice of what is chosen now, each once the one before is there.
    pub fn follow(&mut self, link: &mut ScanLink) {
        let Some(open) = &mut self.open else {
            if let Some(kept) = &mut self.kept {
                kept.follow(link);
            }
            return;
        };
        let wanted = open.cut();
        if open.awaited.is_none() && open.making.is_none() && open.previewed != Some(wanted) {
            self.number += 1;
            (open.awaited, open.previewed) = (Some(self.number), Some(wanted));
            link.send(ScanCommand::Preview { generation: self.number, cut: wanted, step: None });
        }
        let ((axis, index), window) = (open.slice, open.window);
        let shown = open.picture.as_ref().map(|picture| (picture.slice.0, picture.slice.1, picture.window));
        let is_pending = open.pictured.is_some() && open.pictured != shown;
        if open.pictured != Some((axis, index, window)) && !is_pending {
            open.pictured = Some((axis, index, window));
            link.send(ScanCommand::Slice { axis, index, window });
        }
    }

    /// Takes what the engine says.
    pub fn receive(&mut self, event: ScanEvent, link: &mut ScanLink) -> Option<Told> {
        if let ScanEvent::Opened(opened) = event {
            let Opening { name, files, .. } = self.opening.take_if(|opening| opening.number == opened.id)?;
            self.open = Some(Box::new(OpenScan::new(name, files, *opened)));
            self.kept = None;
            return None;
        }
        if let ScanEvent::Refused { number, sentence } = &event
            && self.opening.take_if(|opening| opening.number == *number).is_some()
        {
            return Some(Told::Refused(sentence.clone()));
        }
        if let Some(opening) = &mut self.opening {
            match event {
                ScanEvent::Progress {
                    work: work @ (ScanWork::Fetching | ScanWork::Reading | ScanWork::Surveying),
                    fraction,
                } => {
                    opening.progress = (work, fraction);
                    return None;
                }
                ScanEvent::Cancelled => {
                    self.opening = None;
                    return Some(Told::Stopped);
                }
                _ => {}
            }
        }
        let Some(open) = &mut self.open else {
            let kept = self.kept.as_mut()?;
            match event {
                ScanEvent::Slice { axis, index, size, pixels, window, corners } => {
                    kept.take((axis, index, window), size, pixels, corners);
                }
                ScanEvent::Refused { .. } => kept.refused(),
                _ => {}
            }
            return None;
        };
        match event {
            ScanEvent::Progress { work, fraction } => open.progress = Some((work, fraction)),
            ScanEvent::Preview { generation, step, mesh } if open.awaited == Some(generation) => {
                let bounds = Bounds::of(&mesh.positions);
                (open.preview, open.problem) = (Some((mesh, step, bounds)), None);
                (open.awaited, open.progress) = (None, None);
            }
            ScanEvent::Surface { generation, mesh, threshold } if open.making == Some(generation) => {
                let OpenedScan { format, axes, warnings, .. } = open.opened.clone();
                let source = Source::Made { name: open.name.clone(), format, mesh, axes, warnings, threshold };
                if let (Source::Made { mesh, .. }, true) = (&source, open.keeps) {
                    let kept = KeptScan::new(open.opened.clone(), open.is_ct(), open.window, Arc::clone(mesh));
                    self.kept = Some(Box::new(kept));
                } else {
                    link.send(ScanCommand::Close);
                }
                self.open = None;
                return Some(Told::Made(source));
            }
            ScanEvent::HalfWay { seed, found } if open.seed == Some(seed) => {
                open.half_way = found;
                match found {
                    Some(found) => open.selection = Selection::Threshold(found.threshold),
                    None => return Some(Told::Refused(tell(&VolumeError::NoEdge))),
                }
            }
            ScanEvent::Slice { axis, index, size, pixels, window, corners } => {
                let [first, across, _, down] = corners.map(glam::DVec3::from);
                let aspect = (across.distance(first) / down.distance(first).max(1e-6)) as f32;
                open.picture = Some(Picture { slice: (axis, index), window, size, pixels, aspect });
            }
            ScanEvent::Refused { number, sentence } => open.refused(number, sentence),
            ScanEvent::Cancelled => {
                // A preview that was stopped in passing is asked for again.
                open.previewed.take_if(|_| open.awaited.is_some());
                (open.making, open.awaited, open.progress) = (None, None, None);
            }
            _ => {}
        }
        None
    }

    /// The engine has died: nothing of what it had open is left. What there is to say of it, in one sentence.
    pub fn engine_failed(&mut self, reason: &str) -> String {
        (self.open, self.opening, self.kept) = (None, None, None);
        say!("scan-engine-stopped", reason = reason)
    }
}

impl OpenScan {
    fn new(name: String, files: Vec<NamedFile>, opened: OpenedScan) -> Self {
        let last = opened.dimensions.map(|along| along.saturating_sub(1));
        let [low, high] = opened.survey.range;
        let mut open = Self {
            name,
            files,
            selection: Selection::Threshold((low + high) / 2.0),
            region: Region { first: [0; 3], last },
            seed: None,
            half_way: None,
            method: Method::default(),
            slice: (Axis::K, last[2] / 2),
            window: opened.survey.bulk(),
            keeps: opened.bytes <= KEPT,
            preview: None,
            picture: None,
            progress: None,
            problem: None,
            awaited: None,
            making: None,
            previewed: None,
            pictured: None,
            opened,
        };
        let artery = Selection::Threshold(PRESETS[1].value);
        open.selection = match open.opened.proposed {
            Some(proposed) => proposed,
            None if open.is_ct() && artery.check(&open.opened.survey).is_ok() => artery,
            None => open.selection,
        };
        open.method = Method::of(open.selection);
        if open.is_ct() && !open.opened.survey.is_mask() {
            open.window = WINDOWS[0].ends;
        }
        open
    }

    /// What the surface is made of.
    fn cut(&self) -> Cut {
        Cut { selection: self.selection, region: Some(self.region), seed: self.seed, method: self.method }
    }

    /// Whether its values are Hounsfield units, as far as that can be known.
    pub fn is_ct(&self) -> bool {
        self.opened.is_ct || self.opened.survey.has_air()
    }

    /// The unit of its values, with a leading space.
    pub fn unit(&self) -> &'static str {
        if self.is_ct() { " HU" } else { "" }
    }

    /// Whether the surface is being made.
    pub fn is_making(&self) -> bool {
        self.making.is_some()
    }

    fn refused(&mut self, number: u64, sentence: String) {
        if self.awaited == Some(number) {
            (self.awaited, self.preview, self.progress) = (None, None, None);
            self.problem = Some(sentence);
        } else if self.making == Some(number) {
            (self.making, self.progress) = (None, None);
            self.problem = Some(sentence);
        }
    }
}

/// Whether a surface is the one that was made of a scan.
fn is_of(scan: &KeptScan, source: Option<&Source>) -> bool {
    matches!(source, Some(Source::Made { mesh, .. }) if scan.is_of(mesh))
}

/// A file's name without its folder and the endings that a volume has.
fn stem(path: &str) -> &str {
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    let name = name.strip_suffix(".gz").unwrap_or(name);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// Whether a name is that of a header, whose data have another.
fn is_header(name: &str) -> bool {
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
    ["mhd", "nhdr", "hdr"].iter().any(|header| ending.eq_ignore_ascii_case(header))
}
