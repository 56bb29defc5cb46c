//! What goes wrong with a device is told, not a panic: each test has a device of its own to break.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use lumen::render::{
    Backdrop, Camera, DeviceHealth, Drawable, Fault, GpuSurface, Look, Renderer, Style, SurfaceError, ViewTarget,
    device_descriptor,
};

use crate::shapes::sphere;
use crate::stage::{adapter, in_front_of};

struct Broken {
    device: wgpu::Device,
    queue: wgpu::Queue,
    health: DeviceHealth,
    woken: Arc<AtomicUsize>,
}

fn open(descriptor: &wgpu::DeviceDescriptor<'_>) -> Broken {
    let adapter = pollster::block_on(adapter());
    let (device, queue) = pollster::block_on(adapter.request_device(descriptor)).unwrap();
    let woken = Arc::new(AtomicUsize::new(0));
    let count = Arc::clone(&woken);
    let health = DeviceHealth::watch(&device, move || {
        count.fetch_add(1, Ordering::Relaxed);
    });
    Broken { device, queue, health, woken }
}

#[test]
fn a_call_that_is_refused_is_told() {
    let broken = open(&wgpu::DeviceDescriptor::default());
    let size = broken.device.limits().max_buffer_size + 4;
    let _ = broken.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("too large"),
        size,
        usage: wgpu::BufferUsages::VERTEX,
        mapped_at_creation: false,
    });
    assert!(matches!(broken.health.end(), Some(Fault::Refused(why)) if why.contains("too large")));
    assert_eq!(broken.woken.load(Ordering::Relaxed), 1);
}

/// What a frame does on the way to the moment in which the app hears of the loss.
#[test]
fn drawing_on_a_device_that_is_gone_does_no_harm() {
    let Broken { device, queue, health, woken } = open(&wgpu::DeviceDescriptor::default());
    let mesh = sphere(20.0, 24);
    let renderer = Renderer::new(&device, &queue);
    let mut surface = GpuSurface::new(&device, &queue, &mesh.positions).unwrap();
    let mut target = ViewTarget::new(&device, 64, 64);
    device.destroy();
    // Where it can, the device says so once it has come to rest.
    let _ = device.poll(wgpu::PollType::wait_indefinitely());
    assert!(matches!(health.end(), Some(Fault::Lost(_))), "{:?}", health.end());
    assert!(woken.load(Ordering::Relaxed) > 0);

    let normals = vec![glam::Vec3::Z; mesh.positions.len()];
    surface.set_level(&device, &queue, &mesh.triangles, &[], &normals).unwrap();
    target.resize(&device, 128, 128);
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let camera: Camera = in_front_of(&mesh, 1.0);
    let shown = Drawable { surface: &surface, look: Look::Shaded, tint: None };
    renderer.draw(&mut encoder, &target, &camera, &[&Backdrop, &shown], &Style::LIGHT);
    queue.submit([encoder.finish()]);
    assert!(matches!(health.end(), Some(Fault::Lost(_))), "what follows is no cause: {:?}", health.end());
}

#[test]
fn a_device_has_the_buffers_of_its_adapter() {
    let adapter = pollster::block_on(adapter());
    let broken = open(&device_descriptor(&adapter));
    let (has, can) = (broken.device.limits(), adapter.limits());
    assert_eq!(has.max_buffer_size, can.max_buffer_size);
    assert_eq!(has.max_texture_dimension_2d, can.max_texture_dimension_2d);
    assert_eq!(broken.health.end(), None);
}

#[test]
fn a_surface_that_needs_a_larger_buffer_is_refused_in_one_sentence() {
    let limits = wgpu::Limits { max_buffer_size: 1 << 16, ..wgpu::Limits::downlevel_webgl2_defaults() };
    let broken = open(&wgpu::DeviceDescriptor { required_limits: limits, ..Default::default() });
    let nodes = vec![glam::Vec3::ZERO; 10_000];
    let refused = GpuSurface::new(&broken.device, &broken.queue, &nodes).unwrap_err();
    let expected = SurfaceError::TooLarge { what: "positions", bytes: 120_000, limit: 1 << 16 };
    assert_eq!(refused, expected);
    let sentence = refused.to_string();
    assert!(sentence.contains("0.1 MB") && !sentence.contains('\n'), "{sentence}");
    assert_eq!(broken.health.end(), None, "the device was not even asked");
}
