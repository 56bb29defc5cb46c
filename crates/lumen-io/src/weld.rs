//! Welding: vertices with exactly the same coordinates become one.
//!
//! Exact bits, no tolerance: a tolerance would have to be guessed, and could close a thin gap between two vessels.
//! Minus zero is zero. New vertices are numbered in the order of their first occurrence, so the result does not
//! depend on how the table hashes. Arrays go along: of vertices that become one, scalars take the mean and labels the
//! majority.

use hashbrown::hash_table::{Entry, HashTable};

use lumen_mesh::arrays::Association;
use lumen_mesh::task::Yielder;
use lumen_mesh::{Array, Blend, TriMesh, Vec3, compacted, used_vertices};

/// Positions between two looks at the clock.
const BLOCK: usize = 1 << 15;

/// Coincident vertices welded: of `positions`, at most `u32::MAX`, `triangles` over them, and arrays of either. Without
/// degenerate triangles and unused vertices.
pub(super) async fn weld(
    positions: Vec<Vec3>,
    mut triangles: Vec<[u32; 3]>,
    arrays: Vec<Array>,
    yielder: &Yielder,
) -> (TriMesh, Vec<Array>) {
    let (distinct, index) = distinct(&positions, yielder).await;
    drop(positions);
    let mut rows = Rows::of(&arrays, index.len(), &triangles);
    for t in &mut triangles {
        *t = t.map(|v| index[v as usize]);
    }
    let has_area = |&[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
    if let Some(rows) = &mut rows {
        rows.triangles = (0..triangles.len() as u32).filter(|&t| has_area(&triangles[t as usize])).collect();
    }
    triangles.retain(has_area);
    let arrays = rows.map_or_else(Vec::new, |rows| rows.welded(&arrays, &index, &triangles));
    (compacted(&distinct, triangles), arrays)
}

/// Each position once, in the order of first occurrence, and for each position its place there; minus zeros become zeros.
async fn distinct(positions: &[Vec3], yielder: &Yielder) -> (Vec<Vec3>, Vec<u32>) {
    // A closed surface written triangle by triangle has six entries a vertex, an indexed one has one.
    let mut table = HashTable::with_capacity(positions.len() / 4);
    let mut distinct = Vec::with_capacity(positions.len() / 4);
    let mut index = Vec::with_capacity(positions.len());
    for block in positions.chunks(BLOCK) {
        index.extend(block.iter().map(|&position| place(position, &mut table, &mut distinct)));
        yielder.rest(index.len() as f32 / positions.len() as f32).await;
    }
    (distinct, index)
}

/// The place of a position among the distinct ones, to which it is added where it is new.
fn place(position: Vec3, table: &mut HashTable<u32>, distinct: &mut Vec<Vec3>) -> u32 {
    let position = position + Vec3::ZERO;
    let key = bits(position);
    let found = table.entry(hash(key), |&v| bits(distinct[v as usize]) == key, |&v| hash(bits(distinct[v as usize])));
    match found {
        Entry::Occupied(entry) => *entry.get(),
        Entry::Vacant(entry) => {
            let v = distinct.len() as u32;
            entry.insert(v);
            distinct.push(position);
            v
        }
    }
}

fn bits(p: Vec3) -> [u32; 3] {
    p.to_array().map(f32::to_bits)
}

/// Spreads 96 bits over 64: coordinates cut from a grid share most of their bits, so both halves must be well
/// mixed. The constants are those of MurmurHash3's finaliser (Appleby 2011).
fn hash([x, y, z]: [u32; 3]) -> u64 {
    let mut h = (u64::from(x) | u64::from(y) << 32).wrapping_mul(0xff51_afd7_ed55_8ccd);
    h ^= h >> 32;
    h = (h ^ u64::from(z)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    h ^= h >> 29;
    h.wrapping_mul(0xff51_afd7_ed55_8ccd)
}

/// Which rows of arrays the import keeps.
struct Rows {
    /// Whether a triangle uses the vertex: what lies at the same place and is used by none has no say.
    is_used: Vec<bool>,
    /// Triangles that stay.
    triangles: Vec<u32>,
}

impl Rows {
    /// `None` where there are no arrays.
    fn of(arrays: &[Array], vertices: usize, triangles: &[[u32; 3]]) -> Option<Self> {
        if arrays.is_empty() {
            return None;
        }
        let mut is_used = vec![false; vertices];
        triangles.as_flattened().iter().for_each(|&v| is_used[v as usize] = true);
        Some(Self { is_used, triangles: Vec::new() })
    }

    /// The arrays of the triangles `kept` over vertices welded by `index`. Of vertices that become one, scalars take the
    /// mean and labels the majority.
    fn welded(self, arrays: &[Array], index: &[u32], kept: &[[u32; 3]]) -> Vec<Array> {
        const NONE: u32 = u32::MAX;
        let used = used_vertices(index.len(), kept);
        let mut new_of = vec![NONE; index.len()];
        used.iter().zip(0..).for_each(|(&v, new)| new_of[v as usize] = new);
        let row = |(&v, &is_used): (&u32, &bool)| if is_used { new_of[v as usize] } else { NONE };
        let rows: Vec<u32> = index.iter().zip(&self.is_used).map(row).collect();
        let points = Blend::of_groups(used.len(), &rows, |_| 1.0);
        arrays
            .iter()
            .map(
                |array| if array.on == Association::Point { points.of(array) } else { array.gathered(&self.triangles) },
            )
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::task::at_once;

    /// The positions that stay, and what became of each.
    fn weld(positions: &[Vec3]) -> (Vec<Vec3>, Vec<u32>) {
        at_once(distinct(positions, &Yielder::never()))
    }

    #[test]
    fn equal_positions_become_one_in_the_order_they_come() {
        let p = |x: f32| Vec3::new(x, 0.0, 1.0);
        let (positions, index) = weld(&[p(2.0), p(0.0), p(2.0), p(-0.0), p(f32::MIN_POSITIVE), p(2.0)]);
        assert_eq!(index, [0, 1, 0, 1, 2, 0]);
        assert_eq!(positions, [p(2.0), p(0.0), p(f32::MIN_POSITIVE)]);
        assert!(positions[1].x.is_sign_positive());
    }

    #[test]
    fn a_grid_of_positions_stays_apart() {
        let grid: Vec<Vec3> =
            (0..40 * 40 * 40).map(|i| Vec3::new((i % 40) as f32, (i / 40 % 40) as f32, (i / 1600) as f32)).collect();
        assert_eq!(weld(&grid).0, grid);
    }
}
