// Ambient occlusion: depth at half the size, how open each place of it is to its surroundings, and the picture darkened
// by that.

// Depth, and openness where it is known.
@group(2) @binding(0) var depths: texture_2d<f32>;
@group(2) @binding(1) var openness: texture_2d<f32>;
// OpenGL ES gives 0 for a depth that is read without one.
@group(2) @binding(2) var nearest: sampler;

const TAU: f32 = 6.2831853;
// Vogel's spiral fills a disc evenly.
const GOLDEN: f32 = 2.3999632;
const SAMPLES: i32 = 12;
// How dark what is closed gets, and the darkest there is.
const STRENGTH: f32 = 4.0;
const DARKEST: f32 = 0.25;
// The sine of the angle that what rises above the tangent plane by less than is flat: facets of a smooth wall.
const BIAS: f32 = 0.1;
// The largest disc that is looked at, as a part of the view's height.
const WIDEST: f32 = 0.08;

struct Solid {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) before: f32,
}

@vertex
fn vertex_depth(@location(0) position: vec3<f32>) -> Solid {
    let seen = scene.view * vec4(position, 1.0);
    return Solid(scene.projection * seen, before_clip(seen.xyz));
}

@fragment
fn fragment_depth(in: Solid) {
    if in.before > 0.0 {
        discard;
    }
}

// 0, the far plane, where nothing is drawn.
fn depth_at(pixel: vec2<i32>) -> f32 {
    let size = vec2<i32>(textureDimensions(depths));
    if pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y {
        return 0.0;
    }
    return textureSampleLevel(depths, nearest, (vec2<f32>(pixel) + 0.5) / vec2<f32>(size), 0.0).r;
}

// How far from the eye a depth is, along the view, in mm.
fn distance_of(depth: f32) -> f32 {
    return scene.projection[3].z / (depth + scene.projection[2].z);
}

// What is seen at a pixel, in camera coordinates.
fn place(pixel: vec2<i32>) -> vec3<f32> {
    let size = vec2<f32>(textureDimensions(depths));
    let at = (vec2<f32>(pixel) + 0.5) / size * 2.0 - 1.0;
    let ray = vec3(at.x / scene.projection[0].x, -at.y / scene.projection[1].y, -1.0);
    return ray * distance_of(depth_at(pixel));
}

// Of the ways to two neighbours that which stays on the same surface.
fn flatter(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    return select(a, b, abs(b.z) < abs(a.z));
}

@fragment
fn fragment_gather(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(at.xy);
    if depth_at(pixel) <= 0.0 {
        return vec4(1.0);
    }
    let here = place(pixel);
    let right = flatter(place(pixel + vec2<i32>(1, 0)) - here, here - place(pixel - vec2<i32>(1, 0)));
    let up = flatter(place(pixel - vec2<i32>(0, 1)) - here, here - place(pixel + vec2<i32>(0, 1)));
    let normal = normalize(cross(right, up));
    // Of the view at this distance, in mm.
    let height = -here.z * scene.pixel * scene.height;
    let reach = max(min(scene.light.y, WIDEST * height), 1e-6);
    let pixels = reach / height * f32(textureDimensions(depths).y);
    // Sixteen turns of the spiral in squares of four by four, which are averaged in the end.
    let turn = TAU / 16.0 * f32((pixel.x & 3) + 4 * (pixel.y & 3));
    var closed = 0.0;
    for (var i = 0; i < SAMPLES; i++) {
        let angle = turn + GOLDEN * f32(i);
        let offset = pixels * sqrt((f32(i) + 0.5) / f32(SAMPLES)) * vec2(cos(angle), sin(angle));
        let way = place(vec2<i32>(floor(at.xy + offset))) - here;
        let distance_2 = dot(way, way);
        let rise = dot(way, normal) * inverseSqrt(max(distance_2, 1e-12));
        closed += max(rise - BIAS, 0.0) * max(1.0 - distance_2 / (reach * reach), 0.0);
    }
    return vec4(clamp(1.0 - STRENGTH * closed / f32(SAMPLES), DARKEST, 1.0));
}

@fragment
fn fragment_shade(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let width = scene.height * scene.projection[1].y / scene.projection[0].x;
    let here = at.xy * vec2<f32>(textureDimensions(depths)) / vec2(width, scene.height);
    let depth_here = depth_at(vec2<i32>(floor(here)));
    let first = vec2<i32>(floor(here - 1.5));
    // Over the square of four by four around it, as far as that is of the same surface.
    var sum = vec2<f32>(0.0, 0.0);
    for (var i = 0; i < 16; i++) {
        let pixel = first + vec2<i32>(i & 3, i >> 2u);
        let depth = depth_at(pixel);
        let apart = abs(distance_of(depth) - distance_of(depth_here));
        if depth > 0.0 && (depth_here <= 0.0 || apart < scene.light.y) {
            sum += vec2(textureLoad(openness, pixel, 0).r, 1.0);
        }
    }
    let open = select(1.0, sum.x / max(sum.y, 1.0), sum.y > 0.0);
    // What it is multiplied with is gamma-encoded.
    return vec4(vec3(pow(open, 1.0 / 2.2)), 1.0);
}
