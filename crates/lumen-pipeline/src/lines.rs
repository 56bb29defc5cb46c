//! The lines of a surface, which decide on the classes of its vertices: feature edges and the boundary.

/// What decides on classes beside the triangles, over the nodes of a progressive mesh.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lines {
    /// The ends of each feature edge, the lesser first, ascending. An edge is one where either end has found it to be.
    pub features: Vec<[u32; 2]>,
    /// The ends of each edge of one triangle, likewise.
    pub boundary: Vec<[u32; 2]>,
    /// Complex vertices, ascending.
    pub complex: Vec<u32>,
}

impl Lines {
    /// The same over what `of` makes of each node: edges that shrink to a point are gone.
    #[must_use]
    pub fn mapped(&self, of: impl Fn(u32) -> u32) -> Self {
        let edges = |edges: &[[u32; 2]]| {
            let mut mapped: Vec<[u32; 2]> = edges.iter().map(|ends| ends.map(&of)).collect();
            mapped.retain(|[a, b]| a != b);
            mapped.iter_mut().for_each(|ends| ends.sort_unstable());
            mapped.sort_unstable();
            mapped.dedup();
            mapped
        };
        let mut complex: Vec<u32> = self.complex.iter().map(|&node| of(node)).collect();
        complex.sort_unstable();
        complex.dedup();
        Self { features: edges(&self.features), boundary: edges(&self.boundary), complex }
    }
}
