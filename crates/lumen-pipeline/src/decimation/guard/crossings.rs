//! Which of the triangles around a collapse run into others, before and after.

use lumen_mesh::crossing::{Face, cross_at_all};

/// Which triangles of two lists, or of the first alone, run into each other.
pub(super) struct Crossings {
    /// How many of the first.
    own: usize,
    /// Which of the second.
    others: Vec<bool>,
}

impl Crossings {
    pub(super) fn between(own: &[Face], others: &[Face]) -> Self {
        let mut is_hit = vec![false; others.len()];
        let mut hits = vec![false; own.len()];
        for (i, face) in own.iter().enumerate() {
            for (j, other) in others.iter().enumerate() {
                if cross_at_all(face, other) {
                    hits[i] = true;
                    is_hit[j] = true;
                }
            }
            for j in i + 1..own.len() {
                if cross_at_all(face, &own[j]) {
                    hits[i] = true;
                    hits[j] = true;
                }
            }
        }
        Self { own: hits.into_iter().filter(|&hit| hit).count(), others: is_hit }
    }

    pub(super) fn is_none(&self) -> bool {
        self.own == 0
    }

    /// Whether no more triangles cross than did: each that is gone makes up for one that is new, of the first list or of
    /// the second.
    pub(super) fn is_within(&self, before: &Self) -> bool {
        let newly_hit = self.others.iter().zip(&before.others).filter(|&(&after, &before)| after && !before).count();
        self.own + newly_hit <= before.own
    }
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
        let found = Crossings::between(&[lying(0, 10.0)], &others);
        assert_eq!((found.own, found.others.as_slice()), (1, &[true, true, true, false][..]));
        let none = Crossings::between(&[lying(0, 0.5)], &others);
        assert!(none.is_none() && !found.is_none());
        let two = Crossings::between(&[lying(0, 10.0), standing(1, 4.0)], &[]);
        assert_eq!(two.own, 2);
    }

    #[test]
    fn what_is_gone_makes_up_for_what_is_new_and_no_more() {
        let others = [1.0, 2.0, 3.0].map(|x| standing(10 + x as u32, x));
        let reaching = |to: f32| Crossings::between(&[lying(0, to)], &others);
        let (one, two, all) = (reaching(1.8), reaching(2.8), reaching(10.0));
        assert!(one.is_within(&one) && one.is_within(&two) && two.is_within(&all));
        // The same triangle of its own, but one more of the others.
        assert!(!two.is_within(&one) && !all.is_within(&one));
        let both = Crossings::between(&[lying(0, 1.8), lying(1, 1.7)], &others);
        // One of two crosses no more, and another of the others does now.
        assert!(two.is_within(&both) && !all.is_within(&both));
    }
}
