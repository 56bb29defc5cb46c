//! Reports, pictures and turntables from the menu, as others read them.

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::{LumenApp, PlatformEvent};
use lumen::pipeline::settings::{Settings, Target};
use lumen::sharing::{SharedSettings, write_settings};
use lumen_ui_tests::{
    DESKTOP, Kept, Memory, PHONE, app_at, app_in_full, offered, open, page, says, seen, settle, settle_wholly, tube,
};

type Shared = std::rc::Rc<std::cell::RefCell<Memory>>;

fn opened(size: [f32; 2]) -> (Harness<'static, LumenApp>, Shared) {
    let (mut harness, memory) = app_in_full(size);
    settle_wholly(&mut harness);
    (harness, memory)
}

fn menu(harness: &mut Harness<'_, LumenApp>) {
    harness.get_by_role_and_label(Role::Button, "Save").click();
    harness.run_steps(3);
}

fn click(harness: &mut Harness<'_, LumenApp>, label: &str) {
    harness.get_by_label(label).click();
    harness.run_steps(3);
}

/// Asks for a report in the menu of what can be saved: on a phone it has a menu of its own.
fn report(harness: &mut Harness<'_, LumenApp>, size: [f32; 2]) {
    if size == PHONE {
        click(harness, "For the record");
    }
    click(harness, "Report...");
}

fn info(bytes: &[u8]) -> png::Reader<std::io::Cursor<&[u8]>> {
    png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap()
}

#[test]
fn the_menu_repeats_the_verdict_and_gives_a_report_in_both_forms() {
    for size in [DESKTOP, PHONE] {
        let (mut harness, memory) = seen(|| opened(size));
        menu(&mut harness);
        assert!(says(&harness, "Safe to simulate on: ") && says(&harness, " keep their calibre to 2 %"));
        report(&mut harness, size);
        click(&mut harness, "Save as PDF...");
        let (name, pdf) = offered(&mut harness, &memory);
        assert_eq!(name, "abdominal-aorta-report.pdf");
        let count = |mark: &[u8]| pdf.windows(mark.len()).filter(|part| *part == mark).count();
        assert!(pdf.starts_with(b"%PDF-1.7") && count(b"/Predictor 15") == 4);
        menu(&mut harness);
        report(&mut harness, size);
        click(&mut harness, "Save as web page...");
        let (name, page) = offered(&mut harness, &memory);
        assert_eq!(name, "abdominal-aorta-report.html");
        let page = String::from_utf8(page).unwrap();
        assert!(page.contains("Not for clinical decisions") && page.contains("Safe to simulate on"));
        assert!(page.contains("<td>Date</td><td>2026-11-26</td>") && !page.contains("<td>Case</td>"));
        assert_eq!(page.matches("data:image/png;base64,").count(), 4);
        assert!(!["<script", "http:", "https:", "url("].iter().any(|foreign| page.contains(foreign)));
        assert!(!page.contains("Abdominal aorta"), "no name that nobody asked for");
    }
}

fn write(harness: &mut Harness<'_, LumenApp>, role: Role, field: &str, text: &str) {
    harness.get_by_role_and_label(role, field).focus();
    harness.run_steps(2);
    harness.get_by_role_and_label(role, field).type_text(text);
    harness.run_steps(3);
}

fn said(harness: &Harness<'_, LumenApp>) -> [String; 2] {
    [(Role::TextInput, "Case"), (Role::MultilineTextInput, "Comment")]
        .map(|(role, field)| harness.get_by_role_and_label(role, field).value().unwrap_or_default())
}

#[test]
fn case_and_comment_stand_in_the_report_alone_until_another_surface_is_opened() {
    let (mut harness, memory) = page(PHONE, Kept::default());
    settle_wholly(&mut harness);
    menu(&mut harness);
    report(&mut harness, PHONE);
    write(&mut harness, Role::TextInput, "Case", "Case <12> & co");
    write(&mut harness, Role::MultilineTextInput, "Comment", "Stent planned.\nBring \"B\".");
    click(&mut harness, "Save as web page...");
    assert!(!says(&harness, "Comment"), "the sheet is closed");
    let (_, page) = offered(&mut harness, &memory);
    let page = String::from_utf8(page).unwrap();
    for row in ["<td>Case &lt;12&gt; &amp; co</td>", "<td>Stent planned.\nBring &quot;B&quot;.</td>"] {
        assert!(page.contains(row), "{row} in {page}");
    }
    // It can be written again, but nothing else has it.
    menu(&mut harness);
    click(&mut harness, "For the record");
    click(&mut harness, "Settings...");
    let (_, settings) = offered(&mut harness, &memory);
    harness.run_steps(12);
    let kept = memory.borrow().kept.clone().unwrap().text.unwrap();
    for text in [String::from_utf8(settings).unwrap(), kept] {
        assert!(!["Case", "Stent"].iter().any(|said| text.contains(said)), "{text}");
    }
    menu(&mut harness);
    report(&mut harness, PHONE);
    assert_eq!(said(&harness), ["Case <12> & co", "Stent planned.\nBring \"B\"."]);
    click(&mut harness, "Close");
    open(&mut harness, &memory, "other.obj", tube(5.0, 60.0, 1.0));
    menu(&mut harness);
    report(&mut harness, PHONE);
    assert_eq!(said(&harness), ["", ""]);
    // Undo in the field brings back nothing of the surface before.
    harness.get_by_role_and_label(Role::MultilineTextInput, "Comment").focus();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!(said(&harness), ["", ""]);
}

