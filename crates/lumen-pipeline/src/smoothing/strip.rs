//! A strip of the surface: neighbouring chunks of the order, with all that a thread needs to filter them by itself.
//!
//! Passes run as a wave: pass n works on a chunk as soon as pass n - 1 is done with the chunk after it, so that several
//! passes go through the cache at once (time skewing: Wonnacott 2000). Where the strip ends inside the surface it has
//! a halo, copies of the next strip's chunks, as deep as there are passes in a wave; it is computed twice and shrinks
//! by a chunk a pass. What a vertex comes to depends on none of this.

use std::ops::Range;

use glam::Vec4;

use super::gains::{Gain, Gains, Mix, Mixed, Term};
use super::layout::Layout;
use super::order::Order;
use crate::task::Yielder;

/// Vertices of a chunk that have rows of one length, and all the setting's own coefficients or none of them.
struct Run {
    /// The first of them.
    first: usize,
    /// Where their rows begin in `Strip::rows`.
    rows: usize,
    count: usize,
    valence: usize,
    /// Whether they take the first filter's coefficients: then there is nothing to look up.
    is_plain: bool,
}

/// A strip under way.
pub(super) struct Strip {
    /// The places in the order that the strip has, halos included.
    places: Range<usize>,
    /// The ones that are its own.
    own: Range<usize>,
    /// The chunks of the order that it has.
    all: Range<usize>,
    /// Runs of each chunk.
    chunks: Vec<Range<usize>>,
    runs: Vec<Run>,
    rows: Vec<u32>,
    /// Whether there is a halo before and after.
    halo: [bool; 2],
    /// `x_n` for even n and for odd n, relative to the middle of the surface; by place, from `places.start`.
    values: [Vec<Vec4>; 2],
    /// The sum of `c_n x_n` so far.
    sum: Vec<Vec4>,
    /// By place, like the sum; empty where the coefficients are the same everywhere.
    mixes: Vec<Mix>,
    /// `x_0`, `x_1` and so on of the strip's own vertices, one after another, where they are kept.
    pub terms: Vec<f32>,
    /// The step of the wave that comes next.
    step: usize,
}

/// Passes that run as one wave: from `first` on.
#[derive(Clone, Copy)]
pub(super) struct Wave {
    pub first: usize,
    pub count: usize,
}

impl Strip {
    /// The strip of the chunks `own`, with halos of up to `depth` chunks, not yet laid out.
    pub(super) fn new(order: &Order, own: Range<usize>, depth: usize) -> Self {
        let all = own.start.saturating_sub(depth)..(own.end + depth).min(order.chunks.len() - 1);
        let place = |chunk: usize| order.chunks[chunk] as usize;
        let places = place(all.start)..place(all.end);
        Self {
            own: place(own.start)..place(own.end),
            chunks: Vec::with_capacity(all.len()),
            runs: Vec::new(),
            rows: Vec::with_capacity(places.len() * 6),
            halo: [all.start < own.start, own.end < all.end],
            values: [Vec::with_capacity(places.len()), Vec::new()],
            sum: Vec::with_capacity(places.len()),
            mixes: Vec::new(),
            terms: Vec::new(),
            step: 0,
            places,
            all,
        }
    }

    /// Lays out chunk after chunk until the slice is spent; `places` says where each vertex is in the order, and the sum
    /// begins with `c0 x_0`. Returns whether all are.
    pub(super) fn lay_out(&mut self, layout: &Layout, places: &[u32], gains: &Gains, yielder: &Yielder) -> bool {
        let Layout { order, values, centre, mixes, .. } = layout;
        for chunk in self.all.start + self.chunks.len()..self.all.end {
            let own = order.chunks[chunk] as usize..order.chunks[chunk + 1] as usize;
            let x = order.vertices[own.clone()].iter().map(|&v| (values[v as usize] - *centre).extend(0.0));
            self.values[0].extend(x.clone());
            match gains.term(0) {
                Term::Same(c) => self.sum.extend(x.map(|x| x * c)),
                Term::Row(row) => {
                    let first = self.mixes.len();
                    self.mixes.extend(order.vertices[own.clone()].iter().map(|&v| mixes[v as usize]));
                    let gain = Mixed { row, mixes: &self.mixes[first..] };
                    self.sum.extend(x.enumerate().map(|(i, x)| x * gain.at(i)));
                }
            }
            self.add_chunk(layout, places, own);
            if chunk % 4 == 0 && chunk + 1 < self.all.end && yielder.budget().is_spent() {
                return false;
            }
        }
        self.values[1].resize(self.places.len(), Vec4::ZERO);
        true
    }

