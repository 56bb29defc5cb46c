//! Which of the triangles around a collapse run into others, before and after.

use lumen_mesh::crossing::{Face, cross_at_all};

/// Whether one of the faces in `own` runs into another of them, or into one of `others`.
pub(super) fn any(own: &[Face], others: &[Face]) -> bool {
    own.iter().enumerate().any(|(i, face)| others.iter().chain(&own[i + 1..]).any(|other| cross_at_all(face, other)))
}

/// How many triangles run into `others` once `old` has become `new` that are new or did not before, and which of `new` do;
/// `None` where they are more than `old` can make up for.
pub(super) fn newly_hit(old: &[Face], new: &[Face], others: &[Face]) -> Option<(usize, Vec<bool>)> {
    let mut hits = vec![false; new.len()];
    let mut more = 0;
    for other in others {
        let mut is_hit = false;
        for (hit, face) in hits.iter_mut().zip(new).filter(|(hit, _)| !**hit) {
            *hit = cross_at_all(face, other);
            more += usize::from(*hit);
            is_hit |= *hit;
        }
        is_hit = is_hit || hits.iter().zip(new).any(|(hit, face)| *hit && cross_at_all(face, other));
        more += usize::from(is_hit && !old.iter().any(|face| cross_at_all(face, other)));
        if more > old.len() {
            return None;
        }
    }
    Some((more, hits))
}

/// Whether no more triangles cross once `old` has become `new` than did among `others`: each of `old` that crossed makes up for
/// one that is new, of `new` or of `others`.
pub(super) fn are_no_more(old: &[Face], new: &[Face], others: &[Face]) -> bool {
    let Some((mut more, mut hits)) = newly_hit(old, new, others) else { return false };
    for i in 0..new.len() {
        for j in i + 1..new.len() {
            if !(hits[i] && hits[j]) && cross_at_all(&new[i], &new[j]) {
                more += usize::from(!hits[i]) + usize::from(!hits[j]);
                (hits[i], hits[j]) = (true, true);
            }
        }
    }
    let crossed = |&i: &usize| {
        others.iter().chain(&old[i + 1..]).any(|other| cross_at_all(&old[i], other))
            || old[..i].iter().any(|other| cross_at_all(other, &old[i]))
    };
    (0..old.len()).filter(crossed).take(more).count() == more
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    /// A triangle that stands on the plane x = `x`, and one that lies across all x below 10.
    fn standing(number: u32, x: f32) -> Face {
        let corners = [Vec3::new(x, -1.0, -1.0), Vec3::new(x + 0.1, 2.0, -1.0), Vec3::new(x, 0.0, 2.0)];
        Face { vertices: [0, 1, 2].map(|i| 3 * number + i), corners }
    }

    fn lying(number: u32, to: f32) -> Face {
        let corners = [Vec3::new(-1.0, -0.5, 0.0), Vec3::new(to, 0.0, 0.1), Vec3::new(-1.0, 0.5, 0.2)];
        Face { vertices: [0, 1, 2].map(|i| 3 * number + i), corners }
    }

    #[test]
    fn a_triangle_that_runs_into_three_is_one_of_its_own_and_three_others() {
        let others = [1.0, 2.0, 3.0, 30.0].map(|x| standing(10 + x as u32, x));
        assert!(any(&[lying(0, 10.0)], &others) && !any(&[lying(0, 0.5)], &others));
        assert!(any(&[lying(0, 10.0), standing(1, 4.0)], &[]));
        // So as many have to have crossed before: here those that lie upon each other.
        let before = [5, 6, 7, 8].map(|number| lying(number, 0.5));
        assert!(!are_no_more(&before[..3], &[lying(0, 10.0)], &others));
        assert!(are_no_more(&before, &[lying(0, 10.0)], &others));
    }

    #[test]
    fn what_is_gone_makes_up_for_what_is_new_and_no_more() {
        let others = [1.0, 2.0, 3.0].map(|x| standing(10 + x as u32, x));
        let [one, two, all] = [1.8, 2.8, 10.0].map(|x| [lying(0, x)]);
        let within = |after: &[Face], before: &[Face]| are_no_more(before, after, &others);
        assert!(within(&one, &one) && within(&one, &two) && within(&two, &all));
        // The same triangle of its own, but one more of the others.
        assert!(!within(&two, &one) && !within(&all, &one));
        let both = [lying(0, 1.8), lying(1, 1.7)];
        // One of two crosses no more, and another of the others does now.
        assert!(within(&two, &both) && !within(&all, &both));
    }
}
