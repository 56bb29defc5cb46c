//! The inside of outlines in a plane, as trapezoids: between two neighbouring heights of their corners, from every odd edge
//! to the next (the even-odd rule), so that a hole stays one. The scan line of Wylie, Romney, Evans and Erdahl ("Half-tone
//! perspective drawings by computer", 1967), with whole strips in place of lines.

use glam::DVec2;

/// The trapezoids within closed outlines: two corners below, then two above, each from left to right.
pub(super) fn trapezoids(outlines: &[Vec<DVec2>]) -> Vec<[DVec2; 4]> {
    let edges_of = |outline: &Vec<DVec2>| {
        let next = outline.iter().cycle().skip(1);
        let upwards = |(&a, &b): (&DVec2, &DVec2)| if a.y < b.y { [a, b] } else { [b, a] };
        outline.iter().zip(next).map(upwards).filter(|[low, high]| low.y < high.y).collect::<Vec<_>>()
    };
    let mut edges: Vec<[DVec2; 2]> = outlines.iter().flat_map(edges_of).collect();
    edges.sort_by(|a, b| a[0].y.total_cmp(&b[0].y));
    let mut heights: Vec<f64> = edges.iter().flatten().map(|p| p.y).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup();
    let (mut next, mut active, mut found) = (0, Vec::<[DVec2; 2]>::new(), Vec::new());
    for strip in heights.windows(2) {
        let [low, high] = [strip[0], strip[1]];
        active.retain(|edge| edge[1].y > low);
        while let Some(edge) = edges.get(next).filter(|edge| edge[0].y <= low) {
            active.push(*edge);
            next += 1;
        }
        let at = |[a, b]: &[DVec2; 2], y: f64| a.lerp(*b, ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0)).x;
        let mut sides: Vec<[f64; 2]> = active.iter().map(|edge| [at(edge, low), at(edge, high)]).collect();
        sides.sort_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
        for pair in sides.chunks_exact(2) {
            let [left, right] = [pair[0], pair[1]];
            let corner = |x: f64, y: f64| DVec2::new(x, y);
            found.push([corner(left[0], low), corner(right[0], low), corner(left[1], high), corner(right[1], high)]);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(outlines: &[Vec<DVec2>]) -> f64 {
        let of = |[a, b, c, d]: [DVec2; 4]| ((b.x - a.x) + (d.x - c.x)) / 2.0 * (c.y - a.y);
        trapezoids(outlines).into_iter().map(of).sum()
    }

    fn outline(points: &[(f64, f64)]) -> Vec<DVec2> {
        points.iter().map(|&(x, y)| DVec2::new(x, y)).collect()
    }

    #[test]
    fn the_trapezoids_have_the_area_of_what_the_outlines_hold() {
        let square = outline(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]);
        let hole = outline(&[(1.0, 1.0), (2.0, 1.0), (2.0, 3.0), (1.0, 3.0)]);
        let triangle = outline(&[(10.0, 1.0), (13.0, 3.0), (9.0, 5.0)]);
        let dented = outline(&[(0.0, 0.0), (4.0, 0.0), (2.0, 1.0), (4.0, 4.0), (0.0, 4.0)]);
        assert!((area(std::slice::from_ref(&square)) - 16.0).abs() < 1e-12);
        assert!((area(&[square.clone(), hole]) - 14.0).abs() < 1e-12, "a hole stays one");
        assert!((area(&[square, triangle]) - 23.0).abs() < 1e-12);
        assert!((area(&[dented]) - 12.0).abs() < 1e-12);
        assert!(trapezoids(&[outline(&[(0.0, 0.0), (1.0, 0.0)])]).is_empty());
    }
}