    fn add_chunk(&mut self, layout: &Layout, all_places: &[u32], places: Range<usize>) {
        let Layout { order, stencil, .. } = layout;
        let first_run = self.runs.len();
        let base = self.places.start;
        for place in places {
            let v = order.vertices[place];
            let valence = stencil.valence(v);
            let is_plain = self.mixes.get(place - base).is_none_or(Mix::is_plain);
            match self.runs[first_run..].last_mut() {
                Some(run) if (run.valence, run.is_plain) == (valence, is_plain) => run.count += 1,
                _ => self.runs.push(Run { first: place - base, rows: self.rows.len(), count: 1, valence, is_plain }),
            }
            // Neighbours outside the halo belong to chunks of it that are only read, never computed.
            let rows = &mut self.rows;
            stencil.for_each(v, |n| rows.push(all_places[n as usize].wrapping_sub(base as u32)));
        }
        self.chunks.push(first_run..self.runs.len());
    }

    /// Keeps all terms from now on.
    pub(super) fn keep_terms(&mut self, degree: usize) {
        self.terms = vec![0.0; (degree + 1) * self.own.len() * 3];
        for chunk in 0..self.chunks.len() {
            self.keep_term(0, chunk);
        }
    }

    /// The sum at the strip's own vertices.
    pub(super) fn own_sum(&self) -> &[Vec4] {
        &self.sum[self.own.start - self.places.start..self.own.end - self.places.start]
    }

    /// Goes on with a wave until the slice is spent; whether it is done.
    pub(super) fn advance(&mut self, wave: Wave, gains: &Gains, yielder: &Yielder) -> bool {
        let steps = self.chunks.len() + wave.count - 1;
        while self.step < steps {
            for pass in 0..wave.count.min(self.step + 1) {
                let chunk = self.step - pass;
                // The halo shrinks by a chunk a pass.
                let first = if self.halo[0] { pass + 1 } else { 0 };
                let end = self.chunks.len() - if self.halo[1] { pass + 1 } else { 0 };
                if (first..end).contains(&chunk) {
                    self.pass(wave.first + pass, chunk, gains);
                }
            }
            self.step += 1;
            if self.step.is_multiple_of(4) && self.step < steps && yielder.budget().is_spent() {
                return false;
            }
        }
        true
    }

    /// Makes ready for the next wave.
    pub(super) fn rewind(&mut self) {
        self.step = 0;
    }

    /// The part of the wave that is done.
    pub(super) fn progress(&self, wave: Wave) -> f32 {
        self.step as f32 / (self.chunks.len() + wave.count - 1).max(1) as f32
    }

    /// Computes `x_n` on a chunk from `x_{n-1}` and `x_{n-2}`, which it overwrites.
    fn pass(&mut self, n: usize, chunk: usize, gains: &Gains) {
        let [even, odd] = &mut self.values;
        let (current, previous) = if n.is_multiple_of(2) { (odd, even) } else { (even, odd) };
        for run in &self.runs[self.chunks[chunk].clone()] {
            let rows = &self.rows[run.rows..run.rows + run.count * run.valence];
            let places = run.first..run.first + run.count;
            let (next, sum) = (&mut previous[places.clone()], &mut self.sum[places.clone()]);
            let work = Work { rows, current, own: &current[places.clone()] };
            match gains.term(n) {
                Term::Same(c) => work.run(n, run.valence, next, sum, c),
                Term::Row(row) if run.is_plain => work.run(n, run.valence, next, sum, row[0][0]),
                Term::Row(row) => work.run(n, run.valence, next, sum, Mixed { row, mixes: &self.mixes[places] }),
            }
        }
        if !self.terms.is_empty() {
            self.keep_term(n, chunk);
        }
    }

