// The background.

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    // Mixed as encoded values, whose steps look even.
    let colour = mix(scene.background_top.rgb, scene.background_bottom.rgb, at.y / scene.height);
    return vec4(dither(colour, at.xy), 1.0);
}
