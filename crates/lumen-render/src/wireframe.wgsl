// The wireframe: depth of the triangles, then lines.

// How far lines come towards the eye, in pixels' sizes.
const PULL: f32 = 1.0;
// Opacity of hidden lines.
const HIDDEN: f32 = 0.32;

struct Fragment {
    @builtin(position) clip: vec4<f32>,
    // 0 where the surface is seen edge-on, 1 where it faces the eye.
    @location(0) facing: f32,
    @location(1) @interpolate(perspective, centroid) before: f32,
}

@vertex
fn vertex_fill(@location(0) position: vec3<f32>) -> Fragment {
    let seen = scene.view * vec4(position, 1.0);
    return Fragment(scene.projection * seen, 0.0, before_clip(seen.xyz));
}

// Writes no colour: its pipeline masks it out.
@fragment
fn fragment_fill(in: Fragment) -> @location(0) vec4<f32> {
    if in.before > 0.0 {
        discard;
    }
    return vec4(0.0);
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @location(1) normal: vec3<f32>) -> Fragment {
    let seen = (scene.view * vec4(position, 1.0)).xyz;
    let turned = (scene.view * vec4(normal, 0.0)).xyz;
    let pulled = seen * (1.0 - PULL * scene.pixel);
    let size = sqrt(dot(seen, seen) * dot(turned, turned));
    let facing = abs(dot(seen, turned)) / max(size, 1e-12);
    return Fragment(scene.projection * vec4(pulled, 1.0), facing, before_clip(seen));
}

fn line_colour(facing: f32) -> vec3<f32> {
    return mix(paint.line.rgb, paint.line_facing.rgb, smoothstep(0.1, 0.9, facing));
}

@fragment
fn fragment(in: Fragment) -> @location(0) vec4<f32> {
    if in.before > 0.0 {
        discard;
    }
    return vec4(line_colour(in.facing), 1.0);
}

@fragment
fn fragment_hidden(in: Fragment) -> @location(0) vec4<f32> {
    if in.before > 0.0 {
        discard;
    }
    return vec4(line_colour(in.facing), HIDDEN);
}
