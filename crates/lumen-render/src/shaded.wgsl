// The shaded vessel. All directions are in camera coordinates, so the lights go with the camera.

// Towards the key light: over the left shoulder.
const KEY: vec3<f32> = vec3(-0.42, 0.56, 0.71);
const KEY_LIGHT: vec3<f32> = vec3(0.82, 0.80, 0.77);
const SKY: vec3<f32> = vec3(0.42, 0.44, 0.48);
const GROUND: vec3<f32> = vec3(0.15, 0.13, 0.12);
// Towards the raking light: from the left, nearly along the surface that faces the eye.
const RAKING: vec3<f32> = vec3(-0.94, 0.28, 0.20);
const RAKING_LIGHT: vec3<f32> = vec3(1.25, 1.22, 1.18);
const RAKING_SHADE: f32 = 0.35;
// How much of the rim's colour shows where the surface is seen edge-on.
const RIM: f32 = 0.8;

struct Fragment {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) scalar: f32,
    // The scalar of one of the triangle's corners: between two labels there is none.
    @location(3) @interpolate(flat, either) label: f32,
    // The colours of the corners' labels, linear: blended where labels are the vertices' own.
    @location(4) tone: vec3<f32>,
    @location(5) @interpolate(perspective, centroid) before: f32,
}

fn project(position: vec3<f32>, normal: vec3<f32>, scalar: f32) -> Fragment {
    let seen = scene.view * vec4(position, 1.0);
    let turned = (scene.view * vec4(normal, 0.0)).xyz;
    return Fragment(scene.projection * seen, seen.xyz, turned, scalar, scalar, vec3(0.0), before_clip(seen.xyz));
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @location(1) normal: vec3<f32>) -> Fragment {
    return project(position, normal, 0.0);
}

@vertex
fn vertex_mapped(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) scalar: f32,
) -> Fragment {
    var mapped = project(position, normal, scalar);
    mapped.tone = decode(label_colour(scalar));
    return mapped;
}

// The normal on the eye's side: of the triangle itself for flat shading, and where the vertices have none.
fn facing_normal(in: Fragment, towards_eye: vec3<f32>, front: bool) -> vec3<f32> {
    let across = cross(dpdx(in.position), dpdy(in.position));
    let flat_normal = normalize(across) * select(-1.0, 1.0, dot(across, towards_eye) >= 0.0);
    let smooth_normal = in.normal * select(-1.0, 1.0, front);
    let length_2 = dot(smooth_normal, smooth_normal);
    let flat_wins = paint.shading.x > 0.5 || length_2 < 1e-12;
    return select(smooth_normal * inverseSqrt(max(length_2, 1e-12)), flat_normal, flat_wins);
}

fn light(normal: vec3<f32>) -> vec3<f32> {
    let dome = mix(GROUND, SKY, 0.5 * normal.y + 0.5);
    let even = dome + KEY_LIGHT * max(dot(normal, KEY), 0.0);
    let raking = RAKING_SHADE * dome + RAKING_LIGHT * max(dot(normal, RAKING), 0.0);
    return select(even, raking, scene.light.x > 0.5);
}

// Schlick's (1 - cos)^5 softened, so that the rim is wide enough to shape a thin branch.
fn rim(normal: vec3<f32>, towards_eye: vec3<f32>) -> f32 {
    let away = 1.0 - clamp(dot(normal, towards_eye), 0.0, 1.0);
    return RIM * away * away * away;
}

@fragment
fn fragment(in: Fragment, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let towards_eye = normalize(-in.position);
    let normal = facing_normal(in, towards_eye, front);
    // After the derivatives, which need their neighbours.
    if in.before > 0.0 {
        discard;
    }
    let lit = light(normal);
    let outside = mix(paint.surface.rgb * lit, paint.rim.rgb, rim(normal, towards_eye));
    let colour = select(paint.inside.rgb * lit, outside, front);
    return vec4(dither(encode(colour), in.clip.xy), 1.0);
}

// What is more is no number: `ColourMap::UNKNOWN`.
const UNKNOWN: f32 = 1e6;

// Under a colour map the light is nearly even and white: enough for form, too little to be read as another value.
@fragment
fn fragment_mapped(in: Fragment, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let towards_eye = normalize(-in.position);
    let normal = facing_normal(in, towards_eye, front);
    // After the derivatives, which need their neighbours.
    if in.before > 0.0 {
        discard;
    }
    let even = map_colour((in.scalar - scene.map.x) * scene.map.y);
    let flat_or_even = decode(select(even, label_colour(in.label), scene.map.y < 0.0));
    let mapped = select(flat_or_even, in.tone, scene.map.y < 0.0 && scene.map.x > 0.5);
    let colour = select(mapped, paint.unknown.rgb, in.scalar > UNKNOWN);
    let facing = clamp(dot(normal, towards_eye), 0.0, 1.0);
    let shade = mix(0.55, 1.0, facing) * select(0.6, 1.0, front);
    return vec4(dither(encode(colour * shade), in.clip.xy), 1.0);
}
