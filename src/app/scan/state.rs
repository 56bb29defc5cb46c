//! What the app knows of a scan: what is chosen of it, what was made of that, and what is on its way.

use std::sync::Arc;

use super::Action;
use crate::engine::Source;
use crate::engine::scan::{NamedFile, OpenedScan, ScanCommand, ScanEvent, ScanLink, ScanWork};
use crate::mesh::{Bounds, TriMesh};
use crate::volume::{Axis, PRESETS, Region, Selection};

/// A volume with values down to this is taken for CT, whose files mostly do not say so: air has -1000 HU.
const AIR_HU: f64 = -500.0;
/// The values that a slice of CT is shown with: from fat to bone.
const WINDOW_HU: [f64; 2] = [-150.0, 550.0];

/// The scan that is open, and the one that is on its way in.
#[derive(Debug, Default)]
pub struct Scans {
    /// The number of the newest command.
    number: u64,
    opening: Option<(u64, String)>,
    open: Option<Box<OpenScan>>,
}

/// A scan that is open.
#[derive(Debug)]
pub struct OpenScan {
    /// What it is called.
    pub name: String,
    /// What is known of it.
    pub opened: OpenedScan,
    /// What of it is the vessel.
    pub selection: Selection,
    /// Where it is looked at.
    pub region: Region,
    /// The slice that is asked for.
    pub slice: (Axis, usize),
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
    previewed: Option<(Selection, Region)>,
    /// The slice that was asked for last.
    pictured: Option<(Axis, usize)>,
}

/// A slice as a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Across which axis, and which.
    pub slice: (Axis, usize),
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

    /// The name of the scan that is on its way in.
    pub fn opening(&self) -> Option<&str> {
        self.opening.as_ref().map(|(_, name)| name.as_str())
    }

    /// Reads a scan; the one that is shown stays until it is there.
    pub fn read(&mut self, files: Vec<NamedFile>, link: &mut ScanLink) {
        self.number += 1;
        // The names of DICOM's files often are those of patients.
        let name = match &files[..] {
            [] => return,
            [only] => stem(&only.name).to_owned(),
            several => {
                several.iter().find(|file| is_header(&file.name)).map_or("Scan", |file| stem(&file.name)).to_owned()
            }
        };
        self.opening = Some((self.number, name));
        link.send(ScanCommand::Open { id: self.number, files });
    }

    /// Does what is asked for.
    pub fn act(&mut self, action: Action, link: &mut ScanLink) {
        if action == Action::Close {
            (self.open, self.opening) = (None, None);
            link.send(ScanCommand::Close);
            return;
        }
        let Some(open) = &mut self.open else { return };
        match action {
            Action::Select(selection) => open.selection = selection,
            Action::Bound(region) => open.region = region,
            Action::Slice(axis, index) => open.slice = (axis, index),
            Action::Make => {
                self.number += 1;
                (open.making, open.awaited, open.problem) = (Some(self.number), None, None);
                let (selection, region) = (open.selection, Some(open.region));
                link.send(ScanCommand::Surface { generation: self.number, selection, region });
            }
            Action::Cancel => link.send(ScanCommand::Cancel),
            Action::Close => {}
        }
    }

    /// Asks for a preview and a slice of what is chosen now, each once the one before is there.
    pub fn follow(&mut self, link: &mut ScanLink) {
        let Some(open) = &mut self.open else { return };
        let wanted = (open.selection, open.region);
        if open.awaited.is_none() && open.making.is_none() && open.previewed != Some(wanted) {
            self.number += 1;
            (open.awaited, open.previewed) = (Some(self.number), Some(wanted));
            let (selection, region) = wanted;
            link.send(ScanCommand::Preview { generation: self.number, selection, region: Some(region), step: None });
        }
        let is_pending = open.pictured.is_some() && open.pictured != open.picture.as_ref().map(|picture| picture.slice);
        if open.pictured != Some(open.slice) && !is_pending {
            open.pictured = Some(open.slice);
            let ((axis, index), window) = (open.slice, open.window());
            link.send(ScanCommand::Slice { axis, index, window });
        }
    }

    /// Takes what the engine says.
    pub fn receive(&mut self, event: ScanEvent, link: &mut ScanLink) -> Option<Told> {
        if let ScanEvent::Opened(opened) = event {
            let (id, name) = self.opening.take()?;
            if opened.id == id {
                self.open = Some(Box::new(OpenScan::new(name, *opened)));
            }
            return None;
        }
        if let ScanEvent::Refused { number, sentence } = &event
            && self.opening.take_if(|(id, _)| id == number).is_some()
        {
            return Some(Told::Refused(sentence.clone()));
        }
        let open = self.open.as_mut()?;
        match event {
            ScanEvent::Progress { work, fraction } => open.progress = Some((work, fraction)),
            ScanEvent::Preview { generation, step, mesh } if open.awaited == Some(generation) => {
                let bounds = Bounds::of(&mesh.positions);
                (open.preview, open.problem) = (Some((mesh, step, bounds)), None);
                (open.awaited, open.progress) = (None, None);
            }
            ScanEvent::Surface { generation, mesh, .. } if open.making == Some(generation) => {
                let source = Source::Made { name: open.name.clone(), format: open.opened.format.clone(), mesh };
                self.open = None;
                link.send(ScanCommand::Close);
                return Some(Told::Made(source));
            }
            ScanEvent::Slice { axis, index, size, pixels, corners } => {
                let [first, across, _, down] = corners.map(glam::DVec3::from);
                let aspect = (across.distance(first) / down.distance(first).max(1e-6)) as f32;
                open.picture = Some(Picture { slice: (axis, index), size, pixels, aspect });
            }
            ScanEvent::Refused { number, sentence } => open.refused(number, sentence),
            ScanEvent::Cancelled => {
                (open.making, open.awaited, open.progress) = (None, None, None);
            }
            _ => {}
        }
        None
    }

    /// The engine has died: nothing of what it had open is left. What there is to say of it, in one sentence.
    pub fn engine_failed(&mut self, reason: &str) -> String {
        (self.open, self.opening) = (None, None);
        format!("The scan's engine has stopped ({reason}): open the scan again.")
    }
}

impl OpenScan {
    fn new(name: String, opened: OpenedScan) -> Self {
        let last = opened.dimensions.map(|along| along.saturating_sub(1));
        let [low, high] = opened.survey.range;
        let mut open = Self {
            name,
            selection: Selection::Threshold((low + high) / 2.0),
            region: Region { first: [0; 3], last },
            slice: (Axis::K, last[2] / 2),
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
        open
    }

    /// Whether its values are Hounsfield units, as far as that can be known.
    pub fn is_ct(&self) -> bool {
        self.opened.is_ct || self.opened.survey.range[0] <= AIR_HU
    }

    /// The unit of its values, with a leading space.
    pub fn unit(&self) -> &'static str {
        if self.is_ct() { " HU" } else { "" }
    }

    /// Whether the surface is being made.
    pub fn is_making(&self) -> bool {
        self.making.is_some()
    }

    /// The values that are black and white in a slice.
    fn window(&self) -> [f64; 2] {
        if self.is_ct() && !self.opened.survey.is_mask() { WINDOW_HU } else { self.opened.survey.range }
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
