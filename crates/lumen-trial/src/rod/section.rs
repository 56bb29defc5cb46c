//! What is given of a rod, node by node: stiffness, rest shape, mass, and what is fixed.

/// Numbers of a node, its cell and the edge that begins there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Section {
    /// Rest length of the edge to the next node, in mm; of the last node unused.
    pub length: f64,
    /// Length of the cell that bends and twists at the node, in mm.
    pub cell: f64,
    /// Bending stiffness EI in N mm2.
    pub ei: f64,
    /// Torsional stiffness GJ in N mm2.
    pub gj: f64,
    /// Axial stiffness EA of the edge in N.
    pub ea: f64,
    /// Discrete curvature at rest: towards the director, and across.
    pub rest: [f64; 2],
    /// Mass of the node in t.
    pub mass: f64,
    /// Viscous drag of the node in N s/mm.
    pub drag: f64,
}

/// What is fixed of a node and of the edge that begins there: where it is put it stays, whatever pulls at it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fixed {
    /// Its position.
    pub position: bool,
    /// The angle of the edge's frame.
    pub angle: bool,
}
