//! A report as PDF (ISO 32000-1), A4: one page where there are few vessels, more where there are many, each with the head of
//! the table. Its text is text, in Helvetica and WinAnsiEncoding; plots are paths; pictures are the rows of their PNG. The
//! same report gives the same bytes: no clock is read here.

use pdf_writer::types::Predictor;
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};

use super::document::{Document, Row, Table};
use super::letters::{encoded, lines, width};
use super::plot::{Ink, LETTERS, Mark, Plot, WIDE};
use crate::language::spoken;
use crate::say;

/// A4, in points.
const WIDTH: f32 = 595.0;
const HEIGHT: f32 = 842.0;
/// Its margins, on three sides and below.
const MARGIN: f32 = 40.0;
const FOOT: f32 = 48.0;
/// Sizes of letters, in points, and the height of a line in sizes.
const TITLE: f32 = 16.0;
const HEAD: f32 = 10.0;
const TEXT: f32 = 8.0;
const SMALL: f32 = 7.0;
const LEADING: f32 = 1.35;
/// Between columns.
const GAP: f32 = 14.0;
/// Width of the names of date, case and comment.
const ABOUT: f32 = 60.0;

/// Colours: red, green, blue.
const INK: [f32; 3] = [0.11, 0.14, 0.17];
const WEAK: [f32; 3] = [0.36, 0.40, 0.44];
const LINE: [f32; 3] = [0.84, 0.86, 0.88];
const ACCENT: [f32; 3] = [0.04, 0.43, 0.54];
const BAD: [f32; 3] = [0.70, 0.15, 0.12];

/// Writes a report.
pub(super) fn write(document: &Document) -> Vec<u8> {
    let mut pages = Pages::default();
    pages.begin();
    head(&mut pages, document);
    pictures(&mut pages, document);
    facts(&mut pages, document);
    plots(&mut pages, &document.plots);
    let (stretches, vessels) =
        ([60.0, 75.0, 45.0, 50.0, 80.0, 60.0, 50.0, 95.0], [80.0, 70.0, 55.0, 55.0, 55.0, 105.0, 50.0, 45.0]);
    table(&mut pages, &say!("report-by-hand"), &document.measures, &[90.0, 225.0, 115.0, 85.0]);
    table(&mut pages, &say!("report-solver"), &document.patches, &[95.0, 40.0, 85.0, 75.0, 110.0, 110.0]);
    table(&mut pages, &say!("report-stretches"), &document.stretches, &stretches);
    table(&mut pages, &say!("vessels-heading"), &document.vessels, &vessels);
    file(document, pages)
}

/// What is drawn, page by page, from the top.
#[derive(Default)]
struct Pages {
    done: Vec<Content>,
    /// How far down the last page is used, in points from its top.
    used: f32,
}

impl Pages {
    fn begin(&mut self) {
        self.done.push(Content::new());
        self.used = MARGIN;
    }

    /// Whether so much fits on the page; else another begins.
    fn fits(&mut self, height: f32) -> bool {
        let fits = self.used + height <= HEIGHT - FOOT;
        if !fits {
            self.begin();
        }
        fits
    }

    fn page(&mut self) -> &mut Content {
        if self.done.is_empty() {
            self.begin();
        }
        let last = self.done.len() - 1;
        &mut self.done[last]
    }

    /// Letters on a base line `down` points from the top of the page.
    fn letters(&mut self, at: [f32; 2], text: &[u8], size: f32, is_bold: bool, colour: [f32; 3]) {
        let [left, down] = at;
        letters(self.page(), [left, HEIGHT - down], text, size, is_bold, colour);
    }

    /// A line from margin to margin.
    fn across(&mut self, wide: f32, colour: [f32; 3]) {
        let up = HEIGHT - self.used;
        rule(self.page(), [MARGIN, up], [WIDTH - MARGIN, up], wide, colour);
    }

