// A slice of a scan: a picture in its place.

@group(2) @binding(0) var greys: texture_2d<f32>;
@group(2) @binding(1) var bilinear: sampler;

struct Fragment {
    @builtin(position) clip: vec4<f32>,
    @location(0) at: vec2<f32>,
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @location(1) at: vec2<f32>) -> Fragment {
    return Fragment(scene.projection * scene.view * vec4(position, 1.0), at);
}

@fragment
fn fragment(in: Fragment) -> @location(0) vec4<f32> {
    // As they are written: a window of values is no light.
    return vec4(vec3(textureSample(greys, bilinear, in.at).r), 1.0);
}
