//! The windowed-sinc filter as a polynomial: its coefficients and its response.
//!
//! Taubin, Zhang and Golub, "Optimal surface smoothing as filter design" (1996). The low-pass filter with pass band
//! `pb` on the eigenvalues `k` of `K` (0 to 2) is the truncated Chebyshev series
//!
//! ```text
//! f(k) = sum over n of c_n T_n(1 - k/2),   theta = acos(1 - pb/2)
//! c_0 = w_0 (theta + sigma) / pi,   c_n = 2 w_n sin(n (theta + sigma)) / (n pi)
//! ```
//!
//! with `w_n` a window over `t = n pi / (N + 1)`. `sigma` widens the band, so that the response at the pass band
//! itself is 1 to within 1e-3; it is the smallest value that does so. The coefficients are divided by their sum, so
//! that `f(0) = 1`: a surface is neither scaled nor moved, wherever its origin lies. (The peers leave that out; a
//! Hamming window then scales the whole surface about the origin by up to 0.24 %.)

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::settings::{Smoothing, Window};

/// How far the response at the pass band may be from 1.
const TOLERANCE: f64 = 1e-3;

/// A polynomial transfer function in Chebyshev form.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Filter {
    /// `c_n`, one more than there are iterations.
    pub coefficients: Vec<f64>,
    /// The widening of the band in radians.
    pub sigma: f64,
    /// The response at the pass band.
    pub pass_band_response: f64,
    /// Whether that response could be brought to within 1e-3 of 1.
    pub reaches_pass_band: bool,
}

/// The roughest there is on a surface: the largest eigenvalue of `K`.
const ROUGHEST: f64 = 2.0;

impl Filter {
    /// The filter for `settings`: normalised, with the smallest `sigma` that meets the tolerance, or the best one.
    pub fn new(settings: &Smoothing) -> Self {
        let series = Series::new(settings);
        let off = |sigma: f64| series.response(sigma) - 1.0;
        let met = |off: f64| off.abs() <= TOLERANCE;
        // The response climbs from about a half as the band widens and then swings about 1: walk to the first place
        // that meets the tolerance (or overshoots it), in steps finer than the swing, and close in on it there.
        let step = PI / (f64::from(settings.iterations) + 1.0) / 8.0;
        let widest = PI - series.theta;
        let (mut low, mut at_low) = (0.0, off(0.0));
        let (mut best, mut best_error) = (low, at_low.abs());
        let mut found = met(at_low).then_some(low);
        while found.is_none() && low < widest {
            let high = (low + step).min(widest);
            let at_high = off(high);
            if at_high.abs() < best_error {
                (best, best_error) = (high, at_high.abs());
            }
            if met(at_high) || at_low * at_high < 0.0 {
                let side = at_low.signum();
                let excess = |off: f64| side * off - TOLERANCE;
                let inside = crossing(|sigma| excess(off(sigma)), [low, high], [excess(at_low), excess(at_high)]);
                found = met(off(inside)).then_some(inside);
            }
            (low, at_low) = (high, at_high);
        }
        let sigma = found.unwrap_or(best);
        let mut c: Vec<f64> = series.coefficients(sigma).collect();
        let sum: f64 = c.iter().sum();
        c.iter_mut().for_each(|c| *c /= sum);
        let pass_band_response = evaluate(&c, series.theta);
        Self { coefficients: c, sigma, pass_band_response, reaches_pass_band: found.is_some() }
    }

    /// The filter for a given `sigma`, not normalised: what VTK evaluates.
    pub fn with_sigma(settings: &Smoothing, sigma: f64) -> Self {
        let series = Series::new(settings);
        let c: Vec<f64> = series.coefficients(sigma).collect();
        let pass_band_response = evaluate(&c, series.theta);
        let reaches_pass_band = (pass_band_response - 1.0).abs() <= TOLERANCE;
        Self { coefficients: c, sigma, pass_band_response, reaches_pass_band }
    }

    /// As many passes of plain Laplacian smoothing as a filter ([`laplacian`](super::laplacian)): `(1 - k/2)^passes`.
    pub fn laplacian(passes: u32) -> Self {
        // x T_n is half of T_n+1 and T_n-1; of x^0 there is T_0 alone.
        let mut c = vec![0.0; passes as usize + 1];
        c[0] = 1.0;
        for degree in 1..c.len() {
            let mut next = vec![0.0; c.len()];
            for (n, half) in c[..degree].iter().map(|c| c / 2.0).enumerate() {
                next[n + 1] += half;
                next[n.abs_diff(1)] += half;
            }
            c = next;
        }
        let pass_band_response = evaluate(&c, band_angle(0.0));
        Self { coefficients: c, sigma: 0.0, pass_band_response, reaches_pass_band: true }
    }

