//! An order of the vertices in which neighbours lie close together: breadth first from vertex to vertex (Cuthill and
//! McKee 1969, without their sorting by degree), cut into chunks of whole levels.
//!
//! A vertex has neighbours in its own level and the two beside it only; so those of a chunk lie in the chunk, the one
//! before and the one after. That lets several passes of the filter follow one another through the chunks, each one
//! chunk behind the one before it, while a few chunks stay in the cache. Within a chunk vertices stand by the length
//! of their rows, so that the inner loop has no count to guess, and those that take the setting's own coefficients before
//! the ones that look up theirs.

use super::gains::Mix;
use super::stencil::Stencil;
use lumen_mesh::Topology;

/// Vertices in a chunk, at least; a level is never cut.
const CHUNK: usize = 256;

/// Vertices in breadth-first order.
pub(super) struct Order {
    /// The vertex at each place.
    pub vertices: Vec<u32>,
    /// The place of each vertex.
    pub places: Vec<u32>,
    /// The first place of each chunk, and the number of vertices.
    pub chunks: Vec<u32>,
}

impl Order {
    /// `mixes` say where each vertex stands in the row of filters; they are empty where there is one.
    pub(super) fn new(stencil: &Stencil, mixes: &[Mix]) -> Self {
        let topology = stencil.topology;
        let count = topology.vertex_count();
        let mut order = Self { vertices: Vec::with_capacity(count), places: vec![UNSEEN; count], chunks: vec![0] };
        for seed in 0..count as u32 {
            order.spread(seed, topology);
        }
        if order.chunks.last() != Some(&(count as u32)) {
            order.chunks.push(count as u32);
        }
        order.sort_chunks(|v| {
            let is_plain = mixes.get(v as usize).is_none_or(Mix::is_plain);
            2 * stencil.valence(v) + usize::from(!is_plain)
        });
        order
    }

    /// Adds what can be reached from `seed`, level by level.
    fn spread(&mut self, seed: u32, topology: &Topology) {
        if self.places[seed as usize] != UNSEEN {
            return;
        }
        let mut level = self.vertices.len();
        self.add(seed);
        while level < self.vertices.len() {
            let end = self.vertices.len();
            let chunk = self.chunks[self.chunks.len() - 1] as usize;
            if end - chunk >= CHUNK {
                self.chunks.push(end as u32);
            }
            for i in level..end {
                for &n in topology.neighbours(self.vertices[i]) {
                    if self.places[n as usize] == UNSEEN {
                        self.add(n);
                    }
                }
            }
            level = end;
        }
    }

    fn add(&mut self, v: u32) {
        self.places[v as usize] = self.vertices.len() as u32;
        self.vertices.push(v);
    }

    /// Sorts each chunk by `key`, by counting; equals keep their order.
    fn sort_chunks(&mut self, key: impl Fn(u32) -> usize) {
        let mut unsorted: Vec<(u32, u32)> = Vec::new();
        for bounds in self.chunks.windows(2) {
            let chunk = &mut self.vertices[bounds[0] as usize..bounds[1] as usize];
            unsorted.clear();
            unsorted.extend(chunk.iter().map(|&v| (key(v) as u32, v)));
            let mut starts = [0usize; LARGE + 2];
            for &(key, _) in &unsorted {
                starts[(key as usize).min(LARGE) + 1] += 1;
            }
            for i in 1..starts.len() {
                starts[i] += starts[i - 1];
            }
            let large = starts[LARGE];
            for &(key, v) in &unsorted {
                let slot = &mut starts[(key as usize).min(LARGE)];
                chunk[*slot] = v;
                *slot += 1;
            }
            chunk[large..].sort_by_key(|&v| key(v));
            for (place, &v) in (bounds[0]..).zip(chunk.iter()) {
                self.places[v as usize] = place;
            }
        }
    }
}

/// Keys of this size or more, of rows of 16 and more, are few, and sorted by comparing.
const LARGE: usize = 32;

const UNSEEN: u32 = u32::MAX;
