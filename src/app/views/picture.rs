//! One view: its picture, what is written over it, and what a click in it asks for.

use egui::{Align2, Color32, EventFilter, Pos2, Rect, Response, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, pos2};
use glam::Vec3;

use super::{Clicked, Over, Subject, Views};
use crate::app::assist::name;
use crate::app::collapses::Collapses;
use crate::app::document::Document;
use crate::app::graphics_error::surface_error;
use crate::app::measure::Seen;
use crate::app::options::Colours;
use crate::app::places::{in_view, pixels};
use crate::app::scene::{Picture, Scene, coloured};
use crate::app::{arrays, classes, deviation, halo, mending, overlay, spoken, theme};
use crate::language::decimal;
use crate::mesh::Bounds;
use crate::pipeline::settings::Keep;
use crate::render::{Camera, ColourMap, Look, Style, pick};
use crate::say;

/// The target of the surface as it was opened, behind the first view; that behind the second is the next.
const REVEALED: usize = 2;

impl Views {
    /// Shows view `index` in `rect`. Returns what was clicked, if that asks for something.
    pub(super) fn view(
        &mut self,
        ui: &mut Ui,
        index: usize,
        rect: Rect,
        look: Look,
        subject: Subject<'_>,
        over: &mut Over<'_>,
    ) -> Option<Clicked> {
        let Subject { document, keep, measures } = subject;
        let Over { measuring, is_measuring, collapses } = over;
        let response = self.take_hand(ui, index, rect, subject);
        let colours = if index == 0 && !self.show_before { self.options.colours } else { Colours::None };
        let mut picture = self.picture(ui, rect, look, document, colours);
        picture.style.clip = measuring.clip_plane(document, keep);
        let sides = self.paint(ui, index, rect, &picture, subject);
        // On what is only held beside the level nothing is measured.
        let is_averaged = document.is_some_and(|document| document.averaged(keep).is_some());
        let reveals = sides.len() > 1;
        let measured: Vec<_> = sides.into_iter().filter(|(_, is_before)| !(is_averaged && *is_before)).collect();
        let (camera, is_lines) = (self.camera, index > 0);
        let seen = Seen {
            index,
            rect,
            camera: &camera,
            document,
            keep,
            parts: &measured,
            is_lines,
            is_measuring: *is_measuring,
            measures,
        };
        measuring.show_cut(ui, &seen);
        self.write(ui, index, rect, &picture, subject, colours);
        if reveals {
            self.divider.show(ui, rect, index, is_averaged.then(|| [before_title(document, keep), say!("views-now")]));
        }
        // Over its words: what is wrong at a place counts more than which side is which.
        self.mark(ui, rect, &picture, document, collapses);
        if response.has_focus() {
            let ring = Stroke::new(2.0, ui.visuals().hyperlink_color);
            ui.painter().rect_stroke(rect, 0.0, ring, StrokeKind::Inside);
        }
        if let (Colours::Deviation(shown), Some(document), Some(map), true) =
            (colours, document, picture.style.map, self.has_scalars())
        {
            if rect.height() > 300.0 {
                deviation::histogram(ui, rect, document, shown, map);
            }
            if let Some(asked) = deviation::pin(ui, rect, &camera, document, shown) {
                return Some(Clicked::Place(asked));
            }
        }
        if let Some(asked) = measuring.show_over(ui, &response, &seen) {
            return Some(Clicked::Measure(asked));
        }
        let at = response
            .interact_pointer_pos()
            .filter(|_| response.clicked() && !(*is_measuring && measuring.has_tool()))?;
        if self.options.left_out {
            self.piece_at(at, rect, document?).map(Clicked::Piece)
        } else if collapses.is_open() {
            self.vertex_at(at, rect, document?).map(Clicked::Vertex)
        } else {
            None
        }
    }

    /// Lets the hand at the view, by pointer or by keys, move the camera; says to assistive tools what is seen.
    fn take_hand(&mut self, ui: &mut Ui, index: usize, rect: Rect, subject: Subject<'_>) -> Response {
        let Subject { document, keep, .. } = subject;
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        let called = if index == 0 { say!("views-shaded") } else { say!("views-wireframe") };
        name(&response, Role::Image, &called);
        if let Some(document) = document {
            ui.ctx().accesskit_node_builder(response.id, |node| {
                node.set_description(spoken::view(document, keep, &self.camera, self.show_before));
            });
        }
        if response.has_focus() {
            // Its arrows turn it and leave the focus where it is.
            let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
            ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
            self.steer_by_keys(ui);
        }
        self.steer(ui, &response, 1, document, keep);
        response
    }