#[test]
fn a_picture_is_as_large_as_asked_and_can_have_nothing_behind_it() {
    let (mut harness, memory) = seen(|| opened(DESKTOP));
    menu(&mut harness);
    click(&mut harness, "Picture (PNG)");
    click(&mut harness, "1920 pixels...");
    let (name, bytes) = offered(&mut harness, &memory);
    assert_eq!(name, "abdominal-aorta.png");
    let found = info(&bytes);
    assert_eq!(found.info().width.max(found.info().height), 1920);
    assert_eq!(found.info().color_type, png::ColorType::Rgb);
    menu(&mut harness);
    click(&mut harness, "Picture (PNG)");
    click(&mut harness, "Transparent background");
    menu_again(&mut harness);
    click(&mut harness, "960 pixels...");
    let (_, bytes) = offered(&mut harness, &memory);
    let mut found = info(&bytes);
    assert_eq!(found.info().color_type, png::ColorType::Rgba);
    let mut pixels = vec![0; found.output_buffer_size().unwrap()];
    found.next_frame(&mut pixels).unwrap();
    let (width, height) = (found.info().width as usize, found.info().height as usize);
    let alpha = |x: usize, y: usize| pixels[4 * (y * width + x) + 3];
    assert_eq!([alpha(0, 0), alpha(width - 1, height - 1)], [0, 0], "nothing in the corners");
    // The scale stands below on the left, that it is not for clinical decisions on the right, the axes above that.
    let ink = |x: std::ops::Range<usize>, y: std::ops::Range<usize>| {
        y.flat_map(|y| x.clone().map(move |x| (x, y))).filter(|&(x, y)| alpha(x, y) > 128).count()
    };
    let (right, foot) = (width - 12, height - 12);
    assert!(ink(12..60, foot - 12..foot) >= 48, "the bar's line is there");
    assert!(ink(right - 150..right, foot - 14..foot) > 200 && ink(right - 70..right, 12..82) > 60);
    let whole = pixels.chunks_exact(4).filter(|pixel| pixel[3] == 255).count();
    assert!(whole * 50 > width * height, "{whole} pixels are wholly surface");
}

/// Opens the menu of pictures where a choice has closed it.
fn menu_again(harness: &mut Harness<'_, LumenApp>) {
    if harness.query_by_label("960 pixels...").is_none() {
        menu(harness);
        click(harness, "Picture (PNG)");
    }
}

#[test]
fn a_turntable_turns_once_and_can_be_cancelled() {
    let (mut harness, memory) = seen(|| opened(DESKTOP));
    menu(&mut harness);
    click(&mut harness, "Turntable (APNG)...");
    assert!(says(&harness, "Turntable"));
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(says(&harness, "Cancelled."));
    harness.run_steps(60);
    assert!(memory.borrow().offered.is_empty());
    menu(&mut harness);
    click(&mut harness, "Turntable (APNG)...");
    let (name, bytes) = offered(&mut harness, &memory);
    assert_eq!(name, "abdominal-aorta-turntable.png");
    let mut found = info(&bytes);
    assert_eq!(found.info().animation_control().unwrap().num_frames, 48);
    let mut frames = Vec::new();
    for _ in 0..48 {
        let mut pixels = vec![0; found.output_buffer_size().unwrap()];
        found.next_frame(&mut pixels).unwrap();
        frames.push(pixels);
    }
    assert!(frames[0] != frames[12] && frames[12] != frames[24] && frames[24] != frames[36]);
    assert!(bytes.len() < 8_000_000, "{} bytes", bytes.len());
    println!("the turntable takes {} bytes", bytes.len());
    // The same frames as a video, where the platform can make one.
    menu(&mut harness);
    assert!(harness.query_by_label("Turntable as video (WebM)...").is_none());
    memory.borrow_mut().has_video = true;
    harness.run_steps(3);
    click(&mut harness, "Turntable as video (WebM)...");
    let (name, pause_ms) = offered(&mut harness, &memory);
    assert_eq!((name.as_str(), &pause_ms[..]), ("abdominal-aorta-turntable.webm", &b"80"[..]));
    let video = &memory.borrow().video;
    let [width, height] = [found.info().width, found.info().height];
    assert!(video.len() == 48 && video.iter().all(|frame| (frame.0, frame.1) == (width, height)));
    let of_video = |i: usize| video[i].2.as_chunks::<4>().0.iter().flat_map(|pixel| &pixel[..3]).copied();
    assert!([0, 12, 24, 36].into_iter().all(|i| of_video(i).eq(frames[i].iter().copied())));
}

