use super::*;
use lumen_mesh::Topology;

fn linked(vertices: usize, triangles: Vec<[u32; 3]>) -> Rings {
    let positions = (0..vertices).map(|v| Vec3::new(v as f32, (v * v % 7) as f32, (v % 3) as f32)).collect();
    let mesh = TriMesh { positions, triangles };
    let mut rings = Rings::new(&mesh);
    assert!(rings.link(&mesh, &Topology::new(vertices, &mesh.triangles), vertices));
    rings.assert_well_formed();
    rings
}

/// The four faces of a tetrahedron.
fn tetrahedron([a, b, c, d]: [u32; 4]) -> [[u32; 3]; 4] {
    [[a, c, b], [a, b, d], [b, c, d], [c, a, d]]
}

#[test]
fn both_ends_of_an_edge_that_two_closed_pieces_share_are_cut() {
    let rings = linked(6, [tetrahedron([0, 1, 2, 3]), tetrahedron([0, 1, 4, 5])].concat());
    let parts = |node: u32| (0..rings.len() as u32).filter(|&v| rings.nodes[v as usize] == node).count();
    assert_eq!([0, 1, 2, 3, 4, 5].map(parts), [2, 2, 1, 1, 1, 1]);
    let stays = (0..rings.len() as u32).filter(|&v| rings.stays(v)).count();
    assert_eq!(stays, 4);
}

#[test]
fn triangles_back_to_back_alone_or_on_a_piece_are_told_from_discs() {
    linked(3, vec![[0, 1, 2], [2, 1, 0]]);
    // On an edge, on a triangle, and twice on one.
    linked(5, [&tetrahedron([0, 1, 2, 3])[..], &[[0, 1, 4], [4, 1, 0]]].concat());
    linked(4, [&tetrahedron([0, 1, 2, 3])[..], &[[0, 1, 2]]].concat());
    linked(4, [&tetrahedron([0, 1, 2, 3])[..], &[[0, 1, 2], [0, 2, 1]]].concat());
}

#[test]
fn a_stray_leaves_the_others_their_size_and_is_itself_a_number() {
    for far in [1e6, 1e9] {
        let mut positions: Vec<Vec3> = (0..100).map(|i| Vec3::new(i as f32, (i % 9) as f32, (i % 5) as f32)).collect();
        positions.push(Vec3::splat(far));
        let rings = Rings::new(&TriMesh { positions, triangles: Vec::new() });
        let most = rings.positions.iter().filter(|p| p.abs().max_element() < 2.0 * SIZE).count();
        assert_eq!(most, 100);
        let longest = rings.positions.iter().map(|p| p.length_squared()).fold(0.0, f32::max);
        assert!((longest * longest).is_finite());
    }
}
