//! The paper's figures as the command draws them, without a window: sizes, panels, words. Needs a GPU or a software one
//! and fails without.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use lumen::render::Picture;

const WIDTH: u32 = 1200;

fn lumen(arguments: &[&str], backend: Option<&str>) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lumen"));
    if let Some(backend) = backend {
        command.env("WGPU_BACKEND", backend);
    }
    command.args(arguments).output().unwrap()
}

/// A folder of its own for each test; what is drawn stays there to be looked at.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("figures-{name}"));
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// A picture, and the words in its file.
fn read(path: &Path) -> (Picture, Vec<String>) {
    let decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut rgb).unwrap();
    assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
    let words = reader.info().uncompressed_latin1_text.iter().map(|chunk| chunk.text.clone()).collect();
    let rgba = rgb.chunks_exact(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect();
    (Picture { width: info.width, height: info.height, rgba }, words)
}

/// A part of a picture: its corner and size as parts of the whole, 0 to 1.
fn part(picture: &Picture, [x, y]: [f64; 2], [width, height]: [f64; 2]) -> Vec<[u8; 3]> {
    let (w, h) = (f64::from(picture.width), f64::from(picture.height));
    let rows = (y * h) as u32..((y + height) * h) as u32;
    let columns = (x * w) as u32..((x + width) * w) as u32;
    rows.flat_map(|y| columns.clone().map(move |x| (x, y))).map(|(x, y)| picture.pixel(x, y).unwrap()).collect()
}

/// The part of the pixels in which two parts of a picture differ clearly.
fn difference(a: &[[u8; 3]], b: &[[u8; 3]]) -> f64 {
    assert_eq!(a.len(), b.len());
    let differ = |(a, b): &(&[u8; 3], &[u8; 3])| a.iter().zip(b.iter()).any(|(a, b)| a.abs_diff(*b) > 16);
    a.iter().zip(b).filter(differ).count() as f64 / a.len() as f64
}

/// The part of the pixels that are as dark as text.
fn ink(pixels: &[[u8; 3]]) -> f64 {
    pixels.iter().filter(|pixel| pixel.iter().all(|&c| c < 110)).count() as f64 / pixels.len() as f64
}

fn draw(name: &str) -> [Picture; 2] {
    let folder = folder(name);
    let vessel = folder.join("vessel.stl").to_string_lossy().into_owned();
    let out = folder.join("out").to_string_lossy().into_owned();
    assert!(lumen(&["phantom", "aorta", "--triangles", "20000", "-o", &vessel], None).status.success());
    let output = lumen(&["figures", &vessel, "-o", &out, "--width", &WIDTH.to_string()], None);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).contains("Not for clinical decisions."));
    ["figure-6.png", "figure-7.png"].map(|file| {
        let (picture, words) = read(&Path::new(&out).join(file));
        assert!(words.iter().any(|text| text == "Not for clinical decisions."), "{words:?}");
        picture
    })
}

/// Both figures, drawn once for all tests.
fn figures() -> &'static [Picture; 2] {
    static FIGURES: std::sync::OnceLock<[Picture; 2]> = std::sync::OnceLock::new();
    FIGURES.get_or_init(|| draw("first"))
}

#[test]
fn figures_six_and_seven_have_their_panels_and_their_words() {
    let [six, seven] = figures();
    for picture in [six, seven] {
        assert!(picture.width == WIDTH && (WIDTH..3 * WIDTH).contains(&picture.height), "{}", picture.height);
        let margin = part(picture, [0.0, 0.0], [1.0, 0.01]);
        assert!(margin.iter().all(|pixel| *pixel == [255; 3]), "white paper");
        let heading = part(picture, [0.02, 0.01], [0.5, 0.04]);
        assert!(ink(&heading) > 0.01, "a heading is written: {}", ink(&heading));
        let projection = part(picture, [0.02, 0.96], [0.6, 0.03]);
        assert!(ink(&projection) > 0.005, "a foot is written: {}", ink(&projection));
    }
    // The middles of the six panels; none is blank, no two are alike.
    let middle = |picture: &Picture, column: usize, row: usize| {
        part(picture, [0.06 + 0.325 * column as f64, 0.1 + 0.46 * row as f64], [0.2, 0.25])
    };
    let panels: Vec<_> = (0..6).map(|i| middle(six, i % 3, i / 3)).collect();
    for (i, a) in panels.iter().enumerate() {
        let ground = vec![a[0]; a.len()];
        assert!(difference(a, &ground) > 0.1, "panel {i} is blank");
        for (j, b) in panels.iter().enumerate().skip(i + 1) {
            let found = difference(a, b);
            assert!(found > 0.005, "panels {i} and {j} are alike: {found}");
        }
    }
    // Figure 7: three columns, shaded above lines, and the fewer triangles the fewer lines.
    let lines: Vec<f64> = (0..3).map(|column| ink(&middle(seven, column, 1))).collect();
    assert!(lines[0] > 2.0 * lines[1] && lines[1] > 1.5 * lines[2] && lines[2] > 0.001, "{lines:?}");
    let shaded = middle(seven, 0, 0);
    assert!(shaded.iter().any(|[r, _, b]| r.saturating_sub(*b) > 40), "the wall has its colour");
}

#[test]
fn the_same_surface_gives_the_same_picture() {
    assert!(*figures() == draw("again"));
}

#[test]
fn what_is_missing_is_named_in_one_line() {
    let out = folder("none").to_string_lossy().into_owned();
    // A backend that exists in browsers alone.
    let output = lumen(&["figures", "-o", &out], Some("webgpu"));
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(error.starts_with("lumen: there is no graphics device") && error.lines().count() == 1, "{error}");
    for width in ["0", "100000", "wide"] {
        assert_eq!(lumen(&["figures", "-o", &out, "--width", width], None).status.code(), Some(2));
    }
    assert_eq!(lumen(&["figures"], None).status.code(), Some(2), "a folder must be named");
}
