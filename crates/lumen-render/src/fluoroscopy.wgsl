// The picture of a fluoroscope: Beer and Lambert's law over what the rays go through, with the noise of few photons.

struct Exposure {
    // Of the thickness: value of one step, of one mm, and what both are before anything is drawn.
    unit: vec4<f32>,
    // Seconds since the contrast was given (below 0: none), speed of the blood in vessel lengths a second, attenuation
    // of contrast in 1/mm, strength of the roadmap.
    contrast: vec4<f32>,
    // Number of the pulse, noise where all light comes through, width and height in pixels.
    picture: vec4<f32>,
}

@group(2) @binding(0) var<uniform> exposure: Exposure;
@group(2) @binding(1) var thickness: texture_2d<f32>;
@group(2) @binding(2) var shadow: texture_2d<f32>;

// As in `thickness.wgsl` and `wire.wgsl`.
const STEP: f32 = 8.0;
const MOST_DEPTH: f32 = 4.0;
// Seconds that contrast is given for, and in which what is left halves about once.
const GIVEN: f32 = 1.6;
const WASHOUT: f32 = 1.3;
// Grey of the brightest part, gamma-encoded.
const BRIGHTEST: f32 = 0.80;
// The window: how much steeper grey is than intensity.
const WINDOW: f32 = 2.0;

// PCG of three dimensions (Jarzynski and Olano, "Hash functions for GPU rendering", 2020).
fn hash(seed: vec3<u32>) -> vec3<f32> {
    var v = seed * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return vec3<f32>(v) / 4294967295.0;
}

// The part of the contrast that is at `place` now: it comes with the blood, stays while it is given and fades.
fn bolus(place: f32) -> f32 {
    let passed = exposure.contrast.x - place / exposure.contrast.y;
    let rise = smoothstep(0.0, 0.35, passed);
    let fall = exp(-max(passed - GIVEN, 0.0) / WASHOUT);
    return select(0.0, rise * fall, exposure.contrast.x >= 0.0);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let size = vec2<i32>(exposure.picture.zw);
    // The eye is where the tube is; the picture is looked at from the detector's side.
    let pixel = vec2(size.x - 1 - i32(at.x), i32(at.y));
    let sums = textureLoad(thickness, pixel, 0);
    let unit = exposure.unit;
    // Open walls leave sums that mean nothing.
    let lumen = clamp(STEP * (sums.x - unit.z) / unit.x + (sums.y - unit.w) / unit.y, 0.0, 120.0);
    let place = select(0.0, sums.z / (max(sums.w, 1e-6) * select(60.0, 1.0, unit.x == 1.0)), sums.w > 0.0);
    let depth = exposure.contrast.z * bolus(place) * lumen + MOST_DEPTH * textureLoad(shadow, pixel, 0).x;
    var intensity = exp(-depth);
    // Quanta: the noise of a Poisson variable, by the sum of three even ones.
    let even = hash(vec3(vec2<u32>(pixel), u32(exposure.picture.x)));
    let noise = (even.x + even.y + even.z - 1.5) * 2.0;
    intensity += exposure.picture.y * sqrt(intensity) * noise;
    // A roadmap is what contrast left once, brighter.
    let road = 1.0 - exp(-0.12 * lumen);
    let from_middle = (at.xy / exposure.picture.zw - 0.5) * 2.0;
    let vignette = 1.0 - 0.10 * dot(from_middle, from_middle);
    let grey = BRIGHTEST * pow(max(intensity, 0.0), WINDOW) * vignette + exposure.contrast.w * road * 0.16;
    return vec4(vec3(clamp(grey, 0.0, 1.0)), 1.0);
}
