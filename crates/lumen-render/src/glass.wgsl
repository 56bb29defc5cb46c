// The vessel in a trial: translucent from outside, lit by a headlight from inside.

const KEY: vec3<f32> = vec3(-0.42, 0.56, 0.71);
// Opacity of a wall seen head-on and edge-on.
const FACING: f32 = 0.10;
const EDGE: f32 = 0.78;
// The far wall counts for less.
const FAR: f32 = 0.55;
// Opacity where the wire presses.
const PRESSED: f32 = 0.6;
// Distance in mm at which the headlight has half its strength.
const REACH: f32 = 22.0;
// And from which on nothing is lit.
const SEEN: f32 = 130.0;

struct Fragment {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    // In N.
    @location(2) force: f32,
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @location(1) normal: vec3<f32>, @location(2) force: f32) -> Fragment {
    let seen = scene.view * vec4(position, 1.0);
    return Fragment(scene.projection * seen, seen.xyz, (scene.view * vec4(normal, 0.0)).xyz, force);
}

fn facing_normal(in: Fragment, towards_eye: vec3<f32>) -> vec3<f32> {
    let length_2 = dot(in.normal, in.normal);
    let normal = in.normal * inverseSqrt(max(length_2, 1e-12));
    return normal * select(-1.0, 1.0, dot(normal, towards_eye) >= 0.0);
}

fn wall(in: Fragment, matte: vec3<f32>, strength: f32) -> vec4<f32> {
    let towards_eye = normalize(-in.position);
    let normal = facing_normal(in, towards_eye);
    let away = 1.0 - clamp(dot(normal, towards_eye), 0.0, 1.0);
    let light = 0.55 + 0.25 * normal.y + 0.55 * max(dot(normal, KEY), 0.0);
    let t = (in.force - scene.map.x) * scene.map.y;
    let pressed = smoothstep(0.01, 0.10, t);
    let colour = mix(matte * light, decode(map_colour(t)) * mix(0.75, 1.0, light), pressed);
    let opacity = mix(mix(FACING, EDGE, away * away), PRESSED, pressed) * strength;
    return vec4(encode(colour), opacity);
}

@fragment
fn fragment_far(in: Fragment) -> @location(0) vec4<f32> {
    return wall(in, paint.inside.rgb, FAR);
}

@fragment
fn fragment_near(in: Fragment) -> @location(0) vec4<f32> {
    return wall(in, paint.surface.rgb, 1.0);
}

@fragment
fn fragment_inside(in: Fragment) -> @location(0) vec4<f32> {
    let distance = length(in.position);
    let towards_eye = -in.position / distance;
    let normal = facing_normal(in, towards_eye);
    let reach = REACH / (REACH + distance);
    // Half of the cosine: a wet wall scatters light from below its surface.
    let light = (0.30 + 0.70 * clamp(dot(normal, towards_eye), 0.0, 1.0)) * reach * reach * 1.25 * (1.0 - smoothstep(0.3 * SEEN, SEEN, distance));
    return vec4(dither(encode(paint.surface.rgb * light), in.clip.xy), 1.0);
}
