//! The views of a trial against geometry and physics.

use glam::{Quat, Vec3};
use lumen::mesh::{Bounds, TriMesh};
use lumen::render::{
    Backdrop, Body, Camera, Colour, ColourMap, Exposure, Glass, GpuSurface, GpuWire, Picture, Renderer, Style,
    ThicknessFormat, ViewTarget,
};

use crate::shapes::{sphere, together};
use crate::stage::{plain, stage};

const SIZE: [u32; 2] = [240, 240];
/// As in `render/fluoroscopy.rs` and its shader.
const CONTRAST: f32 = 0.06;
const WINDOW: f32 = 2.0;
/// Seconds after which contrast is at its full at the beginning of a vessel.
const FULL_S: f32 = 1.0;

fn body(mesh: &TriMesh) -> GpuSurface {
    let (device, queue) = (&stage().device, &stage().queue);
    let mut surface = stage().surface(mesh);
    surface.set_scalars(device, queue, Some(&vec![0.0; mesh.positions.len()])).unwrap();
    surface
}

fn wire(nodes: &[[f32; 3]], radius: f32) -> GpuWire {
    let mut wire = GpuWire::default();
    wire.set(&stage().device, &stage().queue, nodes, radius).unwrap();
    wire
}

/// A camera 765 mm before the origin that sees 60 mm there.
fn camera(mesh: &TriMesh) -> Camera {
    Camera {
        target: Vec3::ZERO,
        rotation: Quat::IDENTITY,
        distance: 765.0,
        fov_y: 2.0 * (30.0_f32 / 765.0).atan(),
        bounds: Bounds::of(&mesh.positions),
        ..Camera::default()
    }
}

fn fluoroscopy(format: ThicknessFormat, mesh: &TriMesh, wire: &GpuWire, exposure: &Exposure) -> Picture {
    let (device, queue) = (&stage().device, &stage().queue);
    let renderer = Renderer::new(device, queue).with_thickness(format);
    let target = renderer.fluoroscopy_target(SIZE);
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let body = body(mesh);
    renderer.expose(&mut encoder, &target, &camera(mesh), &[&Body(&body), wire], exposure, true);
    queue.submit([encoder.finish()]);
    Picture::read_texture_now(target.picture(), device, queue).unwrap()
}

/// Mean grey of the square of 9 by 9 pixels about (x, y), where noise does not count.
fn grey(picture: &Picture, [x, y]: [u32; 2]) -> f32 {
    let pixels = (y - 4..=y + 4).flat_map(|y| (x - 4..=x + 4).map(move |x| (x, y)));
    pixels.map(|(x, y)| f32::from(picture.pixel(x, y).unwrap()[0])).sum::<f32>() / 81.0
}

/// Attenuation between two pictures of the same place, undoing the window.
fn depth(with: f32, without: f32) -> f32 {
    -(with / without).ln() / WINDOW
}

#[test]
fn contrast_takes_away_what_beer_and_lambert_say_wherever_the_vessel_is() {
    let moved = |mut mesh: TriMesh, by: Vec3| {
        mesh.positions.iter_mut().for_each(|p| *p += by);
        mesh
    };
    let one = moved(sphere(10.0, 80), Vec3::new(0.0, 0.0, 37.0));
    let behind = together(&one, &moved(sphere(6.0, 80), Vec3::new(0.0, 0.0, -90.0)));
    let given = Exposure { contrast_s: Some(FULL_S), flow: 1.0, ..Exposure::default() };
    for format in [ThicknessFormat::Floats, ThicknessFormat::Bytes] {
        for (mesh, thickness) in [(&one, 20.0), (&behind, 32.0)] {
            let wire = GpuWire::default();
            let without = grey(&fluoroscopy(format, mesh, &wire, &Exposure::default()), [120, 120]);
            let with = grey(&fluoroscopy(format, mesh, &wire, &given), [120, 120]);
            let found = depth(with, without);
            let expected = CONTRAST * thickness;
            assert!((found / expected - 1.0).abs() < 0.03, "{format:?}: {found}, not {expected}");
            let beside = fluoroscopy(format, mesh, &wire, &given);
            let open = fluoroscopy(format, mesh, &wire, &Exposure::default());
            let away = depth(grey(&beside, [20, 20]), grey(&open, [20, 20]));
            assert!(away.abs() < 0.01, "{away} where there is no vessel");
        }
    }
}