    /// Lines of text at the left margin.
    fn text(&mut self, text: &str, size: f32, is_bold: bool, colour: [f32; 3]) {
        for line in lines(text, size * if is_bold { 1.1 } else { 1.0 }, WIDTH - 2.0 * MARGIN) {
            self.fits(size * LEADING);
            self.used += size * LEADING;
            self.letters([MARGIN, self.used - 0.3 * size], &line, size, is_bold, colour);
        }
    }
}

fn letters(page: &mut Content, at: [f32; 2], text: &[u8], size: f32, is_bold: bool, colour: [f32; 3]) {
    let [red, green, blue] = colour;
    let font = Name(if is_bold { b"B" } else { b"R" });
    page.set_fill_rgb(red, green, blue);
    page.begin_text().set_font(font, size).next_line(at[0], at[1]).show(Str(text)).end_text();
}

fn rule(page: &mut Content, from: [f32; 2], to: [f32; 2], wide: f32, [red, green, blue]: [f32; 3]) {
    page.set_stroke_rgb(red, green, blue).set_line_width(wide);
    page.move_to(from[0], from[1]).line_to(to[0], to[1]).stroke();
}

fn head(pages: &mut Pages, document: &Document) {
    pages.text(&document.title, TITLE, true, INK);
    pages.text(&document.line, TEXT, false, WEAK);
    pages.used += 2.0;
    entries(pages, MARGIN, [ABOUT, WIDTH - 2.0 * MARGIN - ABOUT], &document.about);
    pages.used += 6.0;
    let colour = match document.is_safe {
        Some(true) => ACCENT,
        Some(false) => BAD,
        None => WEAK,
    };
    pages.across(1.5, colour);
    pages.used += 3.0;
    pages.text(&document.head, HEAD, true, colour);
    for finding in &document.findings {
        pages.text(finding, TEXT, false, INK);
    }
    pages.used += 6.0;
}

/// Up to four in a row, all as wide.
fn pictures(pages: &mut Pages, document: &Document) {
    for (row, pictures) in document.pictures.chunks(4).enumerate() {
        let wide = (WIDTH - 2.0 * MARGIN - 3.0 * GAP / 2.0) / 4.0;
        let high = pictures.iter().map(|picture| wide * picture.height as f32 / picture.width.max(1) as f32);
        let high = high.fold(0.0, f32::max).min(260.0);
        pages.fits(high + 2.0 * SMALL * LEADING);
        for (i, picture) in pictures.iter().enumerate() {
            let left = MARGIN + (wide + GAP / 2.0) * i as f32;
            let bottom = HEIGHT - pages.used - high;
            let name = format!("P{}", 4 * row + i);
            pages.page().save_state().transform([wide, 0.0, 0.0, high, left, bottom]);
            pages.page().x_object(Name(name.as_bytes())).restore_state();
            for (k, line) in lines(&picture.caption, SMALL, wide).iter().take(2).enumerate() {
                let down = pages.used + high + SMALL * LEADING * (k + 1) as f32;
                pages.letters([left, down], line, SMALL, false, WEAK);
            }
        }
        pages.used += high + 2.0 * SMALL * LEADING + 6.0;
    }
}

/// File and settings on the left, numbers on the right.
fn facts(pages: &mut Pages, document: &Document) {
    let half = (WIDTH - 2.0 * MARGIN - GAP) / 2.0;
    let rows = document.file.len() + document.settings.len() + 4;
    pages.fits(rows as f32 * TEXT * LEADING * 1.3);
    let top = pages.used;
    list(pages, MARGIN, half, &say!("report-file"), &document.file);
    pages.used += 4.0;
    list(pages, MARGIN, half, &say!("report-settings"), &document.settings);
    let left = pages.used;
    pages.used = top;
    list(pages, MARGIN + half + GAP, half, &say!("report-numbers"), &document.numbers);
    pages.used = pages.used.max(left) + 8.0;
}

