//! An order of the vertices in which neighbours lie close together: breadth first from vertex to vertex (Cuthill and
//! McKee 1969, without their sorting by degree), cut into chunks of whole levels.
//!
//! A vertex has neighbours in its own level and the two beside it only; so those of a chunk lie in the chunk, the one
//! before and the one after. That lets several passes of the filter follow one another through the chunks, each one
//! chunk behind the one before it, while a few chunks stay in the cache. Within a chunk vertices stand by the length
//! of their rows, so that the inner loop has no count to guess.

use std::ops::Deref;

use super::stencil::Stencil;
use crate::mesh::Topology;

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
    pub(super) fn new<T: Deref<Target = Topology>>(topology: &Topology, stencil: &Stencil<T>) -> Self {
        let count = topology.vertex_count();
        let mut order = Self { vertices: Vec::with_capacity(count), places: vec![UNSEEN; count], chunks: vec![0] };
        for seed in 0..count as u32 {
            order.spread(seed, topology);
        }
        if order.chunks.last() != Some(&(count as u32)) {
            order.chunks.push(count as u32);
        }
        order.sort_chunks(stencil);
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

    /// Sorts each chunk by the length of the rows, by counting; equals keep their order.
    fn sort_chunks<T: Deref<Target = Topology>>(&mut self, stencil: &Stencil<T>) {
        let mut unsorted: Vec<(u32, u32)> = Vec::new();
        for bounds in self.chunks.windows(2) {
            let chunk = &mut self.vertices[bounds[0] as usize..bounds[1] as usize];
            unsorted.clear();
            unsorted.extend(chunk.iter().map(|&v| (stencil.valence(v) as u32, v)));
            let mut starts = [0usize; LONG + 2];
            for &(valence, _) in &unsorted {
                starts[(valence as usize).min(LONG) + 1] += 1;
            }
            for i in 1..starts.len() {
                starts[i] += starts[i - 1];
            }
            let long = starts[LONG];
            for &(valence, v) in &unsorted {
                let slot = &mut starts[(valence as usize).min(LONG)];
                chunk[*slot] = v;
                *slot += 1;
            }
            chunk[long..].sort_by_key(|&v| stencil.valence(v));
            for (place, &v) in (bounds[0]..).zip(chunk.iter()) {
                self.places[v as usize] = place;
            }
        }
    }
}

/// Rows of this length or more are few, and sorted by comparing.
const LONG: usize = 16;

const UNSEEN: u32 = u32::MAX;