    /// What is to be drawn in `rect`, from where the camera is now.
    fn picture(&self, ui: &Ui, rect: Rect, look: Look, document: Option<&Document>, colours: Colours) -> Picture {
        let mut style = coloured(theme::style(ui.visuals()), document, colours);
        style.raking = self.options.raking;
        style.occlusion = self.options.occlusion;
        // Slices reach farther than the surface: the near and far planes leave room for them.
        let corners: Vec<Vec3> = self.slices.iter().flat_map(|slice| slice.corners).collect();
        Picture {
            camera: Camera { bounds: self.camera.bounds.joined(&Bounds::of(&corners)), ..self.camera },
            size: pixels(ui, rect).map(|side| side.div_ceil(self.light.map_or(1, |light| light.part))),
            light: self.light.map(|light| light.most),
            look,
            style,
            before: self.show_before,
            // Before there are levels all of it is shown.
            left_out: self.options.left_out && document.is_some_and(|document| document.levels.is_some()),
            slices: self.slices.iter().map(|slice| slice.serial).collect(),
        }
    }

    /// Draws the picture, split at the divider where both surfaces are shown. Returns its parts, and which of them show
    /// what stands at the left of the divider.
    fn paint(
        &mut self,
        ui: &Ui,
        index: usize,
        rect: Rect,
        picture: &Picture,
        subject: Subject<'_>,
    ) -> Vec<(Rect, bool)> {
        let Subject { document, keep, .. } = subject;
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        let at = self.divider.at();
        let (opened, now) = (rect.split_left_right_at_fraction(at), whole.split_left_right_at_fraction(at));
        let before = self.splits(index, document).then(|| Picture { before: true, ..picture.clone() });
        let (parts, sides) = match &before {
            Some(before) => (
                vec![(index, picture, opened.1, now.1), (REVEALED + index, before, opened.0, now.0)],
                vec![(opened.0, true), (opened.1, false)],
            ),
            None => (vec![(index, picture, rect, whole)], vec![(rect, self.show_before)]),
        };
        for (index, picture, shown, part) in parts {
            let drawn = self.scene.as_mut().map(|scene| scene.draw(index, picture, document, keep));
            if !matches!(drawn, Some(Ok(_))) {
                ui.painter_at(shown).rect_filled(shown, 0.0, ui.visuals().panel_fill);
            }
            match drawn {
                Some(Ok(texture)) => {
                    ui.painter_at(shown).image(texture, shown, part, Color32::WHITE);
                    if let (Some(outlines), Some(document)) = (&mut self.outlines, document) {
                        let of = (document, keep, picture.before);
                        outlines.draw(ui, [rect, shown], &self.camera, &self.slices, of);
                    }
                }
                Some(Err(error)) => self.failure = Some(say!("views-surface-failed", error = surface_error(&error))),
                None => {}
            }
        }
        sides
    }

    /// Writes what the picture shows: title, name, scale, axes and legends, or why there is nothing.
    fn write(&self, ui: &Ui, index: usize, rect: Rect, picture: &Picture, subject: Subject<'_>, colours: Colours) {
        let Subject { document, keep, .. } = subject;
        if !self.slices.is_empty() {
            // What is written has its contrast on any grey.
            let plate = ui.visuals().panel_fill.gamma_multiply(0.85);
            let [mut above, mut below] = [rect; 2];
            above.max.y = rect.top() + 76.0;
            below.min.y = rect.bottom() - 44.0;
            for band in [above, below] {
                ui.painter_at(rect).rect_filled(band, 0.0, plate);
            }
        }
        if let Some(failure) = &self.failure {
            let (font, colour) = (TextStyle::Body.resolve(ui.style()), ui.visuals().text_color());
            halo::text(&ui.painter_at(rect), rect.center(), Align2::CENTER_CENTER, failure, font, colour);
        }
        let array = document.and_then(|document| arrays::chosen(document, colours));
        let is_measured = self.has_scalars() && !picture.style.labels && array.is_none();
        let title = match index {
            _ if self.show_before => before_title(document, keep),
            0 => say!("views-shaded-title"),
            _ => say!("views-wireframe-title"),
        };
        let name = document.map(Document::title);
        overlay::show(
            ui,
            rect,
            &overlay::Writing {
                title: &title,
                name: name.as_deref(),
                camera: &self.camera,
                axes: document.map(|document| document.import.axes).unwrap_or_default(),
                legend: picture.style.map.filter(|_| is_measured).map(|map| legend(map, colours)),
                array: array.filter(|_| self.has_scalars()),
                is_alone: false,
            },
        );
    }