    /// The response `f(k)` at the eigenvalue `k`, 0 to 2.
    pub fn response(&self, k: f64) -> f64 {
        evaluate(&self.coefficients, band_angle(k))
    }

    /// The sum of the series at the eigenvalue `k`, 0 to 2, up to the term `T_n`: the response where `n` is the last.
    pub fn partial_response(&self, n: usize, k: f64) -> f64 {
        evaluate(&self.coefficients[..self.coefficients.len().min(n + 1)], band_angle(k))
    }

    /// How far that sum is from the response where it is farthest, to about a hundredth: 0 where `n` is the last.
    pub fn left_after(&self, n: usize) -> f64 {
        let mut rest = self.coefficients.clone();
        rest.iter_mut().take(n + 1).for_each(|c| *c = 0.0);
        // What is left swings no faster than the last term: so many steps of the angles of k from 0 to 2 a swing.
        let steps = 8 * rest.len();
        let at = |step: usize| evaluate(&rest, step as f64 / steps as f64 * (PI / 2.0)).abs();
        (0..=steps).map(at).fold(0.0, f64::max)
    }

    /// The smallest eigenvalue `k` at which the response is a half: waves that are rougher are more gone than there.
    /// `None` where the filter lets everything through.
    pub fn half_gain(&self) -> Option<f64> {
        // The response falls once, over an angle of a few times pi / degree: steps finer than that cannot miss it.
        let steps = 16 * self.coefficients.len();
        let response = |angle: f64| evaluate(&self.coefficients, angle);
        let angle = |step: usize| step as f64 / steps as f64 * (PI / 2.0);
        let below = (1..=steps).find(|&step| response(angle(step)) < 0.5)?;
        let (mut low, mut high) = (angle(below - 1), angle(below));
        for _ in 0..60 {
            let middle = (low + high) / 2.0;
            if response(middle) < 0.5 { high = middle } else { low = middle }
        }
        Some(2.0 * (1.0 - libm::cos(high)))
    }

    /// Whether the filter does what a pass band of `pass_band` promises: lets it through, and stops what is rough
    /// where the band ends before that. With too few terms the band can only be let through by letting all through.
    pub fn keeps_promise(&self, pass_band: f64) -> bool {
        self.reaches_pass_band && (pass_band > ROUGHEST / 2.0 || self.response(ROUGHEST).abs() < 0.5)
    }

    /// `f(0)`: by what a constant is multiplied.
    pub fn dc_gain(&self) -> f64 {
        self.coefficients.iter().sum()
    }
}

/// The angle whose Chebyshev argument is `1 - k/2`.
fn band_angle(k: f64) -> f64 {
    libm::acos((1.0 - k / 2.0).clamp(-1.0, 1.0))
}

/// `sum of c_n T_n(cos angle)`, by Clenshaw's recurrence (1955).
fn evaluate(coefficients: &[f64], angle: f64) -> f64 {
    let t = libm::cos(angle);
    let (mut next, mut after) = (0.0, 0.0);
    for c in coefficients.iter().skip(1).rev() {
        (next, after) = (c + 2.0 * t * next - after, next);
    }
    coefficients.first().map_or(0.0, |c| c + t * next - after)
}

/// Where `f` comes down to 0 between two places, as near as `CLOSE`: a place where it is 0 or less. `at` is what it is at the
/// two, more than 0 and not. By the secant, where an end that stays counts half each time (Illinois: Dowell and Jarratt 1971).
fn crossing(f: impl Fn(f64) -> f64, [mut above, mut below]: [f64; 2], [mut at_above, mut at_below]: [f64; 2]) -> f64 {
    /// In radians. The response changes by less than 1e-10 over it, and single precision hears of nothing below 6e-8.
    const CLOSE: f64 = 1e-13;
    let mut last = 0.0;
    while below - above > CLOSE {
        let secant = above + (below - above) * at_above / (at_above - at_below);
        // Where the secant gives an end itself, no nearer place is known but the middle.
        let place = if above < secant && secant < below { secant } else { (above + below) / 2.0 };
        let at = f(place);
        if at > 0.0 {
            (above, at_above) = (place, at);
            at_below *= if last > 0.0 { 0.5 } else { 1.0 };
        } else {
            (below, at_below) = (place, at);
            at_above *= if last < 0.0 { 0.5 } else { 1.0 };
        }
        last = if at > 0.0 { 1.0 } else { -1.0 };
    }
    below
}

