//! What is said of a comparison, in one sentence.

use crate::summary::Summary;
use lumen_message::messages;
use lumen_pipeline::settings::reduction_percent;

messages! {
    /// How a reduced surface compares with the unreduced one.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum ComparisonVerdict {
        /// The wire arrives on the reduced surface; on the unreduced one that is chance.
        "trial-verdict-chance-yes" ChanceYes {
            /// Triangles that were removed, in percent.
            gone: f64 [0],
            /// Orders of the triangles with which it arrives.
            arrives: usize,
            /// Orders that were tried.
            all: usize,
            /// How far the ways differ.
            path: PathVerdict,
        } => "At {gone:.0} % this wire arrives, but whether it does is chance: on the unreduced surface it arrives \
              with {arrives} of {all} orders of the triangles; {path}.",
        /// The wire does not arrive on the reduced surface; on the unreduced one that is chance.
        "trial-verdict-chance-no" ChanceNo {
            /// Triangles that were removed, in percent.
            gone: f64 [0],
            /// Orders of the triangles with which it arrives.
            arrives: usize,
            /// Orders that were tried.
            all: usize,
            /// How far the ways differ.
            path: PathVerdict,
        } => "At {gone:.0} % this wire does not arrive, but whether it does is chance: on the unreduced surface it \
              arrives with {arrives} of {all} orders of the triangles; {path}.",
        /// It arrives on both.
        "trial-verdict-both" Both {
            /// Triangles that were removed, in percent.
            gone: f64 [0],
            /// How far the ways differ.
            path: PathVerdict,
        } => "At {gone:.0} % this wire arrives; {path}.",
        /// It arrives on neither.
        "trial-verdict-neither" Neither {
            /// Triangles that were removed, in percent.
            gone: f64 [0],
            /// How far the ways differ.
            path: PathVerdict,
        } => "This wire arrives on neither surface under this input; at {gone:.0} % {path}.",
        /// It arrives on the reduced one alone.
        "trial-verdict-reduced" Reduced {
            /// Triangles that were removed, in percent.
            gone: f64 [0],
            /// How far the ways differ.
            path: PathVerdict,
        } => "At {gone:.0} % this wire arrives; under the same input it does not on the unreduced surface, and {path}.",
        /// It arrives on the unreduced one alone.
        "trial-verdict-unreduced" Unreduced {
            /// Triangles that were removed, in percent.
            gone: f64 [0],
            /// How far the ways differ.
            path: PathVerdict,
        } => "At {gone:.0} % this wire does not arrive, and on the unreduced surface it does; {path}.",
    }
}

messages! {
    /// How far the ways of the tip differ, as a clause.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum PathVerdict {
        /// Noise was not measured.
        "trial-path" Alone {
            /// The largest deviation in mm.
            most: f32 [1],
        } => "its tip path differs by {most:.1} mm at most",
        /// They differ by more than noise.
        "trial-path-more" More {
            /// The largest deviation in mm.
            most: f32 [1],
            /// The largest noise in mm.
            noise: f32 [1],
        } => "its tip path differs by {most:.1} mm at most, while the unreduced surface differs from itself by up to \
              {noise:.1} mm with its triangles in another order",
        /// They differ by no more than noise.
        "trial-path-noise" Noise {
            /// The largest deviation in mm.
            most: f32 [1],
            /// The largest noise in mm.
            noise: f32 [1],
        } => "its tip path differs by {most:.1} mm at most, no more than noise, as the unreduced surface differs from \
              itself by up to {noise:.1} mm with its triangles in another order",
    }
}

/// What is to be said, with the largest deviation and the largest noise in mm, and the orders that were tried.
pub(super) fn verdict(
    [reduced, original]: &[Summary; 2],
    [most, noise]: [f32; 2],
    [orders, arrived]: [usize; 2],
) -> ComparisonVerdict {
    let gone = reduction_percent(original.triangles, reduced.triangles);
    let path = match (orders, most > noise) {
        (0, _) => PathVerdict::Alone { most },
        (_, true) => PathVerdict::More { most, noise },
        (_, false) => PathVerdict::Noise { most, noise },
    };
    let all = orders + 1;
    let arrives = arrived + usize::from(original.success);
    match (reduced.success, original.success) {
        (true, _) if (1..all).contains(&arrives) => ComparisonVerdict::ChanceYes { gone, arrives, all, path },
        (false, _) if (1..all).contains(&arrives) => ComparisonVerdict::ChanceNo { gone, arrives, all, path },
        (true, true) => ComparisonVerdict::Both { gone, path },
        (false, false) => ComparisonVerdict::Neither { gone, path },
        (true, false) => ComparisonVerdict::Reduced { gone, path },
        (false, true) => ComparisonVerdict::Unreduced { gone, path },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(arrive: [bool; 2], differ: [f32; 2], orders: [usize; 2]) -> String {
        let summary = |success, triangles| Summary { success, triangles, ..Summary::default() };
        verdict(&[summary(arrive[0], 100), summary(arrive[1], 1000)], differ, orders).to_string()
    }

    #[test]
    fn a_difference_is_said_against_what_chance_does() {
        let text = said([true, true], [1.3, 0.9], [3, 3]);
        assert!(text.starts_with("At 90 % this wire arrives; its tip path differs by 1.3 mm at most, while"), "{text}");
        assert!(text.contains("differs from itself by up to 0.9 mm"), "{text}");
        let text = said([true, true], [0.4, 0.9], [3, 3]);
        assert!(text.contains("0.4 mm at most, no more than noise, as"), "{text}");
        // An arrival that another order flips says nothing.
        for (arrive, orders) in [([false, true], [3, 1]), ([true, false], [3, 2]), ([false, false], [3, 1])] {
            let text = said(arrive, [1.0, 0.5], orders);
            assert!(text.contains("is chance"), "{text}");
        }
        assert!(said([false, true], [1.0, 0.5], [3, 1]).contains("with 2 of 4 orders"));
        assert!(
            said([false, true], [1.0, 0.5], [3, 3]).contains("does not arrive, and on the unreduced surface it does")
        );
        assert!(said([false, false], [1.0, 0.5], [3, 0]).starts_with("This wire arrives on neither"));
        assert!(!said([true, true], [1.0, 0.0], [0, 0]).contains("itself"), "what was not tried is not said");
    }
}
