//! What is said of a comparison, in one sentence.

use crate::pipeline::settings::reduction_percent;
use crate::trial::summary::Summary;

/// What is to be said, with the largest deviation and the largest noise in mm, and the orders that were tried.
pub(super) fn verdict(
    [reduced, original]: &[Summary; 2],
    [most, noise]: [f32; 2],
    [orders, arrived]: [usize; 2],
) -> String {
    let gone = reduction_percent(original.triangles, reduced.triangles);
    let mut path = format!("its tip path differs by {most:.1} mm at most");
    if orders > 0 {
        let relation = if most > noise { "while" } else { "no more than noise, as" };
        path += &format!(
            ", {relation} the unreduced surface differs from itself by up to {noise:.1} mm with its triangles in another order"
        );
    }
    let all = orders + 1;
    let arrives = arrived + usize::from(original.success);
    if (1..all).contains(&arrives) {
        let here = if reduced.success { "arrives" } else { "does not arrive" };
        return format!(
            "At {gone:.0} % this wire {here}, but whether it does is chance: on the unreduced surface it arrives with {arrives} of \
             {all} orders of the triangles; {path}."
        );
    }
    match (reduced.success, original.success) {
        (true, true) => format!("At {gone:.0} % this wire arrives; {path}."),
        (false, false) => format!("This wire arrives on neither surface under this input; at {gone:.0} % {path}."),
        (true, false) => format!(
            "At {gone:.0} % this wire arrives; under the same input it does not on the unreduced surface, and {path}."
        ),
        (false, true) => {
            format!("At {gone:.0} % this wire does not arrive, and on the unreduced surface it does; {path}.")
        }
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
