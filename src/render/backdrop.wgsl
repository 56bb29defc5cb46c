// The background: one triangle that covers the view.

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let corner = vec2(f32(index & 1u), f32(index >> 1u));
    return vec4(4.0 * corner - 1.0, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    // Mixed as encoded values, whose steps look even.
    let colour = mix(scene.background_top.rgb, scene.background_bottom.rgb, at.y / scene.height);
    return vec4(dither(colour, at.xy), 1.0);
}
