//! The surface that is open, as the app sees it: its pieces, its levels, the numbers.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::sync::Arc;

use crate::engine::{Averaged, Calibre, Deviated, FaultsFound, LevelArrays, Opened, Reduced, Source};
use crate::io::{Axes, Format, ImportReport};
use crate::mesh::{Bounds, TriMesh, compacted, used_vertices};
use crate::pipeline::classes::Classes;
use crate::pipeline::connectivity::Component;
use crate::pipeline::pinch::Pinch;
use crate::pipeline::progressive::{Level, ProgressiveMesh};
use crate::pipeline::report::Report;
use crate::pipeline::safe::Safe;
use crate::pipeline::settings::{Keep, Target};
use crate::sharing::Digest;

/// The pieces of the surface.
#[derive(Clone, Debug, Default)]
pub struct Pieces {
    /// The piece of each triangle of the opened surface.
    pub labels: Vec<u32>,
    /// The pieces, numbered by their first triangle.
    pub list: Vec<Component>,
    /// Their numbers, the largest first.
    pub by_size: Vec<u32>,
}

impl Pieces {
    /// Whether `piece` is one of those that `keep` names.
    pub fn is_kept(&self, keep: Keep, piece: u32) -> bool {
        keep.names(piece, self.by_size.first().copied())
    }

    /// The pieces that `keep` names.
    pub fn kept(&self, keep: Keep) -> impl Iterator<Item = &Component> {
        (0..).zip(&self.list).filter(move |(piece, _)| self.is_kept(keep, *piece)).map(|(_, found)| found)
    }

    /// Whether triangle `t` of the opened surface is of what `keep` names: each is, until the pieces are known.
    pub fn keeps(&self, keep: Keep, t: usize) -> bool {
        self.labels.get(t).is_none_or(|&piece| self.is_kept(keep, piece))
    }

    /// Whether what `keep` names is there.
    pub fn has(&self, keep: Keep) -> bool {
        keep.numbers().iter().all(|&piece| (piece as usize) < self.list.len())
    }

    /// What keeps this piece and no other.
    pub fn only(&self, piece: u32) -> Keep {
        if self.by_size.first() == Some(&piece) { Keep::Largest } else { Keep::Component(piece) }
    }

    /// What keeps this piece besides those that `keep` names, or no longer; `keep` where none would be left, or more would be
    /// than can be named.
    pub fn toggled(&self, keep: Keep, piece: u32) -> Keep {
        let will_be = |of: &u32| self.is_kept(keep, *of) != (*of == piece);
        let numbers: Vec<u32> = (0..self.list.len() as u32).filter(will_be).collect();
        match numbers[..] {
            [one] => self.only(one),
            _ if numbers.len() == self.list.len() => Keep::All,
            _ => Keep::pieces(&numbers).unwrap_or(keep),
        }
    }
}

/// The level that is shown.
#[derive(Clone, Debug)]
pub struct Shown {
    /// Its triangles, over the nodes of the progressive mesh.
    pub level: Level,
    /// Vertices in use.
    pub vertices: usize,
    /// The classes of its vertices, once something has asked for them.
    classes: OnceCell<Classes>,
}

/// The numbers of a level.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The settings they belong to.
    pub generation: u64,
    /// All numbers.
    pub report: Report,
    /// How far a reduction is safe, once it is known.
    pub safe: Option<Box<Safe>>,
    /// For each node of the level, the mean deviation around it, in mm; empty until it is known.
    pub deviation: Vec<f32>,
}

