//! An order of points in which those that are near each other in space are near each other in memory: along the curve
//! of Morton, "A computer oriented geodetic data base and a new technique in file sequencing" (1966).

use glam::Vec3;

use lumen_mesh::Bounds;

/// Cells along an axis: 2 to the power of this.
const BITS: u32 = 10;

/// The indices of `points` along the curve; those in one cell keep their order.
pub(super) fn curve_order(points: &[Vec3]) -> Vec<u32> {
    let bounds = Bounds::of_most(points);
    let (least, size) = (Vec3::from(bounds.min), bounds.longest_side());
    let scale = if size > 0.0 { ((1 << BITS) as f32 - 0.5) / size } else { 0.0 };
    let code = |p: Vec3| {
        // A coordinate that is no number becomes 0, that of a stray the first or the last cell.
        let cell = (p - least) * scale;
        spread(cell.x as u32) | spread(cell.y as u32) << 1 | spread(cell.z as u32) << 2
    };
    let mut keys: Vec<u64> = points.iter().enumerate().map(|(i, &p)| u64::from(code(p)) << 32 | i as u64).collect();
    keys.sort_unstable();
    keys.into_iter().map(|key| key as u32).collect()
}

/// The ten bits of `x`, two zeros between each.
fn spread(x: u32) -> u32 {
    let x = x.min((1 << BITS) - 1);
    let x = (x | x << 16) & 0x0300_00ff;
    let x = (x | x << 8) & 0x0300_f00f;
    let x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corners_of_a_cube_follow_their_bits() {
        let corner = |i: u32| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32);
        let scattered = [5, 2, 7, 0, 3, 6, 1, 4];
        let points = scattered.map(corner);
        assert_eq!(
            curve_order(&points).into_iter().map(|i| scattered[i as usize]).collect::<Vec<_>>(),
            [0, 1, 2, 3, 4, 5, 6, 7]
        );
    }

    #[test]
    fn points_in_one_place_keep_their_order_and_none_is_lost() {
        assert_eq!(curve_order(&[Vec3::ONE; 5]), [0, 1, 2, 3, 4]);
        assert!(curve_order(&[]).is_empty());
        let mut found = curve_order(&[Vec3::NAN, Vec3::X, Vec3::splat(f32::INFINITY), Vec3::Y]);
        found.sort_unstable();
        assert_eq!(found, [0, 1, 2, 3]);
    }
}
