//! Smoothing as a stage: the filter, or the terms of an earlier run, then what vessels lost of their calibre, and the volume.

use std::sync::Arc;

use web_time::Instant;

use super::{Outbox, Row, Run};
use crate::caps::settle;
use crate::filter::Filter;
use crate::response::SmoothingResponse;
use crate::results::{Adapted, Smoothed, Surface};
use crate::settings::Smoothing;
use crate::smoothing::{
    Before, Guarded, KeptTerms, TERMS_BYTES, VOLUME_TOLERANCE, guard, hold_volume, least_pass_bands, restore,
    smooth_keeping_terms, smooth_varying,
};
use crate::stage::Stage;
use crate::store::{LeastBands, Store};
use crate::task::Yielder;
use crate::times::Part;
use lumen_mesh::{Measures, SurfaceIndex, TriMesh, Vec3, rms_edge, surface_area, volume_within};
use lumen_vessel::width::widths;

pub(super) const ROW: Row = Row {
    needs: &[Stage::Connectivity],
    is_decided_anew: |old, new| !old.smoothing.gives_same(&new.smoothing),
    is_wanted: |_, _| true,
    is_background: false,
    has: |now| now.smoothed.is_some(),
    clear: |now| (now.smoothed, now.indices.smoothed) = (None, None),
    time: |times| &mut times.smoothing,
    start,
};

/// The part of the stage's progress in which caps are looked for.
const CAPS: f32 = 0.05;

/// What the stage works on.
struct Filtering {
    kept: Arc<Surface>,
    /// What the filter sees of it: it is the kept one itself where no caps are held.
    walls: Arc<Surface>,
    settings: Smoothing,
    filter: Filter,
    /// What is known of the kept surface.
    index: Option<Arc<SurfaceIndex>>,
    widths: Option<Arc<[f32]>>,
    bands: Option<Arc<[f32]>>,
    /// Terms of an earlier run that suit.
    terms: Option<Arc<KeptTerms>>,
    /// Bytes that new ones may take: they are kept where they may be used again.
    bytes: usize,
}

fn start(store: &Store) -> Option<Run> {
    let kept = store.now.kept.clone()?;
    let settings = store.now.settings.smoothing;
    let (index, widths) = (store.now.indices.kept.clone(), store.known_widths().cloned());
    let (bands, terms) = (store.bands.clone(), store.terms.clone());
    let bytes = if store.is_smoothed_again { TERMS_BYTES } else { 0 };
    Some(Run::new(move |yielder, outbox| async move {
        if settings.iterations == 0 {
            outbox.leave(move |store| store.now.smoothed = Some(Arc::new(unchanged(&kept))));
            return;
        }
        if settings.hold_caps {
            kept.capped(&yielder.part(0.0..CAPS)).await;
        }
        let walls = kept.smoothed_as(&settings);
        let suit = |known: &LeastBands| Arc::ptr_eq(&known.of, &walls) && known.above <= settings.pass_band as f32;
        let bands = bands.filter(suit).map(|known| known.bands);
        let terms = terms.filter(|terms| terms.suit(&kept, &settings));
        let filter = Filter::new(&settings);
        let filtering = Filtering { kept, walls, settings, filter, index, widths, bands, terms, bytes };
        let smoothed = Arc::new(filtering.run(&yielder.part(CAPS..1.0), &outbox).await);
        outbox.leave(|store| store.now.smoothed = Some(smoothed));
    }))
}

impl Filtering {
    async fn run(mut self, yielder: &Yielder, outbox: &Outbox) -> Smoothed {
        let settings = self.settings;
        let end = if settings.guard { 0.7 } else { 1.0 };
        let filtered = yielder.part(0.0..if settings.preserve_volume { end / 2.0 } else { end });
        let bands = if settings.adapt { Some(self.bands(&filtered.part(0.0..0.6), outbox).await) } else { None };
        let mut positions = match &bands {
            Some(bands) => {
                let positions = self.filter(Some(bands), &filtered.part(0.6..0.9), outbox).await;
                restore(&self.walls, positions, &settings, bands, &filtered.part(0.9..1.0)).await
            }
            None => self.filter(None, &filtered, outbox).await,
        };

        let mut volume_held = settings.preserve_volume.then_some(false);
        if let Some(before) = before(&self.walls).filter(|_| settings.preserve_volume) {
            let part = yielder.part(end / 2.0..end);
            let held = hold_volume(&before, positions, settings.boundary, &self.filter, &part).await;
            (positions, volume_held) = (held.0, Some(held.1));
        }
        let caps = self.kept.held_caps(&settings);
        if !caps.is_empty() {
            settle(&self.kept, caps, &mut positions);
            yielder.rest(end).await;
        }
        let guarded = if settings.guard {
            guard(&self.kept, self.index.take(), positions, &yielder.part(end..1.0)).await
        } else {
            Guarded::without(TriMesh { positions, triangles: self.kept.mesh.triangles.clone() })
        };
        yielder.rest(1.0).await;
        self.result(guarded, volume_held, bands.as_deref(), yielder, outbox).await
    }