/// An open surface.
#[derive(Clone, Debug)]
pub struct Document {
    /// Where it comes from, for when the engine has to be started again.
    pub source: Source,
    /// What it is called.
    pub name: String,
    /// By what its file is known; a sample is known by its name.
    pub digest: Option<Digest>,
    /// What was found and mended when it was opened.
    pub import: ImportReport,
    /// Whether the file itself says which way its axes point.
    pub states_axes: bool,
    /// All of it, mended where that was asked for.
    pub opened: Arc<TriMesh>,
    /// What is wrong with it as the file has it, once that is known.
    pub faults: Option<Box<FaultsFound>>,
    /// Its pieces.
    pub pieces: Pieces,
    /// All levels, once they are there, and the pieces they are made from.
    pub levels: Option<(Keep, Arc<ProgressiveMesh>)>,
    /// Vertices of the finest level.
    pub entering_vertices: usize,
    /// The level that is shown.
    pub shown: Option<Shown>,
    /// The newest numbers.
    pub measured: Option<Measured>,
    /// What the level of the newest settings of which that is known makes of the vessels.
    pub calibre: Option<Arc<Calibre>>,
    /// More of the deviation of the level of the newest settings of which that is known.
    deviated: Option<Box<Deviated>>,
    /// What the file says of the level of the newest settings of which that is known.
    carried: Option<Box<LevelArrays>>,
    /// How often a level was looked up.
    #[cfg(test)]
    pub lookups: u32,
    /// The level of these levels, in steps, that the engine has found for a target which they alone do not say the level of.
    found: Option<(Target, u32)>,
    /// What the level that is shown was looked up for, as long as looking again would find the same.
    asked: Option<Target>,
    /// What plain Laplacian smoothing makes of the surface, where that is shown beside the level.
    averaged: Option<Box<Averaged>>,
    /// Counts up whenever the opened surface, the levels, the shown level and the numbers change: what is drawn
    /// compares them with those it was drawn from.
    pub revision: Revision,
}

/// How often each part of a document has changed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Revision {
    /// The document itself.
    pub document: u64,
    /// The opened surface and its pieces.
    pub opened: u64,
    /// What is shown in its place.
    pub averaged: u64,
    /// All levels.
    pub levels: u64,
    /// The level that is shown.
    pub shown: u64,
    /// The numbers.
    pub measured: u64,
}

impl Document {
    /// A surface that was just opened.
    pub fn new(source: Source, opened: Opened) -> Self {
        let Opened { id, name, digest, report, mesh } = opened;
        Self {
            source,
            name,
            digest,
            states_axes: report.axes != Axes::Unknown,
            import: report,
            opened: mesh,
            faults: None,
            pieces: Pieces::default(),
            levels: None,
            entering_vertices: 0,
            shown: None,
            measured: None,
            calibre: None,
            deviated: None,
            carried: None,
            averaged: None,
            #[cfg(test)]
            lookups: 0,
            found: None,
            asked: None,
            revision: Revision { document: id, ..Revision::default() },
        }
    }

    /// Takes another surface in place of the opened one; its pieces follow.
    pub fn set_mended(&mut self, mesh: Arc<TriMesh>) {
        self.opened = mesh;
        self.set_averaged(None);
        self.pieces = Pieces::default();
        self.revision.opened += 1;
    }

    /// Takes the pieces.
    pub fn set_pieces(&mut self, labels: Vec<u32>, list: Vec<Component>) {
        let mut by_size: Vec<u32> = (0..list.len() as u32).collect();
        by_size.sort_by_key(|&piece| (std::cmp::Reverse(list[piece as usize].triangles), piece));
        self.pieces = Pieces { labels, list, by_size };
        self.revision.opened += 1;
    }

    /// Takes new levels and shows the one that `target` asks for. What the numbers say of places on older levels is
    /// forgotten; the rest of them stands until there are new ones.
    pub fn set_levels(&mut self, reduced: Reduced, target: Target) {
        self.entering_vertices = reduced.vertices;
        self.levels = Some((reduced.keep, reduced.mesh));
        self.revision.levels += 1;
        (self.found, self.asked) = (None, None);
        if let Some(measured) = &mut self.measured {
            measured.deviation.clear();
            measured.report.pinch = None;
            self.revision.measured += 1;
        }
        // Its nodes are those of other levels; the numbers stand until there are new ones.
        if let Some(calibre) = &mut self.calibre {
            Arc::make_mut(calibre).change_by_node.clear();
        }
        self.shown = None;
        self.show(target);
    }

