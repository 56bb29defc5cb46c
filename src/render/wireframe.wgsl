// The wireframe: depth of the triangles, then lines.

// How far lines come towards the eye, in pixels' sizes.
const PULL: f32 = 1.0;
// Opacity of hidden lines.
const HIDDEN: f32 = 0.32;

struct Fragment {
    @builtin(position) clip: vec4<f32>,
    // 0 where the surface is seen edge-on, 1 where it faces the eye.
    @location(0) facing: f32,
}

@vertex
fn vertex_fill(@location(0) position: vec3<f32>) -> @builtin(position) vec4<f32> {
    return scene.projection * (scene.view * vec4(position, 1.0));
}

// Writes no colour: its pipeline masks it out.
@fragment
fn fragment_fill() -> @location(0) vec4<f32> {
    return vec4(0.0);
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @location(1) normal: vec3<f32>) -> Fragment {
    let seen = (scene.view * vec4(position, 1.0)).xyz;
    let turned = (scene.view * vec4(normal, 0.0)).xyz;
    let pulled = seen * (1.0 - PULL * scene.pixel);
    let size = sqrt(dot(seen, seen) * dot(turned, turned));
    return Fragment(scene.projection * vec4(pulled, 1.0), abs(dot(seen, turned)) / max(size, 1e-12));
}

fn line_colour(facing: f32) -> vec3<f32> {
    return mix(paint.line.rgb, paint.line_facing.rgb, smoothstep(0.1, 0.9, facing));
}

@fragment
fn fragment(in: Fragment) -> @location(0) vec4<f32> {
    return vec4(line_colour(in.facing), 1.0);
}

@fragment
fn fragment_hidden(in: Fragment) -> @location(0) vec4<f32> {
    return vec4(line_colour(in.facing), HIDDEN);
}
