//! What the distance of a vertex counts for beside that of another, where thin vessels are spared.
//!
//! With one threshold for a whole tree every vessel comes to the same error in mm, and a tenth of a millimetre is
//! nothing to an aorta and much to a coronary artery. By the error relative to the radius `r` each would come to the
//! same part of its own calibre; but then what noise there is in thin vessels, which does not scale with them, takes
//! the triangles of wide ones. What is used is the geometric mean of both: the error times
//!
//! ```text
//! sqrt(R / r)
//! ```
//!
//! for each length in it (`method::Method::weight`), with `R` the median of all radii. So it is in mm in a vessel of
//! that radius; and where all vessels are equally wide, every weight is exactly one, and the order is the plain one.

/// By what a vessel may be wider or thinner than the median and still count by its own radius: a surface that almost
/// touches itself is not given all triangles, and one without a wall opposite gives not all of its own.
const MAX_RATIO: f32 = 8.0;

/// The median of the radii over that at each vertex, from `1 / MAX_RATIO` to `MAX_RATIO`. One where the radius is no length:
/// infinite, zero or not a number.
pub(super) fn ratios(radii: &[f32]) -> Vec<f32> {
    let is_length = |radius: &f32| radius.is_finite() && *radius > 0.0;
    let mut known: Vec<f32> = radii.iter().copied().filter(is_length).collect();
    if known.is_empty() {
        return vec![1.0; radii.len()];
    }
    let middle = known.len() / 2;
    let median = *known.select_nth_unstable_by(middle, f32::total_cmp).1;
    let ratio =
        |radius: &f32| if is_length(radius) { (median / radius).clamp(1.0 / MAX_RATIO, MAX_RATIO) } else { 1.0 };
    radii.iter().map(ratio).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_length_counts_as_the_median_does() {
        let radii = [2.0, 1.0, f32::INFINITY, 0.0, f32::NAN, -1.0, 4.0, 1e-30, 1e30];
        assert_eq!(ratios(&radii), [1.0, 2.0, 1.0, 1.0, 1.0, 1.0, 0.5, MAX_RATIO, 1.0 / MAX_RATIO]);
        assert_eq!(ratios(&[f32::INFINITY, 0.0]), [1.0, 1.0]);
        assert_eq!(ratios(&[0.3; 7]), [1.0; 7]);
        assert!(ratios(&[]).is_empty());
        let tiny = ratios(&[f32::MIN_POSITIVE, f32::MAX, f32::from_bits(1)]);
        assert!(tiny.iter().all(|ratio| (1.0 / MAX_RATIO..=MAX_RATIO).contains(ratio)), "{tiny:?}");
    }
}