fn list(pages: &mut Pages, left: f32, room: f32, head: &str, rows: &[Row]) {
    pages.used += HEAD * LEADING;
    pages.letters([left, pages.used - 3.0], &encoded(head), HEAD, true, INK);
    entries(pages, left, [0.4 * room, 0.6 * room], rows);
}

/// Names and what they are, in columns of these widths; what is long goes on over pages.
fn entries(pages: &mut Pages, left: f32, [name_room, room]: [f32; 2], rows: &[Row]) {
    for (name, value) in rows {
        for (k, line) in lines(value, TEXT, room).iter().enumerate() {
            pages.fits(TEXT * LEADING);
            if k == 0 {
                pages.letters([left, pages.used + TEXT], &encoded(name), TEXT, false, WEAK);
            }
            pages.letters([left + name_room, pages.used + TEXT], line, TEXT, false, INK);
            pages.used += TEXT * LEADING;
        }
    }
}

/// Two in a row.
fn plots(pages: &mut Pages, plots: &[Plot]) {
    let wide = (WIDTH - 2.0 * MARGIN - GAP) / 2.0;
    let scale = wide / WIDE as f32;
    for pair in plots.chunks(2) {
        let high = TEXT * LEADING + scale * pair.iter().map(Plot::height).fold(0.0, f64::max) as f32;
        pages.fits(high);
        for (i, plot) in pair.iter().enumerate() {
            let left = MARGIN + (wide + GAP) * i as f32;
            pages.letters([left, pages.used + TEXT], &encoded(&plot.title), TEXT, true, INK);
            let top = HEIGHT - pages.used - TEXT * LEADING;
            draw(pages.page(), plot, [left, top], scale);
        }
        pages.used += high + 8.0;
    }
}

/// A plot with its upper left corner at `corner`, `scale` points to a unit of its own.
fn draw(page: &mut Content, plot: &Plot, corner: [f32; 2], scale: f32) {
    let place = |[x, y]: [f64; 2]| [corner[0] + scale * x as f32, corner[1] - scale * y as f32];
    for mark in plot.drawn() {
        match mark {
            Mark::Line { points, ink, is_dashed } => {
                let [red, green, blue] = colour(ink);
                let Some((&first, rest)) = points.split_first() else { continue };
                page.save_state().set_stroke_rgb(red, green, blue);
                page.set_line_width(if ink == Ink::Line { 0.5 } else { 1.0 });
                if is_dashed {
                    page.set_dash_pattern([3.0, 2.0], 0.0);
                }
                let [x, y] = place(first);
                page.move_to(x, y);
                for &point in rest {
                    let [x, y] = place(point);
                    page.line_to(x, y);
                }
                page.stroke().restore_state();
            }
            Mark::Text { at, pull, text, ink } => {
                let (text, size, [x, y]) = (encoded(&text), scale * LETTERS as f32, place(at));
                let left = x - pull as f32 * width(&text, size, false);
                letters(page, [left, y], &text, size, false, colour(ink));
            }
        }
    }
}

fn colour(ink: Ink) -> [f32; 3] {
    match ink {
        Ink::Accent => ACCENT,
        Ink::Text => INK,
        Ink::Weak => WEAK,
        Ink::Line => LINE,
    }
}

/// A table in columns of these widths; on each page that it goes on to it has its head.
fn table(pages: &mut Pages, title: &str, table: &Table, columns: &[f32]) {
    if table.rows.is_empty() {
        return;
    }
    let step = SMALL * LEADING;
    pages.fits(HEAD * LEADING + 4.0 * step);
    pages.used += HEAD * LEADING;
    pages.letters([MARGIN, pages.used - 3.0], &encoded(title), HEAD, true, INK);
    heads(pages, table, columns);
    for row in &table.rows {
        let cells: Vec<Vec<Vec<u8>>> =
            row.iter().zip(columns).map(|(cell, wide)| lines(cell, SMALL, wide - 4.0)).collect();
        let high = cells.iter().map(Vec::len).max().unwrap_or(1) as f32 * step;
        if !pages.fits(high + 2.0) {
            heads(pages, table, columns);
        }
        let mut left = MARGIN;
        for (cell, wide) in cells.iter().zip(columns) {
            for (k, line) in cell.iter().enumerate() {
                pages.letters([left, pages.used + SMALL + step * k as f32], line, SMALL, false, INK);
            }
            left += wide;
        }
        pages.used += high + 1.0;
        pages.across(0.3, LINE);
        pages.used += 1.0;
    }
    pages.used += 6.0;
}

