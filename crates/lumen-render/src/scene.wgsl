// What every shader of this folder knows; the other side is `scene.rs`.

struct Scene {
    // World to camera: mm, x right, y up, z towards the eye.
    view: mat4x4<f32>,
    // Camera to clip; depth is 1 at the near plane and 0 at the far plane.
    projection: mat4x4<f32>,
    // Gamma-encoded.
    background_top: vec4<f32>,
    background_bottom: vec4<f32>,
    // The scalar of the colour map's first colour, one over the width of its range; that is negative for labels,
    // of which the first is 1 where they are the vertices' own.
    map: vec2<f32>,
    // Height of a pixel at distance 1.
    pixel: f32,
    // Height of the view in pixels.
    height: f32,
    // 1 for raking light, how far ambient occlusion reaches in mm.
    light: vec4<f32>,
    // A plane in camera coordinates: what lies before it is left out.
    clip: vec4<f32>,
    // First the row of the colour map's texture.
    row: vec4<f32>,
}

struct Paint {
    // Linear.
    surface: vec4<f32>,
    inside: vec4<f32>,
    rim: vec4<f32>,
    // Of what has no number under a map.
    unknown: vec4<f32>,
    // Gamma-encoded.
    line: vec4<f32>,
    line_facing: vec4<f32>,
    // 1 for flat shading.
    shading: vec4<f32>,
}

@group(0) @binding(0) var<uniform> scene: Scene;
@group(0) @binding(1) var viridis: texture_2d<f32>;
@group(1) @binding(0) var<uniform> paint: Paint;

// One triangle that covers the view, at the far plane.
@vertex
fn vertex_everywhere(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let corner = vec2(f32(index & 1u), f32(index >> 1u));
    return vec4(4.0 * corner - 1.0, 0.0, 1.0);
}

// How far a place in camera coordinates lies before the plane: what lies before it at all is left out. Where a triangle
// is seen edge-on it has to be taken within the triangle (centroid): beside it, it is far off.
fn before_clip(position: vec3<f32>) -> f32 {
    return dot(scene.clip.xyz, position) + scene.clip.w;
}

// IEC 61966-2-1.
fn encode(linear: vec3<f32>) -> vec3<f32> {
    let clamped = clamp(linear, vec3(0.0), vec3(1.0));
    let high = 1.055 * pow(clamped, vec3(1.0 / 2.4)) - 0.055;
    return select(high, 12.92 * clamped, clamped <= vec3(0.0031308));
}

fn decode(encoded: vec3<f32>) -> vec3<f32> {
    let high = pow((encoded + 0.055) / 1.055, vec3(2.4));
    return select(high, encoded / 12.92, encoded <= vec3(0.04045));
}

// Spreads the rounding to eight bits over neighbouring pixels, so that slow gradients show no bands: interleaved
// gradient noise (Jimenez, "Next generation post processing in Call of Duty", 2014), of less than one step, so that
// an even colour stays even.
fn dither(encoded: vec3<f32>, pixel: vec2<f32>) -> vec3<f32> {
    let noise = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
    return encoded + (noise - 0.5) * 0.95 / 255.0;
}

// The colour at `t`, 0 to 1, between the two nearest of the table: as `viridis` in `colour_map.rs`.
fn map_colour(t: f32) -> vec3<f32> {
    let at = clamp(t, 0.0, 1.0) * 255.0;
    let i = min(i32(at), 254);
    let row = i32(scene.row.x);
    let low = textureLoad(viridis, vec2(i, row), 0).rgb;
    let high = textureLoad(viridis, vec2(i + 1, row), 0).rgb;
    return mix(low, high, at - f32(i));
}

// The colour of a label by its number: as `label_colour` in `colour_map.rs`.
fn label_colour(number: f32) -> vec3<f32> {
    return textureLoad(viridis, vec2(i32(round(number)) & 255, 1), 0).rgb;
}