#[test]
fn contrast_washes_out() {
    let mesh = sphere(10.0, 60);
    let at = |seconds: Option<f32>| {
        let exposure = Exposure { contrast_s: seconds, flow: 1.0, ..Exposure::default() };
        grey(&fluoroscopy(ThicknessFormat::Floats, &mesh, &GpuWire::default(), &exposure), [120, 120])
    };
    let (none, full, later, gone) = (at(None), at(Some(1.0)), at(Some(3.0)), at(Some(11.0)));
    assert!(full < later && later < gone && (gone - none).abs() < 2.0, "{none} {full} {later} {gone}");
}

#[test]
fn the_wire_is_dark_and_its_tip_darker_and_the_same_pulse_gives_the_same_picture() {
    let mesh = sphere(10.0, 40);
    let nodes: Vec<[f32; 3]> = (0..57).map(|i| [28.0 - i as f32, 15.0, 0.0]).collect();
    let wire = wire(&nodes, 0.4);
    let picture = fluoroscopy(ThicknessFormat::Floats, &mesh, &wire, &Exposure::default());
    // The picture is mirrored: the tip, at positive x, is on the left. 4 pixels are a mm.
    let darkest = |x: u32| (50..70).map(|y| picture.pixel(x, y).unwrap()[0]).min().unwrap();
    let row: Vec<u8> = (20..220).map(darkest).collect();
    let mean = |pixels: &[u8]| pixels.iter().map(|&p| f32::from(p)).sum::<f32>() / pixels.len() as f32;
    let ground = grey(&picture, [120, 200]);
    let (tip, shaft) = (mean(&row[..90]), mean(&row[130..]));
    assert!(tip < 0.35 * ground && shaft < 0.7 * ground && shaft > 1.5 * tip, "{ground} {tip} {shaft}");
    let again = fluoroscopy(ThicknessFormat::Floats, &mesh, &wire, &Exposure::default());
    assert_eq!(picture, again);
    let next = fluoroscopy(ThicknessFormat::Floats, &mesh, &wire, &Exposure { pulse: 1, ..Exposure::default() });
    assert_ne!(picture, next, "noise of its own");
}

fn view(vessel: &GpuSurface, wire: &GpuWire, camera: &Camera, style: &Style) -> Picture {
    let (device, queue) = (&stage().device, &stage().queue);
    let target = ViewTarget::new(device, SIZE[0], SIZE[1]);
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    stage().renderer.draw(&mut encoder, &target, camera, &[&Backdrop, wire, &Glass(vessel)], style);
    queue.submit([encoder.finish()]);
    Picture::read_now(&target, device, queue).unwrap()
}

#[test]
fn the_wire_is_seen_through_the_vessel_and_is_never_too_thin() {
    let mesh = sphere(25.0, 60);
    let camera = camera(&mesh);
    let style = plain(Colour::hex(0xFF_FF_FF));
    let nodes: Vec<[f32; 3]> = (0..41).map(|i| [20.0 - i as f32, 0.0, 0.0]).collect();
    let vessel = body(&mesh);
    let empty = view(&vessel, &GpuWire::default(), &camera, &style);
    for radius in [0.01, 2.0] {
        let picture = view(&vessel, &wire(&nodes, radius), &camera, &style);
        let changed = |x: u32| {
            let differs = |y: &u32| {
                let (a, b) = (picture.pixel(x, *y).unwrap(), empty.pixel(x, *y).unwrap());
                a.iter().zip(b).any(|(a, b)| a.abs_diff(b) > 12)
            };
            (0..SIZE[1]).filter(differs).count() as f32
        };
        let width = (60..180).map(changed).sum::<f32>() / 120.0;
        // 4 pixels are a mm, and the least radius is 1.6 pixels.
        let expected = (8.0 * radius).max(3.2);
        assert!((width - expected).abs() < 1.5, "{width} pixels, not {expected}");
    }
}

#[test]
fn the_wall_takes_the_colour_of_the_force() {
    let mesh = sphere(25.0, 60);
    let camera = camera(&mesh);
    let style = Style { map: Some(ColourMap { range: (0.0, 1.0) }), ..plain(Colour::hex(0xFF_FF_FF)) };
    let mut vessel = body(&mesh);
    let calm = view(&vessel, &GpuWire::default(), &camera, &style);
    let forces = vec![1.0; mesh.positions.len()];
    vessel.set_scalars(&stage().device, &stage().queue, Some(&forces)).unwrap();
    let pressed = view(&vessel, &GpuWire::default(), &camera, &style);
    let [before, after] = [&calm, &pressed].map(|picture| picture.pixel(120, 120).unwrap());
    // The last colour of the map is yellow: much green, little blue.
    assert!(after[1] > after[2] + 60 && before[1].abs_diff(before[2]) < 40, "{before:?} {after:?}");
}
