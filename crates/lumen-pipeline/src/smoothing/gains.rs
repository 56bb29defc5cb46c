//! What each vertex takes of each term: the coefficients of one filter, or of its own.
//!
//! A filtered surface is `sum of c_n x_n`, and the terms `x_n` do not depend on the filter. So every vertex can have
//! coefficients of its own at no further pass over the surface: those of a filter whose pass band suits the place.
//! Filters are made for a row of pass bands, evenly apart as angles, and a vertex takes the weighted mean of the two
//! around its own. Each lets a constant through unchanged, and so does any mean of them.

use crate::filter::Filter;
use crate::settings::Smoothing;
use lumen_mesh::parallel;

/// Pass bands of neighbouring filters are so far apart as angles, `acos(1 - k / 2)`: coefficients go with the sines of their
/// multiples.
const STEP: f64 = 0.025;

/// Filters in a row at most: a power of two, so that a number is cut to it without a look.
const FILTERS: usize = 64;

/// Vertices whose place in the row is found in one go.
const MIXES: usize = 4096;

/// `c_n` of each filter, and what the next one's is more.
pub(super) type Row = [[f32; 2]; FILTERS];

/// Where a vertex stands in the row of filters: `part` of the way from one to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Mix {
    filter: u32,
    part: f32,
}

impl Mix {
    /// Whether it is the first filter alone: that of the setting.
    pub(super) fn is_plain(&self) -> bool {
        *self == Self::default()
    }
}

/// The coefficients.
pub(super) enum Gains {
    /// `c_n`, the same everywhere.
    Same(Vec<f32>),
    /// Of several filters, a row for each n.
    Rows(Vec<Row>),
}

impl Gains {
    /// Those of `filter`, everywhere.
    pub(super) fn of(filter: &Filter) -> Self {
        Self::Same(filter.coefficients.iter().map(|&c| c as f32).collect())
    }

    /// Those of filters as `settings` ask for, but each vertex with its own of `pass_bands` where that is larger; and where
    /// each stands in their row. Where none is, the mixes are empty: then one filter does.
    pub(super) fn varying(settings: &Smoothing, pass_bands: &[f32]) -> (Self, Vec<Mix>) {
        let low = settings.pass_band;
        let high = f64::from(pass_bands.iter().fold(0.0f32, |high, &k| high.max(k)));
        if high <= low {
            return (Self::of(&Filter::new(settings)), Vec::new());
        }
        let angle = |k: f64| libm::acos(1.0 - k / 2.0);
        let from = angle(low);
        let count = (((angle(high) - from) / STEP).ceil() as usize + 2).min(FILTERS);
        let band = |i: usize| match i {
            // To the bit.
            0 => low,
            _ => (2.0 - 2.0 * libm::cos(from + STEP * i as f64)).min(*Smoothing::PASS_BAND.end()),
        };
        let filters =
            parallel::map((0..count).collect(), |i| Filter::new(&Smoothing { pass_band: band(i), ..*settings }));
        let degree = settings.iterations as usize;
        let row = |n: usize| {
            let c = |i: usize| filters[i.min(count - 1)].coefficients[n] as f32;
            std::array::from_fn(|i| [c(i), c(i + 1) - c(i)])
        };
        let rows = (0..=degree).map(row).collect();
        let mix = |&k: &f32| {
            if f64::from(k) <= low {
                return Mix::default();
            }
            let at = ((angle(f64::from(k)) - from) / STEP) as f32;
            let filter = (at as u32).min(count as u32 - 2);
            Mix { filter, part: (at - filter as f32).clamp(0.0, 1.0) }
        };
        let mixes = parallel::map_ranges(pass_bands.len(), MIXES, |range| -> Vec<Mix> {
            pass_bands[range].iter().map(mix).collect()
        });
        (Self::Rows(rows), mixes.concat())
    }

    /// The number of terms less one.
    pub(super) fn degree(&self) -> usize {
        match self {
            Self::Same(coefficients) => coefficients.len() - 1,
            Self::Rows(rows) => rows.len() - 1,
        }
    }

    /// `c_n`, where it is the same everywhere; else those of the row.
    #[inline]
    pub(super) fn term(&self, n: usize) -> Term<'_> {
        match self {
            Self::Same(coefficients) => Term::Same(coefficients[n]),
            Self::Rows(rows) => Term::Row(&rows[n]),
        }
    }
}

/// The coefficients of one term.
#[derive(Clone, Copy)]
pub(super) enum Term<'a> {
    Same(f32),
    Row(&'a Row),
}

/// The coefficients of one term for a run of vertices.
pub(super) trait Gain: Copy {
    /// That of the `i`-th.
    fn at(self, i: usize) -> f32;
}

impl Gain for f32 {
    #[inline(always)]
    fn at(self, _: usize) -> f32 {
        self
    }
}

/// Each vertex by its place in the row.
#[derive(Clone, Copy)]
pub(super) struct Mixed<'a> {
    pub(super) row: &'a Row,
    pub(super) mixes: &'a [Mix],
}

impl Gain for Mixed<'_> {
    #[inline(always)]
    fn at(self, i: usize) -> f32 {
        let Mix { filter, part } = self.mixes[i];
        let [c, more] = self.row[filter as usize % FILTERS];
        c + part * more
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_passes_whatever_the_mean_of_filters() {
        let bands = [0.01, 0.013, 0.2, 1.7];
        let (gains, mixes) = Gains::varying(&Smoothing::PAPER, &bands);
        for (i, band) in bands.iter().enumerate() {
            let sum: f32 = (0..=gains.degree())
                .map(|n| match gains.term(n) {
                    Term::Row(row) => Mixed { row, mixes: &mixes }.at(i),
                    Term::Same(c) => c,
                })
                .sum();
            assert!((sum - 1.0).abs() < 1e-5, "{band}: {sum}");
        }
    }

    #[test]
    fn a_vertex_has_the_filter_of_its_own_pass_band() {
        let bands = [0.004, 0.05, 0.31];
        let settings = Smoothing { pass_band: 0.003, ..Smoothing::PAPER };
        let (gains, mixes) = Gains::varying(&settings, &bands);
        for (i, &band) in bands.iter().enumerate() {
            let own = Filter::new(&Smoothing { pass_band: f64::from(band), ..settings });
            let worst = (0..=gains.degree()).map(|n| {
                let Term::Row(row) = gains.term(n) else { panic!("a row") };
                (f64::from(Mixed { row, mixes: &mixes }.at(i)) - own.coefficients[n]).abs()
            });
            let worst = worst.fold(0.0, f64::max);
            assert!(worst < 2e-3, "{band}: a coefficient is {worst} off");
        }
    }
}
