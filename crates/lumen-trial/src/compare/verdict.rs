//! What is said of a comparison, in one sentence.

use crate::summary::Summary;
use lumen_language::decimal;
use lumen_language::say;
use lumen_pipeline::settings::reduction_percent;

/// What is to be said, with the largest deviation and the largest noise in mm, and the orders that were tried.
pub(super) fn verdict(
    [reduced, original]: &[Summary; 2],
    [most, noise]: [f32; 2],
    [orders, arrived]: [usize; 2],
) -> String {
    let gone = reduction_percent(original.triangles, reduced.triangles);
    let (is_more, most, noise) = (most > noise, decimal(most, 1), decimal(noise, 1));
    let path = match (orders, is_more) {
        (0, _) => say!("trial-path", most = most),
        (_, true) => say!("trial-path-more", most = most, noise = noise),
        (_, false) => say!("trial-path-noise", most = most, noise = noise),
    };
    let gone = decimal(gone, 0);
    let all = orders + 1;
    let arrives = arrived + usize::from(original.success);
    if (1..all).contains(&arrives) {
        return if reduced.success {
            say!("trial-verdict-chance-yes", gone = gone, arrives = arrives, all = all, path = path)
        } else {
            say!("trial-verdict-chance-no", gone = gone, arrives = arrives, all = all, path = path)
        };
    }
    match (reduced.success, original.success) {
        (true, true) => say!("trial-verdict-both", gone = gone, path = path),
        (false, false) => say!("trial-verdict-neither", gone = gone, path = path),
        (true, false) => say!("trial-verdict-reduced", gone = gone, path = path),
        (false, true) => say!("trial-verdict-unreduced", gone = gone, path = path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(arrive: [bool; 2], differ: [f32; 2], orders: [usize; 2]) -> String {
        let summary = |success, triangles| Summary { success, triangles, ..Summary::default() };
        verdict(&[summary(arrive[0], 100), summary(arrive[1], 1000)], differ, orders)
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