fn heads(pages: &mut Pages, table: &Table, columns: &[f32]) {
    let mut left = MARGIN;
    for (head, wide) in table.heads.iter().zip(columns) {
        pages.letters([left, pages.used + SMALL], &encoded(head), SMALL, true, INK);
        left += wide;
    }
    pages.used += SMALL * LEADING + 1.0;
    pages.across(0.6, WEAK);
    pages.used += 1.0;
}

/// The pages as a file.
fn file(document: &Document, mut pages: Pages) -> Vec<u8> {
    let count = pages.done.len() as i32;
    for (i, page) in pages.done.iter_mut().enumerate() {
        let number = encoded(&say!("report-page", page = i + 1, count = count));
        letters(page, [MARGIN, 26.0], &encoded(&document.line), SMALL, false, WEAK);
        let left = WIDTH - MARGIN - width(&number, SMALL, false);
        letters(page, [left, 26.0], &number, SMALL, false, WEAK);
    }
    let [catalog, tree, info, regular, bold] = [1, 2, 3, 4, 5].map(Ref::new);
    let mut next = 6;
    let mut number = || {
        next += 1;
        Ref::new(next)
    };
    let images: Vec<Ref> = document.pictures.iter().map(|_| number()).collect();
    let sheets: Vec<[Ref; 2]> = pages.done.iter().map(|_| [number(), number()]).collect();
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(tree).lang(TextStr(spoken().tag()));
    pdf.pages(tree).kids(sheets.iter().map(|sheet| sheet[0])).count(count);
    let mut about = pdf.document_info(info);
    about.title(TextStr(&document.title)).producer(TextStr(concat!("Lumen ", env!("CARGO_PKG_VERSION"))));
    about.subject(TextStr(&document.line));
    about.finish();
    for (font, name) in [(regular, &b"Helvetica"[..]), (bold, &b"Helvetica-Bold"[..])] {
        pdf.type1_font(font).base_font(Name(name)).encoding_predefined(Name(b"WinAnsiEncoding"));
    }
    for (image, picture) in images.iter().zip(&document.pictures) {
        let rows = picture.rows();
        let mut object = pdf.image_xobject(*image, &rows);
        object.filter(Filter::FlateDecode);
        object.width(picture.width as i32).height(picture.height as i32);
        object.color_space().device_rgb();
        object.bits_per_component(8);
        let mut how = object.decode_parms();
        how.predictor(Predictor::PngOptimum).colors(3).bits_per_component(8).columns(picture.width as i32);
    }
    for ([sheet, drawn], content) in sheets.into_iter().zip(pages.done) {
        let mut page = pdf.page(sheet);
        page.media_box(Rect::new(0.0, 0.0, WIDTH, HEIGHT)).parent(tree).contents(drawn);
        let mut resources = page.resources();
        resources.fonts().pair(Name(b"R"), regular).pair(Name(b"B"), bold);
        let mut names = resources.x_objects();
        for (i, image) in images.iter().enumerate() {
            names.pair(Name(format!("P{i}").as_bytes()), *image);
        }
        names.finish();
        resources.finish();
        page.finish();
        let packed = miniz_oxide::deflate::compress_to_vec_zlib(&content.finish(), 6);
        pdf.stream(drawn, &packed).filter(Filter::FlateDecode);
    }
    pdf.finish()
}