    /// Shows the level that `target` asks for. Takes a millisecond or so. Which one that is for a bound on the
    /// deviation and for auto the engine has to find: until then what is shown stays, or is an estimate for new levels.
    pub fn show(&mut self, target: Target) {
        if self.asked == Some(target) {
            return;
        }
        let Some((_, levels)) = &self.levels else { return };
        self.asked = Some(target);
        #[cfg(test)]
        {
            self.lookups += 1;
        }
        match self.found {
            Some((of, steps)) if of == target => {
                let is_it = |shown: &Shown| shown.level.steps == steps && shown.level.shortfall.is_none();
                if !self.shown.as_ref().is_some_and(is_it) {
                    self.set_shown(levels.level_after(steps));
                }
            }
            _ if target.is_searched() && self.shown.is_some() => {}
            _ => self.set_shown(levels.level(target)),
        }
    }

    /// Shows the level that the engine has found for the newest target that it has searched for.
    pub fn show_found(&mut self) {
        if let Some((target, _)) = self.found {
            self.show(target);
        }
    }

    fn set_shown(&mut self, level: Level) {
        let Some((_, levels)) = &self.levels else { return };
        // Of the same levels: new ones come with none shown.
        let is_it = |shown: &Shown| shown.level.steps == level.steps && shown.level.shortfall == level.shortfall;
        if !self.shown.as_ref().is_some_and(is_it) {
            let vertices = used_vertices(levels.positions.len(), &level.triangles).len();
            self.shown = Some(Shown { level, vertices, classes: OnceCell::new() });
            self.revision.shown += 1;
        }
    }

    /// Takes numbers; without a `deviation` by node the one that is known still stands.
    pub fn set_measured(
        &mut self,
        generation: u64,
        report: Report,
        safe: Option<Box<Safe>>,
        deviation: Option<Vec<f32>>,
    ) {
        let steps = report.bound.map(|bound| bound.steps).or(report.auto.map(|auto| auto.steps));
        if let Some(steps) = steps {
            if self.found.is_some_and(|(target, before)| target == report.settings.target && before != steps) {
                // It was of the level before, by the same settings.
                self.calibre = None;
            }
            self.found = Some((report.settings.target, steps));
            self.asked = None;
        }
        let before = self.measured.take().map(|measured| measured.deviation);
        let deviation = deviation.or(before).unwrap_or_default();
        self.measured = Some(Measured { generation, report, safe, deviation });
        self.revision.measured += 1;
    }

    /// Takes what a level makes of the vessels.
    pub fn set_calibre(&mut self, calibre: Calibre) {
        self.calibre = Some(Arc::new(calibre));
        self.revision.measured += 1;
    }

    /// Takes more of the deviation of a level.
    pub fn set_deviated(&mut self, deviated: Box<Deviated>) {
        self.deviated = Some(deviated);
        self.revision.measured += 1;
    }

    /// More of the deviation of the level that is shown, if it is known.
    pub(super) fn deviated_shown(&self) -> Option<&Deviated> {
        let (deviated, measured) = (self.deviated.as_deref()?, self.measured.as_ref()?);
        (deviated.generation == measured.generation && self.measures_shown()).then_some(deviated)
    }

    /// Takes what the file says of a level.
    pub fn set_carried(&mut self, carried: Box<LevelArrays>) {
        self.carried = Some(carried);
        self.revision.measured += 1;
    }

    /// For each array a number for each vertex of the level that is shown, if they are known.
    pub(super) fn carried_shown(&self) -> Option<&[f32]> {
        let (carried, measured) = (self.carried.as_ref()?, self.measured.as_ref()?);
        (carried.generation == measured.generation && self.measures_shown()).then_some(&carried.values)
    }

    /// For each node of the level that is shown, the change of calibre in percent, if it is known.
    pub fn change_by_node(&self) -> Option<&[f32]> {
        let (levels, calibre, measured) = (&self.levels.as_ref()?.1, self.calibre.as_ref()?, self.measured.as_ref()?);
        let is_of_shown = calibre.generation == measured.generation && self.measures_shown();
        (is_of_shown && calibre.change_by_node.len() == levels.positions.len()).then_some(&calibre.change_by_node)
    }

