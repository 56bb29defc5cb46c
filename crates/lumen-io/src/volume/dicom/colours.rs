//! Colours of segments: CIE L*a*b* of the white D50 in 16 bits each (DICOM PS3.3, C.10.7.1.1), as sRGB (IEC 61966-2-1).
//!
//! Colours that no screen has are cut off at 0 and at 255.

/// Parts of L* from 0 to 100, and of a* and b* from -128 to 127.
pub(super) fn of_lab(stored: [u16; 3]) -> [u8; 3] {
    const WHITE: [f64; 3] = [0.96422, 1.0, 0.82521];
    /// From XYZ of the white D50 to linear sRGB, whose white is D65 (Bradford).
    const TO_RGB: [[f64; 3]; 3] =
        [[3.1338561, -1.6168667, -0.4906146], [-0.9787684, 1.9161415, 0.0334540], [0.0719453, -0.2289914, 1.4052427]];
    let [l, a, b] = stored.map(|part| f64::from(part) / f64::from(u16::MAX));
    let (l, a, b) = (100.0 * l, 255.0 * a - 128.0, 255.0 * b - 128.0);
    let y = (l + 16.0) / 116.0;
    let part = |t: f64| if t > 6.0 / 29.0 { t * t * t } else { 108.0 / 841.0 * (t - 4.0 / 29.0) };
    let [x, y, z] = [part(y + a / 500.0), part(y), part(y - b / 200.0)];
    let xyz = [x * WHITE[0], y * WHITE[1], z * WHITE[2]];
    TO_RGB.map(|row| {
        let linear = row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2];
        let value = if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 };
        (255.0 * value).round() as u8
    })
}