    /// The least pass band of each vertex.
    async fn bands(&mut self, yielder: &Yielder, outbox: &Outbox) -> Arc<[f32]> {
        if let Some(known) = self.bands.take() {
            return known;
        }
        let Surface { mesh, topology, .. } = &*self.walls;
        let kept = &self.kept;
        let widths = match self.widths.take() {
            // Beside a cap the balls within are as small as its corner is near.
            _ if !Arc::ptr_eq(kept, &self.walls) => {
                widths(mesh, topology, None, &yielder.part(0.0..0.8)).await.0.into()
            }
            Some(known) => known,
            None => {
                let (found, index) = widths(mesh, topology, self.index.take(), &yielder.part(0.0..0.8)).await;
                let (of, found) = (kept.clone(), Arc::<[f32]>::from(found));
                self.index = Some(index.clone());
                let left = found.clone();
                outbox.leave(|store| {
                    store.now.indices.kept = Some(index);
                    store.widths = Some((of, left));
                });
                found
            }
        };
        // A pass band down to half of this one has them, too; without caps, whose widths are not kept, every one.
        let keeps_widths = Arc::ptr_eq(kept, &self.walls);
        let above = if keeps_widths { self.settings.pass_band as f32 / 2.0 } else { 0.0 };
        let bands: Arc<[f32]> = least_pass_bands(mesh, topology, &widths, above, &yielder.part(0.8..1.0)).await.into();
        let left = LeastBands { of: self.walls.clone(), above, bands: bands.clone() };
        outbox.leave(|store| store.bands = Some(left));
        bands
    }

    /// The positions by the filter, with a pass band of its own at each vertex where there are `bands`.
    async fn filter(&self, bands: Option<&[f32]>, yielder: &Yielder, outbox: &Outbox) -> Vec<Vec3> {
        let Self { walls, settings, filter, bytes, .. } = self;
        if let Some(known) = &self.terms {
            return match bands {
                Some(bands) => known.terms().smooth_varying(settings, bands),
                None => known.terms().smooth(filter),
            };
        }
        let (positions, topology, boundary) = (&walls.mesh.positions, &walls.topology, settings.boundary);
        let (positions, terms) = match bands {
            Some(bands) => smooth_varying(positions, topology, settings, bands, *bytes, yielder).await,
            None => smooth_keeping_terms(positions, topology, boundary, filter, *bytes, yielder).await,
        };
        if let Some(terms) = KeptTerms::of(walls, boundary, terms) {
            outbox.leave(|store| store.terms = Some(Arc::new(terms)));
        }
        positions
    }

    async fn result(
        &self,
        guarded: Guarded,
        volume_held: Option<bool>,
        bands: Option<&[f32]>,
        yielder: &Yielder,
        outbox: &Outbox,
    ) -> Smoothed {
        let Guarded { mesh, weakened, crosses_nothing } = guarded;
        let begun = Instant::now();
        let volume_mm3 = self.kept.loops.as_deref().map(|loops| volume_within(&mesh, loops));
        yielder.rest(1.0).await;
        let measures = Measures { area_mm2: surface_area(&mesh), volume_mm3 };
        outbox.tell_apart(Part::SmoothedAreas, begun);
        yielder.rest(1.0).await;
        let response = SmoothingResponse::new(&self.filter, self.settings.pass_band, rms_edge(&mesh));
        yielder.rest(1.0).await;
        // What is put back has the volume that it had.
        let change = self.kept.measures.volume_mm3.zip(measures.volume_mm3).map(|(before, after)| after / before - 1.0);
        let is_untouched = weakened.is_none() && self.kept.held_caps(&self.settings).is_empty();
        let is_held = is_untouched || change.is_some_and(|change| change.abs() <= VOLUME_TOLERANCE);
        Smoothed {
            mesh,
            filter: Some(self.filter.clone()),
            response: Some(response),
            volume_held: volume_held.map(|held| held && is_held),
            adapted: bands.and_then(|bands| Adapted::of(bands, self.settings.pass_band)),
            weakened,
            crosses_nothing,
            measures,
        }
    }
}

/// The surface before smoothing, if it encloses a volume.
fn before(kept: &Surface) -> Option<Before<'_>> {
    let Surface { mesh, topology, loops, measures, .. } = kept;
    Some(Before { mesh, topology, loops: loops.as_deref()?, volume: measures.volume_mm3? })
}

/// The surface as it is, without a pass.
fn unchanged(kept: &Surface) -> Smoothed {
    Smoothed {
        mesh: kept.mesh.clone(),
        filter: None,
        response: None,
        volume_held: None,
        adapted: None,
        weakened: None,
        crosses_nothing: false,
        measures: kept.measures,
    }
}