    /// Whether the numbers are of the level that is shown.
    fn measures_shown(&self) -> bool {
        let counts = self.measured.as_ref().zip(self.shown.as_ref());
        counts.is_some_and(|(measured, shown)| measured.report.output.triangles == shown.level.triangles.len())
    }

    /// The vessel that is pinched or lost on the level that is shown, if one is: the first of them, as far as is known.
    pub fn pinch(&self) -> Option<&Pinch> {
        let (levels, shown, measured) = (&self.levels.as_ref()?.1, self.shown.as_ref()?, self.measured.as_ref()?);
        let is_of_these = measured.report.after_connectivity.triangles == levels.triangles.len();
        let pinch = measured.report.pinch.as_ref().filter(|_| is_of_these)?;
        // A coarser level may open a vessel again: where the level itself is measured, that counts.
        let is_of_shown = measured.report.output.triangles == shown.level.triangles.len();
        if is_of_shown && measured.report.narrowing.is_some_and(|found| found.pinched_places == 0) {
            return None;
        }
        (shown.level.triangles.len() <= pinch.triangles).then_some(pinch)
    }

    /// What it is called to a user, in the language that is spoken.
    pub fn title(&self) -> Cow<'_, str> {
        self.source.label()
    }

    /// What files that are made of it begin with.
    pub fn stem(&self) -> String {
        match self.name.rsplit_once('.') {
            Some((stem, _)) if Format::from_name(&self.name).is_some() => stem.to_owned(),
            _ => self.name.to_lowercase().replace(' ', "-"),
        }
    }

    /// Takes what plain Laplacian smoothing makes of the surface, to be shown where it would be as it was opened; `None` to
    /// show that again.
    pub fn set_averaged(&mut self, averaged: Option<Box<Averaged>>) {
        if averaged.is_some() || self.averaged.is_some() {
            self.revision.averaged += 1;
        }
        self.averaged = averaged.filter(|averaged| averaged.positions.len() == self.opened.positions.len());
    }

    /// What plain Laplacian smoothing makes of those pieces, where that is shown in place of the surface as it was opened.
    pub fn averaged(&self, keep: Keep) -> Option<&Averaged> {
        self.averaged.as_deref().filter(|averaged| averaged.keep == keep)
    }

    /// Those pieces as they are shown beside the level or in its place: as they were opened, or as plain Laplacian smoothing
    /// leaves them.
    pub fn before(&self, keep: Keep) -> TriMesh {
        let positions = self.averaged(keep).map_or(&self.opened.positions, |averaged| &averaged.positions);
        let triangles = &self.opened.triangles;
        let kept = (0..triangles.len()).filter(|&t| self.pieces.keeps(keep, t));
        compacted(positions, kept.map(|t| triangles[t]).collect())
    }

    /// The classes of the level that is shown, worked out where something first asks for them.
    pub fn classes(&self) -> Option<&Classes> {
        let (levels, shown) = (&self.levels.as_ref()?.1, self.shown.as_ref()?);
        Some(shown.classes.get_or_init(|| Classes::new(levels, shown.level.steps, &shown.level.triangles)))
    }

    /// The shown level as a surface of its own.
    pub fn shown_mesh(&self) -> Option<TriMesh> {
        let (levels, shown) = (&self.levels.as_ref()?.1, self.shown.as_ref()?);
        Some(levels.extract(&shown.level.triangles))
    }

    /// The box around the pieces that `keep` names.
    pub fn bounds(&self, keep: Keep) -> Bounds {
        let kept = self.pieces.kept(keep).map(|piece| piece.bounds).reduce(|all, next| all.joined(&next));
        kept.filter(|_| keep != Keep::All).unwrap_or_else(|| self.opened.bounds())
    }

    /// For each node of the level that is shown, the mean deviation around it in mm, if it is known.
    pub fn deviation_by_node(&self) -> Option<&[f32]> {
        let (levels, measured) = (&self.levels.as_ref()?.1, self.measured.as_ref()?);
        (self.measures_shown() && measured.deviation.len() == levels.positions.len()).then_some(&measured.deviation)
    }
}
