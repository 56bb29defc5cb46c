// How much of each ray lies within a closed surface, in mm: the sum of the distances at which it leaves, less that of
// those at which it enters. Distances are split into steps of `STEP` and the rest, so that sums are exact where the
// target has few digits; blending adds far walls and takes away near ones.

// In mm.
const STEP: f32 = 8.0;
// A target of bytes counts the rest in these parts of a mm, and the place along the vessel in these parts of it.
const FINE: f32 = 4.0;
const PLACES: f32 = 60.0;

struct Fragment {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    // 0 to 1.
    @location(1) place: f32,
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @location(1) place: f32) -> Fragment {
    let seen = scene.view * vec4(position, 1.0);
    return Fragment(scene.projection * seen, seen.xyz, place);
}

// Distance from the near plane's, in steps and the rest.
fn distance_in_steps(position: vec3<f32>) -> vec2<f32> {
    let near = scene.projection[3][2] / (1.0 + scene.projection[2][2]);
    let distance = max(length(position) - near, 0.0);
    let steps = floor(distance / STEP);
    return vec2(steps, distance - STEP * steps);
}

@fragment
fn fragment_far(in: Fragment) -> @location(0) vec4<f32> {
    return vec4(distance_in_steps(in.position), in.place, 1.0);
}

@fragment
fn fragment_near(in: Fragment) -> @location(0) vec4<f32> {
    return vec4(distance_in_steps(in.position), 0.0, 0.0);
}

fn in_bytes(value: vec4<f32>) -> vec4<f32> {
    return round(value * vec4(1.0, FINE, PLACES, 1.0)) / 255.0;
}

@fragment
fn fragment_far_bytes(in: Fragment) -> @location(0) vec4<f32> {
    return in_bytes(vec4(distance_in_steps(in.position), in.place, 1.0));
}

@fragment
fn fragment_near_bytes(in: Fragment) -> @location(0) vec4<f32> {
    return in_bytes(vec4(distance_in_steps(in.position), 0.0, 0.0));
}