#[test]
fn the_reduction_is_played_there_and_back_and_saved_as_a_moving_picture() {
    let (mut harness, memory) = seen(|| app_at(DESKTOP, 0.05));
    settle_wholly(&mut harness);
    let state = |harness: &Harness<'_, LumenApp>| {
        let document = harness.state().state().document.as_ref().unwrap();
        (document.shown.as_ref().unwrap().level.triangles.len(), document.levels.as_ref().unwrap().1.triangles.len())
    };
    let before = (harness.state().state().settings.clone(), state(&harness).0);
    click(&mut harness, "Learn");
    harness.get_by_role_and_label(Role::CheckBox, "Play the reduction").click();
    harness.run_steps(2);
    // It begins with all triangles: 12 s there and back, a frame every twentieth.
    let mut seen = Vec::new();
    for _frame in 0..244 {
        harness.step();
        seen.push(state(&harness).0);
    }
    let (_, all) = state(&harness);
    let fewest = *seen.iter().min().unwrap();
    assert!(seen.iter().max().unwrap() * 20 > all * 19, "{} of {all}", seen.iter().max().unwrap());
    let turn = seen.iter().position(|&count| count == fewest).unwrap();
    assert!(seen[..turn].is_sorted_by(|a, b| a >= b) && seen[turn..230].is_sorted(), "there, and back");
    assert!((100..=145).contains(&turn), "in the middle: {turn}");
    // 99.9 %, or as few as the method leaves.
    let levels = harness.state().state().document.as_ref().unwrap().levels.as_ref().unwrap().1.clone();
    assert!(fewest <= (all / 999).max(levels.triangles_after(levels.errors.len() as u32)), "{fewest} of {all}");
    click(&mut harness, "Pause");
    let paused = state(&harness).0;
    harness.run_steps(10);
    assert_eq!(state(&harness).0, paused);
    click(&mut harness, "Save (APNG)...");
    let (name, bytes) = offered(&mut harness, &memory);
    assert!(name.ends_with("-reduction.png"), "{name}");
    let mut reader = info(&bytes);
    let frames = reader.info().animation_control().unwrap().num_frames;
    let mut pictures = Vec::new();
    for _frame in 0..frames {
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        pictures.push(pixels);
    }
    let differing = |a: usize, b: usize| pictures[a].iter().zip(&pictures[b]).filter(|(a, b)| a != b).count();
    let half = pictures.len() / 2;
    let differ = [differing(0, half), differing(half - 6, half)];
    assert!(pictures.len() >= 24 && differ[0] > 1000 && differ[1] > 100, "{} pictures: {differ:?}", pictures.len());
    assert!(differing(half - 6, half + 6) == 0, "back by the way it went");
    click(&mut harness, "Close");
    settle_wholly(&mut harness);
    assert_eq!((harness.state().state().settings.clone(), state(&harness).0), before);
}

#[test]
fn what_is_played_gives_back_the_reduction_before_whatever_ends_it() {
    let ends = ["trial", "comparison", "lesson", "cancel", "close"].map(|end| (Target::Auto, end));
    for (target, end) in ends.into_iter().chain([(Target::Deviation(200), "close")]) {
        let (mut harness, memory) = app_at(DESKTOP, 0.05);
        settle_wholly(&mut harness);
        let settings = Settings { target, ..harness.state().state().settings.clone() };
        let bytes = write_settings(&SharedSettings { unit: None, settings }).into_bytes();
        memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "set.json".to_owned(), bytes });
        harness.run_steps(8);
        settle_wholly(&mut harness);
        let shown = |harness: &Harness<'_, LumenApp>| {
            harness.state().state().document.as_ref().unwrap().shown.as_ref().unwrap().level.triangles.len()
        };
        let before = (harness.state().state().settings.clone(), shown(&harness));
        click(&mut harness, "Learn");
        harness.get_by_role_and_label(Role::CheckBox, "Play the reduction").click();
        // So slowly that the engine is at work.
        memory.borrow_mut().slice = std::time::Duration::from_millis(1);
        harness.run_steps(60);
        assert_ne!(harness.state().state().settings, before.0);
        match end {
            "trial" => harness.get_by_role_and_label(Role::Button, "Trial").click(),
            "comparison" => harness.key_press(Key::C),
            "lesson" => {
                click(&mut harness, "Learn");
                harness.get_by_role_and_label(Role::Button, "Pass band").click();
                harness.run_steps(3);
                click(&mut harness, "Close lesson");
            }
            "cancel" => harness.get_by_role_and_label(Role::Button, "Cancel").click(),
            _ => harness.get_by_role_and_label(Role::Button, "Close").click(),
        }
        harness.run_steps(4);
        memory.borrow_mut().slice = std::time::Duration::from_millis(50);
        assert!(!says(&harness, "Save (APNG)"), "{end}");
        assert_eq!(harness.state().state().settings, before.0, "{end}");
        if end == "trial" {
            harness.get_by_role_and_label(Role::Button, "Prepare").click();
            harness.run_steps(4);
        }
        settle(&mut harness);
        assert_eq!((harness.state().state().settings.clone(), shown(&harness)), before, "{end}");
    }
}