    /// Marks places: classes, the one that was gone to, the pinch, collapses, faults.
    fn mark(&self, ui: &Ui, rect: Rect, picture: &Picture, document: Option<&Document>, collapses: &Collapses) {
        if let Some(document) = document.filter(|_| !self.show_before) {
            if picture.style.by_vertex
                && let Some(found) = document.classes()
            {
                classes::legend(ui, rect, &found.counts);
            }
            if self.options.lines
                && let Some(found) = document.classes()
            {
                let normals = self.scene.as_ref().map_or(&[][..], Scene::normals);
                classes::lines(ui, rect, &self.camera, document, &found.lines, normals);
            }
        }
        if let Some(spot) = &self.spot {
            let colour = ui.visuals().hyperlink_color;
            overlay::path(ui, rect, &self.camera, &spot.along, colour);
            overlay::ring(ui, rect, &self.camera, spot.at, &spot.label, colour);
            for (at, label) in &spot.beside {
                overlay::ring(ui, rect, &self.camera, *at, label, ui.visuals().text_color());
            }
        }
        if let Some(pinch) = document.and_then(Document::pinch).filter(|_| !self.show_before) {
            let before = decimal(pinch.diameter_before_mm, 1);
            let label = if pinch.diameter_after_mm > 0.0 {
                say!("views-pinched", before = before)
            } else {
                say!("views-lost", before = before)
            };
            overlay::ring(ui, rect, &self.camera, pinch.at_mm.into(), &label, ui.visuals().error_fg_color);
        }
        if let Some(document) = document.filter(|_| !self.show_before) {
            collapses.marks(ui, rect, &self.camera, document);
        }
        if let Some((document, shown)) = document.zip(self.options.fault) {
            mending::marks(ui, rect, &self.camera, document, shown);
        }
    }

    fn has_scalars(&self) -> bool {
        self.scene.as_ref().is_some_and(Scene::has_scalars)
    }

    /// The piece under a point of the view.
    fn piece_at(&self, at: Pos2, rect: Rect, document: &Document) -> Option<u32> {
        let ray = self.camera.ray(in_view(at, rect), rect.width() / rect.height());
        let hit = pick(&ray, &document.opened.positions, &document.opened.triangles)?;
        document.pieces.labels.get(hit.triangle).copied()
    }

    /// The node of the level that is nearest to a point of the view.
    fn vertex_at(&self, at: Pos2, rect: Rect, document: &Document) -> Option<u32> {
        let (levels, level) = (&document.levels.as_ref()?.1, &document.shown.as_ref()?.level);
        let ray = self.camera.ray(in_view(at, rect), rect.width() / rect.height());
        let hit = pick(&ray, &levels.positions, &level.triangles)?;
        let place = ray.origin + ray.direction * hit.distance;
        let away = |node: &u32| levels.positions[*node as usize].distance_squared(place);
        level.triangles[hit.triangle].into_iter().min_by(|a, b| away(a).total_cmp(&away(b)))
    }
}

/// What the colours of a map say.
pub(in crate::app) fn legend(map: ColourMap, colours: Colours) -> overlay::Legend {
    let (title, unit, decimals, note) = match colours {
        Colours::Calibre => (say!("views-calibre"), "%", 1, say!("views-calibre-note")),
        Colours::Deviation(shown) => return deviation::legend(map, shown),
        Colours::None | Colours::Classes | Colours::Array(_) => (String::new(), "", 3, String::new()),
    };
    let is_calibre = colours == Colours::Calibre;
    overlay::Legend {
        map,
        title,
        unit,
        decimals,
        is_open: true,
        is_open_below: is_calibre,
        note,
        patch: is_calibre.then_some(Style::UNKNOWN),
        is_diverging: false,
        has_histogram: false,
    }
}

/// What is shown beside the level, or in its place: as opened, or smoothed by Laplacian passes.
fn before_title(document: Option<&Document>, keep: Keep) -> String {
    match document.and_then(|document| document.averaged(keep)) {
        Some(averaged) => say!("views-laplacian", passes = averaged.passes),
        None => say!("views-as-opened"),
    }
}
