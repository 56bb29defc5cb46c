//! The map of a deviation: each sample counts at the corners of the triangle that it lies on or is nearest to, by its
//! place there, and a vertex has the mean of what counts at it. A vertex at which few count has its neighbours' as well.

/// A vertex of the map at which less than so many samples count has its neighbours' as well.
const FEW: f64 = 4.0;

/// Distances over the vertices of a surface.
#[derive(Debug)]
pub(super) struct DistanceMap {
    /// For each vertex, the weights that count there, and the distances and the signed distances times their weights.
    sums: Vec<[f64; 3]>,
    /// Below this weight a vertex takes its neighbours' sums.
    least_weight: f64,
}

impl DistanceMap {
    /// Without a sample yet.
    pub(super) fn new() -> Self {
        Self { sums: Vec::new(), least_weight: FEW }
    }

    /// Makes room for so many vertices, where there is none.
    pub(super) fn reserve(&mut self, vertices: usize) {
        if self.sums.is_empty() {
            self.sums = vec![[0.0; 3]; vertices];
        }
    }

    /// Counts a sample at this place of a triangle.
    pub(super) fn add(&mut self, corners: [u32; 3], weights: [f32; 3], signed: f32) {
        for (v, weight) in corners.into_iter().zip(weights.map(f64::from)) {
            let [weights, sum, signed_sum] = &mut self.sums[v as usize];
            *weights += weight;
            *sum += weight * f64::from(signed.abs());
            *signed_sum += weight * f64::from(signed);
        }
    }

    /// Gives the vertices at which few samples count their neighbours' as well, and round by round those at which none
    /// counts; whether that was the last round.
    pub(super) fn spread(&mut self, triangles: &[[u32; 3]]) -> bool {
        let is_poor = |[weight, ..]: [f64; 3], least: f64| weight < least || weight == 0.0;
        let before = self.sums.clone();
        let mut has_gained = false;
        for &corners in triangles {
            let sums = corners.map(|v| before[v as usize]);
            for (i, v) in corners.into_iter().enumerate() {
                if is_poor(sums[i], self.least_weight) {
                    let [of_one, of_other] = [sums[(i + 1) % 3], sums[(i + 2) % 3]];
                    let own = &mut self.sums[v as usize];
                    *own = std::array::from_fn(|k| own[k] + of_one[k] + of_other[k]);
                    has_gained |= own[0] > 0.0;
                }
            }
        }
        self.least_weight = 0.0;
        let is_empty = |corners: &[u32; 3]| corners.iter().any(|&v| self.sums[v as usize][0] == 0.0);
        !has_gained || !triangles.iter().any(is_empty)
    }

    /// For each vertex the mean distance and the mean signed distance; 0 where none counts.
    pub(super) fn means(&self) -> [Vec<f32>; 2] {
        [1, 2].map(|of: usize| {
            let mean = |sums: &[f64; 3]| if sums[0] > 0.0 { (sums[of] / sums[0]) as f32 } else { 0.0 };
            self.sums.iter().map(mean).collect()
        })
    }
}