#[test]
fn whoever_sets_another_reduction_takes_over_from_what_is_played() {
    let (mut harness, _) = app_at(DESKTOP, 0.05);
    settle_wholly(&mut harness);
    click(&mut harness, "Learn");
    harness.get_by_role_and_label(Role::CheckBox, "Play the reduction").click();
    harness.run_steps(40);
    let slider = harness.get_by_role_and_label(Role::Slider, "Reduction").rect();
    harness.drag_at(slider.center());
    harness.run_steps(2);
    harness.drop_at(slider.center());
    harness.run_steps(6);
    let taken = harness.state().state().settings.target;
    assert!(matches!(taken, Target::Reduction(_)), "{taken:?}");
    harness.run_steps(20);
    assert_eq!(harness.state().state().settings.target, taken, "it no longer plays");
    harness.get_by_role_and_label(Role::Button, "Close").click();
    harness.run_steps(4);
    assert_eq!(harness.state().state().settings.target, taken);
}

/// The numbers of an attribute in each element of this kind.
fn numbers(svg: &str, element: &str, attribute: &str) -> Vec<Vec<f32>> {
    let of = |part: &str| {
        let (_, value) = part.split_once(&format!(" {attribute}=\""))?;
        let (value, _) = value.split_once('"')?;
        Some(value.split([' ', ',']).map(|number| number.parse().unwrap()).collect())
    };
    svg.split(&format!("<{element}")).skip(1).filter_map(|part| of(part.split_once("/>")?.0)).collect()
}

#[test]
fn a_plot_is_saved_as_it_stands_in_the_window() {
    let (mut harness, memory) = seen(|| opened([1280.0, 1400.0]));
    click(&mut harness, "Response");
    settle(&mut harness);
    click(&mut harness, "Save plot: Response");
    click(&mut harness, "As vector graphic (SVG)...");
    let (name, svg) = offered(&mut harness, &memory);
    assert_eq!(name, "abdominal-aorta-response.svg");
    let svg = String::from_utf8(svg).unwrap();
    assert!(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\"") && svg.ends_with("</svg>\n"));
    for words in [">Response</text>", ">100 %</text>", ">pass band</text>", ">Not for clinical decisions</text>"] {
        assert!(svg.contains(words), "{words} in {svg}");
    }
    assert!(!["<script", "href", "url(http"].iter().any(|foreign| svg.contains(foreign)));
    // The mark of half gain lies on the curve.
    let [x, y, radius] = ["cx", "cy", "r"].map(|attribute| numbers(&svg, "circle", attribute).concat());
    let marks = (0..x.len()).filter(|&i| radius[i] == 4.0);
    let lines = numbers(&svg, "polyline", "points");
    let curve = lines.iter().max_by_key(|line| line.len()).unwrap();
    let near = |x: f32, y: f32| curve.chunks(2).map(|at| (at[0] - x).hypot(at[1] - y)).fold(f32::INFINITY, f32::min);
    let far: Vec<f32> = marks.map(|i| near(x[i], y[i])).collect();
    assert!(far.len() == 1 && far[0] < 1.0, "{far:?} points away");

    click(&mut harness, "Save plot: Response");
    click(&mut harness, "As picture (PNG)...");
    let (name, png) = offered(&mut harness, &memory);
    assert_eq!(name, "abdominal-aorta-response.png");
    let mut reader = info(&png);
    assert_eq!(reader.info().width, 1920);
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    // The curve, which is as wide as the axes, in the theme's colour.
    let accent = harness.ctx.global_style().visuals.hyperlink_color;
    let is_accent = |pixel: &[u8]| pixel.iter().zip(accent.to_array()).all(|(a, b)| a.abs_diff(b) < 4);
    let drawn = pixels.chunks_exact(3).filter(|pixel| is_accent(pixel)).count();
    assert!(drawn > 5_000, "{drawn}");
}
