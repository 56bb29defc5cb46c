//! Slices of a scan among surfaces: each value at its place, before or behind what is there.

use glam::Vec3;
use lumen::mesh::Bounds;
use lumen::render::{Camera, Drawable, GpuSlice, Look, Picture, StandardView, Style, ViewTarget};

use crate::pixel_of;
use crate::shapes::sphere;
use crate::stage::{before_backdrop, shown, stage};

const SIZE: [u32; 2] = [240, 200];
/// Greys of 4 x 3 pixels.
const GREYS: [u8; 12] = [10, 60, 120, 200, 250, 30, 90, 160, 0, 255, 70, 140];
/// Around a parallelogram that leans away from the eye.
const CORNERS: [Vec3; 4] = [
    Vec3::new(-30.0, -8.0, 20.0),
    Vec3::new(30.0, 8.0, 24.0),
    Vec3::new(26.0, 12.0, -20.0),
    Vec3::new(-34.0, -4.0, -24.0),
];

/// The middle of pixel (a, b) in mm.
fn place(a: u32, b: u32) -> Vec3 {
    let [first, across, _, down] = CORNERS;
    first + (across - first) * (a as f32 / 3.0) + (down - first) * (b as f32 / 2.0)
}

fn camera() -> Camera {
    let mut camera = Camera::default();
    camera.standard_view(StandardView::Anterior);
    camera.fit(&Bounds::of(&CORNERS), SIZE[0] as f32 / SIZE[1] as f32);
    camera
}

fn picture(drawables: &[Drawable<'_>]) -> Picture {
    let stage = stage();
    let slice = GpuSlice::new(&stage.device, &stage.queue, [4, 3], &GREYS, CORNERS).unwrap();
    let target = ViewTarget::new(&stage.device, SIZE[0], SIZE[1]);
    let mut encoder = stage.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut things = before_backdrop(drawables);
    things.push(&slice);
    stage.renderer.draw(&mut encoder, &target, &camera(), &things, &Style::LIGHT);
    stage.queue.submit([encoder.finish()]);
    Picture::read_now(&target, &stage.device, &stage.queue).unwrap()
}

fn found(picture: &Picture, at: Vec3) -> [u8; 3] {
    let pixel = pixel_of(&camera(), at, SIZE);
    picture.pixel(pixel.x as u32, pixel.y as u32).unwrap()
}

#[test]
fn each_grey_stands_where_its_voxel_lies() {
    let picture = picture(&[]);
    // Those inside, and half way between: what lies in a corner is half of the background.
    for a in 1..3 {
        let grey = GREYS[(4 + a) as usize];
        let [r, g, b] = found(&picture, place(a, 1));
        assert!(r == g && g == b && r.abs_diff(grey) <= 6, "{a}: {r} {g} {b}, not {grey}");
    }
    let between = (place(1, 1) + place(2, 1)) / 2.0;
    assert!(found(&picture, between)[0].abs_diff(60) <= 6, "{:?}", found(&picture, between));
}

#[test]
fn what_is_before_it_hides_it_and_what_is_behind_is_hidden() {
    let mesh = sphere(6.0, 24);
    let moved = |by: Vec3| {
        let mut mesh = mesh.clone();
        mesh.positions.iter_mut().for_each(|p| *p += by);
        mesh
    };
    let middle = place(1, 1);
    // The eye is at -y.
    for (by, is_hidden) in [(Vec3::NEG_Y * 8.0, false), (Vec3::Y * 8.0, true)] {
        let surface = stage().surface(&moved(middle + by));
        let [r, g, b] = found(&picture(&[shown(&surface, Look::Shaded)]), middle);
        assert_eq!(r == g && g == b, is_hidden, "{r} {g} {b}");
    }
}

#[test]
fn a_picture_without_its_greys_is_refused() {
    let stage = stage();
    for (size, greys) in [([4, 3], 11), ([0, 3], 0)] {
        assert!(GpuSlice::new(&stage.device, &stage.queue, size, &GREYS[..greys], CORNERS).is_err());
    }
}
