// The guidewire: a lit tube, and what X-rays leave of it.

// The least radius in pixels.
const LEAST: f32 = 1.6;
// The tip: this much of the end, in mm, is a coil of platinum.
const TIP: f32 = 30.0;
// Towards the key light, as in `shaded.wgsl`.
const KEY: vec3<f32> = vec3(-0.42, 0.56, 0.71);
// Linear.
const TIP_COLOUR: vec3<f32> = vec3(1.0, 0.42, 0.04);
// Attenuation in 1/mm at 60 keV (NIST XCOM: steel 1.2 cm2/g, platinum 3.6 cm2/g, of which a coil fills two fifths).
const STEEL: f32 = 0.95;
const COIL: f32 = 3.1;
// What the largest value of the shadow stands for; as in `fluoroscopy.wgsl`.
const MOST_DEPTH: f32 = 4.0;

struct Fragment {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    // Distance from the tip, and radius, in mm.
    @location(2) measure: vec2<f32>,
    // Radius over the radius that is paint.
    @location(3) share: f32,
}

@vertex
fn vertex(
    @location(0) centre: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) measure: vec2<f32>,
) -> Fragment {
    let middle = (scene.view * vec4(centre, 1.0)).xyz;
    let out = (scene.view * vec4(normal, 0.0)).xyz;
    let radius = max(measure.y, LEAST * scene.pixel * -middle.z);
    let seen = middle + out * radius;
    return Fragment(scene.projection * vec4(seen, 1.0), seen, out, measure, measure.y / radius);
}

@fragment
fn fragment(in: Fragment) -> @location(0) vec4<f32> {
    let towards_eye = normalize(-in.position);
    let normal = normalize(in.normal);
    let is_tip = 1.0 - smoothstep(TIP - 1.0, TIP, in.measure.x);
    let colour = mix(decode(paint.line.rgb), TIP_COLOUR, is_tip);
    let shine = pow(max(dot(normal, normalize(KEY + towards_eye)), 0.0), 24.0);
    let edge = clamp(dot(normal, towards_eye), 0.0, 1.0);
    let lit = colour * (0.35 + 0.75 * max(dot(normal, KEY), 0.0)) * mix(0.45, 1.0, edge) + vec3(0.55 * shine);
    return vec4(dither(encode(lit), in.clip.xy), 1.0);
}

@fragment
fn fragment_shadow(in: Fragment) -> @location(0) vec4<f32> {
    // A chord of the circle, spread over the width that is paint.
    let chord = 2.0 * in.measure.y * in.share * abs(dot(normalize(in.normal), normalize(in.position)));
    let mu = mix(COIL, STEEL, smoothstep(TIP - 1.0, TIP, in.measure.x));
    return vec4(mu * chord / MOST_DEPTH);
}