/// What the coefficients of a setting are made from, for any `sigma`.
struct Series {
    /// The angle of the pass band.
    theta: f64,
    /// `w_n`.
    weights: Vec<f64>,
}

impl Series {
    fn new(settings: &Smoothing) -> Self {
        let Smoothing { window, pass_band, iterations, .. } = *settings;
        let degree = f64::from(iterations);
        let weights = (0..=iterations).map(|n| weight(window, f64::from(n) * PI / (degree + 1.0))).collect();
        Self { theta: band_angle(pass_band), weights }
    }

    /// `c_n`, not normalised.
    fn coefficients(&self, sigma: f64) -> impl Iterator<Item = f64> {
        let edge = self.theta + sigma;
        (0..).zip(&self.weights).map(move |(n, w)| {
            let n = f64::from(n);
            if n == 0.0 { w * edge / PI } else { 2.0 * w * libm::sin(n * edge) / (n * PI) }
        })
    }

    /// The response at the pass band, normalised.
    fn response(&self, sigma: f64) -> f64 {
        let c: Vec<f64> = self.coefficients(sigma).collect();
        evaluate(&c, self.theta) / c.iter().sum::<f64>()
    }
}

/// The window at `t`, 0 to pi.
fn weight(window: Window, t: f64) -> f64 {
    (0u32..).zip(window.terms()).map(|(n, term)| term * libm::cos(f64::from(n) * t)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_window_has_unit_gain_and_meets_its_pass_band() {
        for window in Window::ALL {
            for (pass_band, iterations) in [(0.1, 30), (0.1, 100), (0.01, 30), (0.01, 60), (0.01, 100), (0.5, 20)] {
                let settings = Smoothing { window, pass_band, iterations, ..Smoothing::PAPER };
                let filter = Filter::new(&settings);
                assert!((filter.dc_gain() - 1.0).abs() < 1e-12);
                assert!(filter.reaches_pass_band, "{settings:?} {filter:?}");
                assert!((filter.response(pass_band) - 1.0).abs() <= TOLERANCE * 1.000_001);
                assert!(filter.response(2.0).abs() < 0.02, "stops what is rough: {}", filter.response(2.0));
            }
        }
    }

    #[test]
    fn sigma_is_the_smallest() {
        for window in Window::ALL {
            for (pass_band, iterations) in [(0.1, 30), (0.1, 100), (0.01, 30), (0.01, 100), (0.5, 20), (0.002, 1000)] {
                let settings = Smoothing { window, pass_band, iterations, ..Smoothing::PAPER };
                let (sigma, series) = (Filter::new(&settings).sigma, Series::new(&settings));
                let off = |sigma: f64| (series.response(sigma) - 1.0).abs();
                assert!(off(sigma) <= TOLERANCE);
                let smaller = (1..1000).map(|i| sigma * f64::from(i) / 1000.0).chain([sigma - 1e-11]);
                smaller
                    .for_each(|smaller| assert!(off(smaller) > TOLERANCE, "{settings:?}: {smaller} does, not {sigma}"));
            }
        }
    }

    #[test]
    fn the_windows_have_their_published_values() {
        // Where the cosines are round numbers: at 0, pi/3, pi/2, 2 pi/3 and pi. Harris, "On the use of windows for
        // harmonic analysis" (1978); Nuttall, "Some windows with very good sidelobe behavior" (1981), the four terms with a
        // continuous first derivative.
        let published = [
            (Window::Hamming, [1.0, 0.77, 0.54, 0.31, 0.08]),
            (Window::Hanning, [1.0, 0.75, 0.5, 0.25, 0.0]),
            (Window::Blackman, [1.0, 0.63, 0.34, 0.13, 0.0]),
            (Window::Nuttall, [1.0, 0.514_746, 0.211_536, 0.052_558, 0.0]),
        ];
        for (window, values) in published {
            for (part, value) in [0.0, 1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0].into_iter().zip(values) {
                let found = weight(window, part * PI);
                assert!((found - value).abs() < 1e-12, "{window:?} at {part} pi: {found}, not {value}");
            }
            // A pass band of 2 ends at a right angle: without the window c_1 = 2/pi. Of one iteration the window's
            // place is pi/2, of two pi/3.
            for (iterations, value) in [(1, values[2]), (2, values[1])] {
                let settings = Smoothing { window, pass_band: 2.0, iterations, ..Smoothing::PAPER };
                let c = Filter::with_sigma(&settings, 0.0).coefficients;
                assert!((c[0] - 0.5).abs() < 1e-12 && (c[1] * PI / 2.0 - value).abs() < 1e-12, "{window:?}: {c:?}");
            }
        }
    }

    #[test]
    fn the_terms_add_up_to_the_response() {
        for window in Window::ALL {
            let settings = Smoothing { window, pass_band: 0.1, iterations: 40, ..Smoothing::PAPER };
            let filter = Filter::new(&settings);
            // Denser where k is small, as the angles are.
            let ks = || (0..=1000).map(|part| 2.0 * (f64::from(part) / 1000.0).powi(2));
            for k in ks() {
                assert!((filter.partial_response(40, k) - filter.response(k)).abs() < 1e-12);
                // The first term is a constant: c_0 w_0 T_0, where every window is 1, divided by the sum of all.
                let first =
                    (band_angle(0.1) + filter.sigma) / PI / Filter::with_sigma(&settings, filter.sigma).dc_gain();
                assert!((filter.partial_response(0, k) - first).abs() < 1e-12);
                // The second is the operator itself: T_1(1 - k/2) = 1 - k/2.
                let second = filter.partial_response(1, k) - first;
                assert!((second - filter.coefficients[1] * (1.0 - k / 2.0)).abs() < 1e-12);
            }
            assert_eq!(filter.left_after(40), 0.0);
            for n in [0, 1, 7, 25, 39] {
                let farthest =
                    ks().map(|k| (filter.partial_response(n, k) - filter.response(k)).abs()).fold(0.0, f64::max);
                let stated = filter.left_after(n);
                assert!(stated > 0.0 && (stated / farthest - 1.0).abs() < 0.01, "{window:?} {n}: {stated} {farthest}");
            }
        }
    }

    #[test]
    fn a_filter_that_lets_nearly_everything_through_says_so() {
        for (iterations, pass_band, keeps) in [(1, 0.1, false), (3, 0.1, false), (6, 0.1, true), (100, 0.01, true)] {
            let filter = Filter::new(&Smoothing { pass_band, iterations, ..Smoothing::PAPER });
            assert_eq!(filter.keeps_promise(pass_band), keeps, "{iterations} {}", filter.response(2.0));
        }
    }

    #[test]
    fn the_response_is_a_half_at_the_half_gain_and_no_less_before() {
        for window in Window::ALL {
            for (pass_band, iterations) in [(0.001, 200), (0.01, 30), (0.01, 100), (0.1, 20), (0.5, 20), (1.0, 60)] {
                let filter = Filter::new(&Smoothing { window, pass_band, iterations, ..Smoothing::PAPER });
                let k = filter.half_gain().unwrap();
                assert!(k > pass_band && (filter.response(k) - 0.5).abs() < 1e-9, "{window:?} {pass_band} {k}");
                assert!((0..1000).all(|part| filter.response(k * f64::from(part) / 1000.0) > 0.5));
            }
            let all = Filter::new(&Smoothing { window, pass_band: 2.0, ..Smoothing::PAPER });
            assert_eq!(all.half_gain(), None);
        }
    }

    #[test]
    fn a_filter_of_few_terms_says_that_it_misses_the_pass_band() {
        for iterations in [0, 1, 2, 200] {
            for pass_band in [0.001, 2.0] {
                let filter = Filter::new(&Smoothing { pass_band, iterations, ..Smoothing::PAPER });
                assert!(filter.coefficients.iter().all(|c| c.is_finite()));
                assert!((filter.dc_gain() - 1.0).abs() < 1e-12);
                let reached = (filter.response(pass_band) - 1.0).abs() <= TOLERANCE * 1.000_001;
                assert_eq!(filter.reaches_pass_band, reached, "{pass_band} {iterations}");
                if [0, 200].contains(&iterations) {
                    let is_enough = iterations == 200 || pass_band == 2.0;
                    assert_eq!(filter.keeps_promise(pass_band), is_enough, "{pass_band} {iterations}");
                }
            }
        }
    }
}
