//! What is drawn, measured in pixels against geometry: silhouettes, lines, colours. Needs a GPU or a software one and
//! fails without. Pictures to look at are left in the target folder's `tmp`.

#![allow(clippy::disallowed_methods, reason = "a test compares within bounds")]
#![cfg(feature = "gui")]

mod device;
mod occlusion;
mod shapes;
mod slices;
mod stage;
mod trial;

use std::collections::BTreeSet;
use std::f32::consts::PI;

use glam::{Quat, Vec2, Vec3};
use lumen::mesh::{Bounds, TriMesh};
use lumen::render::{
    Backdrop, Camera, ClipPlane, Colour, ColourMap, Draw, Drawable, GpuSurface, Look, Picture, Style, SurfaceError,
    ViewTarget, diverging, viridis,
};
use shapes::{arch, sphere, square, together};
use stage::{before_backdrop, in_front_of, plain, shown, stage};

const WHITE: Colour = Colour::hex(0xFF_FF_FF);
const BLACK: Colour = Colour::hex(0);

/// How much of each pixel is covered, 0-1: the same picture on black and on white tells them apart.
fn coverage(size: [u32; 2], camera: &Camera, drawables: &[Drawable<'_>]) -> Vec<f32> {
    let [on_black, on_white] =
        [BLACK, WHITE].map(|background| stage().picture(size, camera, drawables, &plain(background)));
    let pairs = on_black.rgba.chunks_exact(4).zip(on_white.rgba.chunks_exact(4));
    pairs.map(|(black, white)| 1.0 - (f32::from(white[1]) - f32::from(black[1])) / 255.0).collect()
}

/// Where `point` is in a picture, in pixels from the top left.
fn pixel_of(camera: &Camera, point: Vec3, [width, height]: [u32; 2]) -> Vec2 {
    let (width, height) = (width as f32, height as f32);
    let at = camera.project(point, width / height).unwrap();
    Vec2::new((at.x + 1.0) / 2.0 * width, (1.0 - at.y) / 2.0 * height)
}

fn distance_to_segment(p: Vec2, [a, b]: [Vec2; 2]) -> f32 {
    let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
    p.distance(a + t * (b - a))
}

/// The pixels that are not `background`.
fn drawn_pixels(picture: &Picture, background: Colour) -> BTreeSet<(u32, u32)> {
    let all = (0..picture.height).flat_map(|y| (0..picture.width).map(move |x| (x, y)));
    all.filter(|&(x, y)| picture.pixel(x, y) != Some(background.0)).collect()
}

fn differing_pixels(a: &Picture, b: &Picture) -> usize {
    assert_eq!((a.width, a.height), (b.width, b.height));
    a.rgba.chunks_exact(4).zip(b.rgba.chunks_exact(4)).filter(|(a, b)| a != b).count()
}

fn is_near(found: [u8; 3], expected: Colour, tolerance: u8) -> bool {
    found.iter().zip(expected.0).all(|(a, b)| a.abs_diff(b) <= tolerance)
}

#[test]
fn a_sphere_covers_the_area_of_its_projection() {
    let mesh = sphere(20.0, 120);
    let surface = stage().surface(&mesh);
    for (size, distance) in [([640, 480], 100.0), ([300, 500], 45.0)] {
        let mut camera = in_front_of(&mesh, 1.0);
        camera.distance = distance;
        for look in [Look::Shaded, Look::Flat] {
            let area: f32 = coverage(size, &camera, &[shown(&surface, look)]).iter().sum();
            // The cone that touches a sphere has its half angle's sine = radius / distance.
            let radius = 0.5 * size[1] as f32 * (20.0_f32 / distance).asin().tan() / (camera.fov_y / 2.0).tan();
            let expected = PI * radius * radius;
            let whole = (size[0] * size[1]) as f32;
            if 2.0 * radius < size[0].min(size[1]) as f32 {
                assert!((area / expected - 1.0).abs() < 0.01, "{look:?}: {area} pixels, not {expected}");
            } else {
                assert!(area > 0.7 * whole);
            }
        }
    }
}

#[test]
fn a_triangles_wireframe_is_its_three_edges() {
    let size = [400, 300];
    let corners = [Vec3::new(-30.0, 5.0, -20.0), Vec3::new(35.0, -8.0, -14.0), Vec3::new(4.0, 0.0, 24.0)];
    let mesh = TriMesh { positions: corners.to_vec(), triangles: vec![[0, 1, 2]] };
    let camera = in_front_of(&mesh, 4.0 / 3.0);
    let surface = stage().surface(&mesh);
    for look in [Look::Wireframe, Look::SeeThrough] {
        let picture = stage().picture(size, &camera, &[shown(&surface, look)], &plain(WHITE));
        let drawn = drawn_pixels(&picture, WHITE);
        let [a, b, c] = corners.map(|corner| pixel_of(&camera, corner, size));
        let edges = [[a, b], [b, c], [c, a]];
        for &(x, y) in &drawn {
            let centre = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            let away = edges.map(|edge| distance_to_segment(centre, edge)).into_iter().fold(f32::MAX, f32::min);
            assert!(away < 1.5, "{look:?}: pixel {x} {y} is {away} from every edge");
        }
        for [from, to] in edges {
            for step in 1..200 {
                let p = from.lerp(to, step as f32 / 200.0);
                let covered = [-1, 0, 1].iter().any(|dx| {
                    [-1, 0, 1].iter().any(|dy| drawn.contains(&((p.x as i32 + dx) as u32, (p.y as i32 + dy) as u32)))
                });
                assert!(covered, "{look:?}: a gap at {p}");
            }
        }
    }
}

#[test]
fn a_line_is_as_dark_as_the_theme_says() {
    let mesh = square(20.0, 0.0);
    let surface = stage().surface(&mesh);
    let drawable = Drawable { surface: &surface, look: Look::Wireframe, tint: Some(BLACK) };
    let covered: f32 = coverage([200, 200], &in_front_of(&mesh, 1.0), &[drawable]).iter().sum();
    // Four sides and a diagonal, one pixel wide; a rasteriser may measure a line's width along an axis.
    let side = 200.0 / 1.08;
    let expected = side * (4.0 + 2.0_f32.sqrt());
    assert!((0.85..1.1).contains(&(covered / expected)), "{covered} {expected}");
}

#[test]
fn hidden_lines_are_hidden() {
    let size = [240, 240];
    let (near, far) = (square(40.0, -10.0), square(20.0, 30.0));
    let both = together(&near, &far);
    let camera = in_front_of(&both, 1.0);
    let picture =
        |mesh: &TriMesh, look| stage().picture(size, &camera, &[shown(&stage().surface(mesh), look)], &plain(WHITE));
    assert!(!drawn_pixels(&picture(&far, Look::Wireframe), WHITE).is_empty());
    let alone = picture(&near, Look::Wireframe);
    assert_eq!(differing_pixels(&picture(&both, Look::Wireframe), &alone), 0);
    // Faint where they are asked for.
    assert!(differing_pixels(&picture(&both, Look::SeeThrough), &alone) > 100);
    // One surface hides another's, whichever comes first.
    let (a, b) = (stage().surface(&far), stage().surface(&near));
    for order in [[&a, &b], [&b, &a]] {
        let drawables = order.map(|surface| shown(surface, Look::Wireframe));
        assert_eq!(differing_pixels(&stage().picture(size, &camera, &drawables, &plain(WHITE)), &alone), 0);
    }
}

#[test]
fn a_surface_does_not_hide_its_own_lines() {
    let size = [600, 600];
    let mesh = sphere(20.0, 14);
    let camera = in_front_of(&mesh, 1.0);
    let surface = stage().surface(&mesh);
    let drawn =
        drawn_pixels(&stage().picture(size, &camera, &[shown(&surface, Look::Wireframe)], &plain(WHITE)), WHITE);
    let (mut seen, mut gaps) = (0, 0);
    for [a, b] in lumen::render::unique_edges(&mesh.triangles, mesh.positions.len()) {
        let [a, b] = [a, b].map(|v| mesh.positions[v as usize]);
        for step in 0..20 {
            let point = a.lerp(b, (step as f32 + 0.5) / 20.0);
            let cosine = point.normalize().dot((camera.eye() - point).normalize());
            let at = pixel_of(&camera, point, size);
            let is_drawn = drawn.contains(&(at.x as u32, at.y as u32));
            if cosine > 0.25 {
                seen += 1;
                gaps += usize::from(!is_drawn);
            }
        }
    }
    assert!(seen > 3000 && gaps * 200 < seen, "{gaps} gaps in {seen} points of visible edges");
}

#[test]
fn the_background_goes_from_the_themes_top_to_its_bottom() {
    for style in [Style::LIGHT, Style::DARK] {
        let picture = stage().picture([64, 256], &Camera::default(), &[], &style);
        for x in 0..64 {
            assert!(is_near(picture.pixel(x, 0).unwrap(), style.background_top, 1));
            assert!(is_near(picture.pixel(x, 255).unwrap(), style.background_bottom, 1));
        }
        assert!(picture.rgba.chunks_exact(4).all(|pixel| pixel[3] == 255), "opaque");
    }
    let even = stage().picture([64, 64], &Camera::default(), &[], &plain(Colour::hex(0x12_34_56)));
    assert!(drawn_pixels(&even, Colour::hex(0x12_34_56)).is_empty(), "an even colour stays even");
}

#[test]
fn another_level_is_another_picture_over_the_same_positions() {
    let size = [200, 200];
    let mesh = sphere(20.0, 24);
    let camera = in_front_of(&mesh, 1.0);
    let mut surface = stage().surface(&mesh);
    let all = surface.triangle_count();
    let areas = [mesh.triangles.len(), mesh.triangles.len() / 3, mesh.triangles.len()].map(|count| {
        stage().set_level(&mut surface, &mesh, &mesh.triangles[..count]);
        assert_eq!(surface.triangle_count(), count as u32);
        coverage(size, &camera, &[shown(&surface, Look::Shaded)]).iter().sum::<f32>()
    });
    assert_eq!(surface.triangle_count(), all);
    assert!(areas[1] < 0.7 * areas[0] && areas[2] == areas[0], "{areas:?}");
}

#[test]
fn a_colour_map_shows_its_published_colours() {
    let mesh = square(20.0, 0.0);
    let camera = in_front_of(&mesh, 1.0);
    let mut surface = stage().surface(&mesh);
    let style = Style { map: Some(ColourMap { range: (0.5, 2.5) }), ..plain(WHITE) };
    let mut centre = |scalar: f32, style: &Style| {
        let scalars = Some(&[scalar; 4][..]);
        surface.set_scalars(&stage().device, &stage().queue, scalars).unwrap();
        let picture = stage().picture([101, 101], &camera, &[shown(&surface, Look::Shaded)], style);
        picture.pixel(50, 50).unwrap()
    };
    // The square faces the eye, so nothing darkens it.
    for (scalar, t) in [(0.5, 0.0), (2.5, 1.0), (-7.0, 0.0), (70.0, 1.0), (1.5, 0.5), (0.9, 0.2)] {
        let found = centre(scalar, &style);
        assert!(is_near(found, viridis(t), 2), "{scalar}: {found:?}, not {:?}", viridis(t));
    }
    let flat = Style { map: Some(ColourMap { range: (1.0, 1.0) }), ..style };
    assert!(is_near(centre(1.0, &flat), viridis(0.0), 2));
    assert!(is_near(centre(1.1, &flat), viridis(1.0), 2));
    let without = centre(2.5, &plain(WHITE));
    surface.set_scalars(&stage().device, &stage().queue, None).unwrap();
    let picture = stage().picture([101, 101], &camera, &[shown(&surface, Look::Shaded)], &style);
    assert_eq!(picture.pixel(50, 50).unwrap(), without, "no scalars, no map");
}

#[test]
fn what_has_no_number_has_the_walls_colour_or_its_own() {
    let mesh = square(20.0, 0.0);
    let camera = in_front_of(&mesh, 1.0);
    let mut surface = stage().surface(&mesh);
    surface.set_scalars(&stage().device, &stage().queue, Some(&[1e30; 4])).unwrap();
    let mapped = Style { map: Some(ColourMap { range: (0.0, 1.0) }), ..plain(WHITE) };
    for (style, expected) in
        [(mapped, mapped.surface), (Style { unknown: Some(Style::UNKNOWN), ..mapped }, Style::UNKNOWN)]
    {
        let picture = stage().picture([101, 101], &camera, &[shown(&surface, Look::Shaded)], &style);
        let found = picture.pixel(50, 50).unwrap();
        assert!(is_near(found, expected, 2), "{found:?}, not {expected:?}");
    }
}

#[test]
fn raking_light_parts_what_stands_ten_degrees_to_either_side() {
    let seen = |degrees: f32, raking: bool| {
        let turn = Quat::from_rotation_z(degrees.to_radians());
        let mut mesh = square(20.0, 0.0);
        mesh.positions.iter_mut().for_each(|p| *p = turn * *p);
        let surface = stage().surface(&mesh);
        let camera = in_front_of(&square(20.0, 0.0), 1.0);
        let style = Style { raking, ..Style::LIGHT };
        Colour(stage().picture([51, 51], &camera, &[shown(&surface, Look::Shaded)], &style).pixel(25, 25).unwrap())
    };
    let parted = |raking| lumen::render::contrast(seen(10.0, raking), seen(-10.0, raking));
    let (even, from_the_side) = (parted(false), parted(true));
    assert!(even < 1.5 && from_the_side > 2.0 * even, "{even} {from_the_side}");
}

#[test]
fn a_map_that_goes_both_ways_is_white_in_the_middle() {
    let mesh = square(20.0, 0.0);
    let camera = in_front_of(&mesh, 1.0);
    let mut surface = stage().surface(&mesh);
    let style = Style { map: Some(ColourMap { range: (-0.5, 0.5) }), diverging: true, ..plain(BLACK) };
    for (scalar, t) in [(-0.5, 0.0), (-0.2, 0.3), (0.0, 0.5), (0.4, 0.9), (3.0, 1.0)] {
        surface.set_scalars(&stage().device, &stage().queue, Some(&[scalar; 4])).unwrap();
        let picture = stage().picture([101, 101], &camera, &[shown(&surface, Look::Shaded)], &style);
        let found = picture.pixel(50, 50).unwrap();
        // The shader's table has 256 colours, between eleven.
        assert!(is_near(found, diverging(t), 4), "{scalar}: {found:?}, not {:?}", diverging(t));
    }
}

#[test]
fn a_clip_plane_leaves_out_what_lies_before_it_in_every_look() {
    let mut mesh = sphere(10.0, 48);
    // Turned, so that no triangle is seen exactly edge-on: where such a one is is a matter of rounding.
    let turn = Quat::from_axis_angle(Vec3::new(1.0, 2.0, 3.0).normalize(), 0.4);
    mesh.positions.iter_mut().for_each(|p| *p = turn * *p);
    let (camera, surface) = (in_front_of(&mesh, 1.0), stage().surface(&mesh));
    for look in [Look::Shaded, Look::Flat, Look::Wireframe, Look::SeeThrough] {
        let drawn = |clip: Option<ClipPlane>| {
            let style = Style { clip, ..plain(WHITE) };
            drawn_pixels(&stage().picture([201, 201], &camera, &[shown(&surface, look)], &style), WHITE)
        };
        let whole = drawn(None);
        // A plane that is seen edge-on: nothing is drawn above it, and below it what was drawn before.
        let height = pixel_of(&camera, Vec3::ZERO, [201, 201]).y;
        let above = drawn(Some(ClipPlane { normal: Vec3::Z, offset: 0.0 }));
        let higher: Vec<_> = above.iter().filter(|(_, y)| *y as f32 <= height - 3.0).collect();
        assert!(higher.is_empty(), "{look:?}: {} pixels, the first at {:?}", higher.len(), higher.first());
        let is_below = |&&(_, y): &&(u32, u32)| y as f32 > height + 3.0;
        let below = |of: &BTreeSet<(u32, u32)>| of.iter().filter(is_below).count();
        assert!(below(&whole) > 100 && below(&above).abs_diff(below(&whole)) * 20 < below(&whole), "{look:?}");
        // From the front half on the inside of the back is seen, as wide as the sphere is.
        let front = drawn(Some(ClipPlane { normal: Vec3::NEG_Y, offset: 0.0 }));
        assert!(!front.is_empty() && front.len() <= whole.len() + whole.len() / 5, "{look:?}");
        assert_eq!(drawn(Some(ClipPlane { normal: Vec3::X, offset: -11.0 })).len(), 0, "{look:?}: all of it");
        assert_eq!(drawn(Some(ClipPlane { normal: Vec3::X, offset: 11.0 })), whole, "{look:?}: none of it");
    }
}

#[test]
fn the_inside_of_an_open_end_is_darker_than_the_outside() {
    let outside = square(20.0, 0.0);
    let inside = TriMesh { triangles: vec![[0, 2, 1], [0, 3, 2]], ..outside.clone() };
    for style in [Style::LIGHT, Style::DARK] {
        let [outside, inside] = [&outside, &inside].map(|mesh| {
            let surface = stage().surface(mesh);
            let camera = in_front_of(mesh, 1.0);
            let picture = stage().picture([51, 51], &camera, &[shown(&surface, Look::Shaded)], &style);
            Colour(picture.pixel(25, 25).unwrap())
        });
        assert!(lumen::render::contrast(outside, inside) > 1.8, "{outside:?} {inside:?}");
    }
}

#[test]
fn flat_shading_gives_each_triangle_one_colour() {
    let mesh = sphere(20.0, 6);
    let surface = stage().surface(&mesh);
    let camera = in_front_of(&mesh, 1.0);
    let colours = |look| {
        let picture = stage().picture([200, 200], &camera, &[shown(&surface, look)], &plain(WHITE));
        picture.rgba.chunks_exact(4).map(<[u8]>::to_vec).collect::<BTreeSet<_>>().len()
    };
    assert!(colours(Look::Flat) * 2 < colours(Look::Shaded));
}

#[test]
fn a_large_surface_is_uploaded_in_parts_and_drawn_flat_once_all_are_there() {
    let mesh = sphere(20.0, 400);
    let (device, queue) = (&stage().device, &stage().queue);
    let mut surface = stage().surface(&mesh);
    let camera = in_front_of(&mesh, 1.0);
    let picture =
        |surface: &GpuSurface, look| stage().picture([200, 200], &camera, &[shown(surface, look)], &plain(WHITE));
    let flat = picture(&surface, Look::Flat);
    let (mut parts, mut from) = (0, Some(0));
    // The buffer that held the normals of the level before is the one that is zero then.
    while let Some(uploaded) = from {
        from = surface.upload_part(device, queue, &mesh, uploaded).unwrap();
        parts += 1;
        if from.is_some() {
            assert!(drawn_pixels(&picture(&surface, Look::Shaded), WHITE).is_empty(), "part {parts}");
        }
    }
    // 12 bytes of each node and each triangle, in parts of 1 MiB.
    let bytes = 12 * (mesh.positions.len() + mesh.triangles.len());
    assert_eq!((parts, bytes.div_ceil(1 << 20)), (11, 11));
    assert_eq!(differing_pixels(&flat, &picture(&surface, Look::Shaded)), 0);
    assert_eq!((surface.node_count(), surface.edge_count()), (mesh.positions.len(), 0));
    let beyond = TriMesh { triangles: vec![[0, 1, mesh.positions.len() as u32]], ..mesh };
    assert!(surface.upload_part(device, queue, &beyond, 0).is_err());
    assert!(drawn_pixels(&picture(&surface, Look::Shaded), WHITE).is_empty());
}

#[test]
fn a_tint_replaces_the_styles_colour() {
    let mesh = square(20.0, 0.0);
    let surface = stage().surface(&mesh);
    let camera = in_front_of(&mesh, 1.0);
    let tinted = Drawable { surface: &surface, look: Look::Shaded, tint: Some(Colour::hex(0x00_00_FF)) };
    let [r, _, b] = stage().picture([51, 51], &camera, &[tinted], &plain(WHITE)).pixel(25, 25).unwrap();
    assert!(b > 150 && r < 40, "{r} {b}");
}

/// What lies before what is a matter of phases and depth, not of the order in which things are given.
#[test]
fn phases_decide_what_is_drawn_first() {
    let mesh = sphere(20.0, 24);
    let surface = stage().surface(&mesh);
    let camera = in_front_of(&mesh, 1.0);
    let shaded = shown(&surface, Look::Shaded);
    let lines = shown(&surface, Look::Wireframe);
    let orders: [[&dyn Draw; 3]; 2] = [[&Backdrop, &shaded, &lines], [&lines, &shaded, &Backdrop]];
    let [forth, back] = orders.map(|things| {
        let target = ViewTarget::new(&stage().device, 128, 128);
        let mut encoder = stage().device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        stage().renderer.draw(&mut encoder, &target, &camera, &things, &Style::LIGHT);
        stage().queue.submit([encoder.finish()]);
        Picture::read_now(&target, &stage().device, &stage().queue).unwrap()
    });
    assert_eq!(differing_pixels(&forth, &back), 0);
}

#[test]
fn two_views_in_one_submission_keep_their_cameras() {
    let mesh = sphere(20.0, 24);
    let surface = stage().surface(&mesh);
    let near = in_front_of(&mesh, 1.0);
    let far = Camera { distance: 3.0 * near.distance, ..near };
    let cameras = [near, far];
    let targets = cameras.map(|_| ViewTarget::new(&stage().device, 128, 128));
    let mut encoder = stage().device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    for (camera, target) in cameras.iter().zip(&targets) {
        let drawables = [shown(&surface, Look::Shaded)];
        stage().renderer.draw(&mut encoder, target, camera, &before_backdrop(&drawables), &plain(WHITE));
    }
    stage().queue.submit([encoder.finish()]);
    for (camera, target) in cameras.iter().zip(&targets) {
        let found = Picture::read_now(target, &stage().device, &stage().queue).unwrap();
        let alone = stage().picture([128, 128], camera, &[shown(&surface, Look::Shaded)], &plain(WHITE));
        assert_eq!(differing_pixels(&found, &alone), 0);
    }
}

#[test]
fn a_target_takes_any_size() {
    let device = &stage().device;
    let mut target = ViewTarget::new(device, 0, 0);
    assert_eq!(target.size(), [1, 1]);
    assert!(target.resize(device, 37, 91), "odd sizes, rows that are not aligned");
    assert!(!target.resize(device, 37, 91));
    assert_eq!((target.size(), target.view().texture().width()), ([37, 91], 37));
    let mesh = sphere(20.0, 24);
    let picture = stage().picture([37, 91], &in_front_of(&mesh, 37.0 / 91.0), &[], &plain(WHITE));
    assert_eq!((picture.width, picture.height, picture.rgba.len()), (37, 91, 37 * 91 * 4));
    assert_eq!((picture.pixel(36, 90), picture.pixel(37, 90)), (Some([255; 3]), None));
    assert!(target.resize(device, u32::MAX, 2));
    assert_eq!(target.size(), [device.limits().max_texture_dimension_2d, 2]);
}

#[test]
fn what_is_empty_draws_the_background_alone() {
    let (device, queue) = (&stage().device, &stage().queue);
    let nothing = stage().surface(&TriMesh::default());
    let mut points = GpuSurface::new(device, queue, &square(20.0, 0.0).positions).unwrap();
    let mut camera = Camera::default();
    camera.fit(&Bounds::EMPTY, 1.0);
    for look in [Look::Shaded, Look::Flat, Look::Wireframe, Look::SeeThrough] {
        let drawables = [shown(&nothing, look), shown(&points, look)];
        let picture = stage().picture([32, 32], &camera, &drawables, &plain(WHITE));
        assert!(drawn_pixels(&picture, WHITE).is_empty(), "{look:?}");
    }
    points.set_level(device, queue, &[], &[], &[Vec3::Y; 4]).unwrap();
    assert_eq!((points.node_count(), points.triangle_count(), points.edge_count()), (4, 0, 0));
}

#[test]
fn what_does_not_fit_together_is_refused_with_its_numbers() {
    let (device, queue) = (&stage().device, &stage().queue);
    let mesh = square(20.0, 0.0);
    let mut surface = stage().surface(&mesh);
    let normals = [Vec3::Y; 4];
    assert_eq!(
        surface.set_level(device, queue, &[[0, 1, 4]], &[], &normals),
        Err(SurfaceError::IndexOutOfRange { index: 4, nodes: 4 })
    );
    assert_eq!(surface.triangle_count(), 0);
    assert_eq!(
        surface.set_level(device, queue, &mesh.triangles, &[[0, 9]], &normals),
        Err(SurfaceError::IndexOutOfRange { index: 9, nodes: 4 })
    );
    assert_eq!(
        surface.set_level(device, queue, &mesh.triangles, &[], &normals[..3]),
        Err(SurfaceError::Count { what: "normals", expected: 4, found: 3 })
    );
    assert_eq!(
        surface.set_scalars(device, queue, Some(&[0.0; 5])),
        Err(SurfaceError::Count { what: "scalars", expected: 4, found: 5 })
    );
}

/// Leaves pictures to look at.
#[test]
fn pictures_of_an_arch() {
    let size = [900, 700];
    let fine = arch(64, 220);
    let coarse = arch(18, 60);
    let mut camera = Camera::default();
    camera.orbit(Vec2::new(0.12, -0.06));
    camera.fit(&fine.bounds(), size[0] as f32 / size[1] as f32);
    for (theme, style) in [("light", Style::LIGHT), ("dark", Style::DARK)] {
        for (density, mesh) in [("fine", &fine), ("coarse", &coarse)] {
            let mut surface = stage().surface(mesh);
            let save = |name: &str, surface: &GpuSurface, looks: &[Look], style: &Style| {
                let drawables: Vec<_> = looks.iter().map(|&look| shown(surface, look)).collect();
                let picture = stage().picture(size, &camera, &drawables, style);
                assert!(picture.rgba.chunks_exact(4).collect::<BTreeSet<_>>().len() > 50);
                write_png(&format!("render-{theme}-{density}-{name}"), &picture);
            };
            save("shaded", &surface, &[Look::Shaded], &style);
            save("flat", &surface, &[Look::Flat], &style);
            save("wireframe", &surface, &[Look::Wireframe], &style);
            save("see-through", &surface, &[Look::SeeThrough], &style);
            save("both", &surface, &[Look::Shaded, Look::Wireframe], &style);
            let scalars: Vec<f32> = mesh.positions.iter().map(|p| p.x.hypot(p.z)).collect();
            surface.set_scalars(&stage().device, &stage().queue, Some(&scalars)).unwrap();
            let map = Some(ColourMap { range: (20.0, 130.0) });
            save("map", &surface, &[Look::Shaded], &Style { map, ..style });
        }
    }
}

fn write_png(name: &str, picture: &Picture) {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name).with_extension("png");
    let file = std::io::BufWriter::new(std::fs::File::create(path).unwrap());
    let mut encoder = png::Encoder::new(file, picture.width, picture.height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().unwrap().write_image_data(&picture.rgba).unwrap();
}