    fn keep_term(&mut self, n: usize, chunk: usize) {
        let runs = &self.runs[self.chunks[chunk].clone()];
        let (Some(first), Some(last)) = (runs.first(), runs.last()) else { return };
        let base = self.places.start;
        let (first, end) =
            ((first.first + base).max(self.own.start), (last.first + last.count + base).min(self.own.end));
        if first >= end {
            return;
        }
        let at = (n * self.own.len() + first - self.own.start) * 3;
        let kept = self.terms[at..at + (end - first) * 3].as_chunks_mut::<3>().0;
        for (kept, x) in kept.iter_mut().zip(&self.values[n % 2][first - base..end - base]) {
            *kept = x.truncate().to_array();
        }
    }

    /// Copies what `self` and the strip after it have computed into each other's halos.
    pub(super) fn exchange(&mut self, after: &mut Self) {
        let seam = self.own.end;
        for (mine, its) in self.values.iter_mut().zip(&mut after.values) {
            let (from, to) = (self.places.start, after.places.start);
            let behind = after.places.start..seam;
            its[..behind.len()].copy_from_slice(&mine[behind.start - from..behind.end - from]);
            let ahead = seam..self.places.end;
            mine[ahead.start - from..].copy_from_slice(&its[ahead.start - to..ahead.end - to]);
        }
    }
}

/// What a run of rows is computed from.
struct Work<'a> {
    rows: &'a [u32],
    current: &'a [Vec4],
    own: &'a [Vec4],
}

impl Work<'_> {
    /// Term `n`, by the coefficients that `gain` has.
    fn run(self, n: usize, valence: usize, next: &mut [Vec4], sum: &mut [Vec4], gain: impl Gain) {
        if n == 1 {
            self.dispatch::<true>(valence, next, sum, gain);
        } else {
            self.dispatch::<false>(valence, next, sum, gain);
        }
    }

    fn dispatch<const FIRST: bool>(self, valence: usize, next: &mut [Vec4], sum: &mut [Vec4], gain: impl Gain) {
        match valence {
            1 => self.fixed::<1, FIRST>(next, sum, gain),
            2 => self.fixed::<2, FIRST>(next, sum, gain),
            3 => self.fixed::<3, FIRST>(next, sum, gain),
            4 => self.fixed::<4, FIRST>(next, sum, gain),
            5 => self.fixed::<5, FIRST>(next, sum, gain),
            6 => self.fixed::<6, FIRST>(next, sum, gain),
            7 => self.fixed::<7, FIRST>(next, sum, gain),
            8 => self.fixed::<8, FIRST>(next, sum, gain),
            9 => self.fixed::<9, FIRST>(next, sum, gain),
            _ => self.any::<FIRST>(valence, next, sum, gain),
        }
    }

    /// Rows of `D` neighbours.
    fn fixed<const D: usize, const FIRST: bool>(self, next: &mut [Vec4], sum: &mut [Vec4], gain: impl Gain) {
        let weight = 1.0 / D as f32;
        let rows = self.rows.as_chunks::<D>().0;
        for (i, (((row, &x), next), sum)) in rows.iter().zip(self.own).zip(next).zip(sum).enumerate() {
            let total = row.iter().fold(Vec4::ZERO, |total, &n| total + self.current[n as usize]);
            step::<FIRST>(x, total * weight, gain.at(i), next, sum);
        }
    }

    /// Rows of `valence` neighbours.
    fn any<const FIRST: bool>(self, valence: usize, next: &mut [Vec4], sum: &mut [Vec4], gain: impl Gain) {
        let weight = 1.0 / valence as f32;
        let rows = self.rows.chunks_exact(valence);
        for (i, (((row, &x), next), sum)) in rows.zip(self.own).zip(next).zip(sum).enumerate() {
            let total = row.iter().fold(Vec4::ZERO, |total, &n| total + self.current[n as usize]);
            step::<FIRST>(x, total * weight, gain.at(i), next, sum);
        }
    }
}

/// The recurrence at one vertex; `next` comes in as `x_{n-2}` and goes out as `x_n`.
#[inline(always)]
fn step<const FIRST: bool>(x: Vec4, mean: Vec4, c: f32, next: &mut Vec4, sum: &mut Vec4) {
    *next = if FIRST { (x + mean) * 0.5 } else { x + mean - *next };
    *sum += *next * c;
}
