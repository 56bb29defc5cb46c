//! Taking a level, as a stage: a prefix of the progressive mesh as a surface of its own.

use std::sync::Arc;

use web_time::Instant;

use super::running::Run;
use crate::normals::{Weighting, vertex_normals};
use crate::results::{Levels, Reduced, fingerprint};
use crate::settings::SettingsError;
use crate::store::Store;
use crate::task::{Budget, Progress};
use crate::times::Part;
use lumen_mesh::{Topology, measures};

pub(super) struct Taking(Levels);

impl Taking {
    pub(super) fn start(store: &Store) -> Option<Self> {
        store.now.levels.clone().map(Self)
    }
}

impl Run for Taking {
    /// One piece.
    fn advance(&mut self, store: &mut Store, _: Budget) -> Result<Progress<()>, SettingsError> {
        let Self(Levels { progressive, .. }) = self;
        let level = match &store.now.bound {
            Some(bound) => progressive.level_after(bound.steps),
            None => progressive.level(store.now.settings.target),
        };
        let mesh = Arc::new(progressive.extract(&level.triangles));
        let start = Instant::now();
        let normals = vertex_normals(&mesh.positions, &mesh.triangles, Weighting::Area);
        store.now.times.tell_apart(Part::Normals, start);
        let start = Instant::now();
        let topology = Arc::new(Topology::new(mesh.positions.len(), &mesh.triangles));
        let measures = measures(&mesh, &topology);
        let fingerprint = fingerprint(&mesh);
        store.now.times.tell_apart(Part::LevelAreas, start);
        store.now.reduced = Some(Arc::new(Reduced { level, mesh, topology, normals, measures, fingerprint }));
        Ok(Progress::Done(()))
    }
}
