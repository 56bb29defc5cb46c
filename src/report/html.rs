//! A report as one HTML file: style inside, pictures as `data:` addresses, plots as SVG; no script but the one that draws the
//! surface where that is in the page, and nothing from anywhere else, which its own Content-Security-Policy says too. It is
//! light or dark as the reader is, and prints on A4.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::document::{Document, Row, Table};
use super::plot::{Ink, LETTERS, Mark, Plot, WIDE};
use super::viewer::{self, Carried};
use crate::language::spoken;
use crate::say;

const STYLE: &str = "\
:root{color-scheme:light dark;--ink:#1d252c;--weak:#5c6770;--line:#d5dbe0;--ground:#fff;--accent:#0b6e8a;--bad:#b3261e}\
@media(prefers-color-scheme:dark){:root{--ink:#e6eaed;--weak:#a0abb4;--line:#3a444c;--ground:#14191d;--accent:#5cc3de;--bad:#ff8a80}}\
body{font:14px/1.45 system-ui,sans-serif;font-variant-numeric:tabular-nums;color:var(--ink);background:var(--ground);\
max-width:880px;margin:24px auto;padding:0 16px}\
h1{font-size:22px;margin:0}h2{font-size:15px;margin:20px 0 6px}p{margin:4px 0}.weak{color:var(--weak)}\
.verdict{border-left:4px solid var(--weak);padding:4px 12px;margin:16px 0}.safe{border-color:var(--accent)}.grave{border-color:var(--bad)}\
.columns{display:grid;grid-template-columns:repeat(auto-fit,minmax(260px,1fr));gap:0 24px}\
.plots{grid-template-columns:repeat(auto-fit,minmax(min(380px,100%),1fr))}\
table{border-collapse:collapse;width:100%;font-size:13px}td,th{text-align:left;padding:2px 8px 2px 0;vertical-align:top;\
border-bottom:1px solid var(--line)}th{font-weight:600}.facts td:first-child{color:var(--weak)}.about td:first-child{width:8em}.facts td+td{overflow-wrap:anywhere;white-space:pre-line}\
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(180px,1fr));gap:8px}figure{margin:0}img,svg{width:100%;height:auto}\
figcaption{font-size:12px;color:var(--weak)}.wide{overflow-x:auto}\
#viewer p{display:flex;flex-wrap:wrap;gap:4px 20px;align-items:center;margin:8px 0}\
#viewer canvas{display:block;width:100%;height:min(56vh,460px);touch-action:none;border:1px solid var(--line);border-radius:6px;box-sizing:border-box}\
#viewer canvas:focus-visible{outline:2px solid var(--accent);outline-offset:1px}#viewer button{margin-left:auto;font:inherit}\
.stage{position:relative}.stage span{position:absolute;top:8px;left:12px;color:var(--weak);pointer-events:none}.stage span+span{left:calc(50% + 12px)}\
@media(max-width:600px){#viewer canvas{height:min(64vh,560px)}.stage span+span{left:12px;top:calc(50% + 8px)}}\
@media print{#viewer{display:none}@page{size:A4;margin:12mm}body{margin:0;max-width:none;font-size:11px}table{font-size:10px}\
h2,figure,tr{break-inside:avoid}.pictures{grid-template-columns:repeat(4,1fr)}}";

/// The report as a page.
pub(super) fn write(document: &Document) -> String {
    let mut page = String::new();
    let (title, language) = (escaped(&document.title), spoken().tag());
    let scripts =
        document.surface.as_ref().map_or_else(String::new, |_| format!(";script-src {}", viewer::script_source()));
    let _ = write!(
        page,
        "<!doctype html>\n<html lang=\"{language}\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none';img-src data:;style-src 'unsafe-inline'{scripts}\">\
         <title>{title}</title><style>{STYLE}</style></head><body>\n<h1>{title}</h1><p class=\"weak\">{}</p>\n<table class=\"facts about\">",
        escaped(&document.line)
    );
    rows(&mut page, &document.about);
    page += "</table>\n";
    let class = match document.is_safe {
        Some(true) => "verdict safe",
        Some(false) => "verdict grave",
        None => "verdict",
    };
    let _ = write!(page, "<section class=\"{class}\"><strong>{}</strong>", escaped(&document.head));
    for finding in &document.findings {
        let _ = write!(page, "<p>{}</p>", escaped(finding));
    }
    page += "</section>\n";
    if let Some(surface) = &document.surface {
        self::surface(&mut page, surface);
    }
    if !document.pictures.is_empty() {
        page += "<div class=\"pictures\">";
        for picture in &document.pictures {
            let (caption, png) = (escaped(&picture.caption), STANDARD.encode(&picture.png));
            let (width, height) = (picture.width, picture.height);
            let _ = write!(
                page,
                "<figure><img width=\"{width}\" height=\"{height}\" alt=\"{caption}\" src=\"data:image/png;base64,{png}\">\
                 <figcaption>{caption}</figcaption></figure>"
            );
        }
        page += "</div>\n";
    }
    page += "<div class=\"columns\">";
    facts(&mut page, &say!("report-file"), &document.file);
    facts(&mut page, &say!("report-settings"), &document.settings);
    facts(&mut page, &say!("report-numbers"), &document.numbers);
    page += "</div>\n<div class=\"columns plots\">";
    for plot in &document.plots {
        let _ = write!(page, "<figure><h2>{}</h2>", escaped(&plot.title));
        svg(&mut page, plot);
        page += "</figure>";
    }
    page += "</div>\n";
    table(&mut page, &say!("report-by-hand"), &document.measures);
    table(&mut page, &say!("report-solver"), &document.patches);
    table(&mut page, &say!("report-stretches"), &document.stretches);
    table(&mut page, &say!("vessels-heading"), &document.vessels);
    let _ = writeln!(page, "<p class=\"weak\">{}</p>", escaped(&document.line));
    if let Some(surface) = &document.surface {
        let (data, script) = (surface.data(), viewer::script());
        let _ = write!(
            page,
            "<script type=\"application/json\" id=\"surface\">{data}</script>\n<script>{script}</script>\n"
        );
    }
    page + "</body></html>\n"
}

/// What the script draws into, and its controls; hidden until it does.
fn surface(page: &mut String, surface: &Carried) {
    let [shaded, wireframe, help, save] =
        [say!("views-shaded-title"), say!("views-wireframe-title"), say!("report-view-help"), say!("report-view-save")]
            .map(|text| escaped(&text));
    *page += "<section id=\"viewer\" hidden><p>";
    for (i, name) in surface.names().iter().enumerate() {
        let checked = if i == 0 { " checked" } else { "" };
        let _ = write!(
            page,
            "<label><input type=\"radio\" autocomplete=\"off\" name=\"level\" value=\"{i}\"{checked}> {}</label>",
            escaped(name)
        );
    }
    let _ = writeln!(
        page,
        "<button type=\"button\">{save}</button></p><div class=\"stage\"><canvas tabindex=\"0\" role=\"img\" aria-label=\"{shaded}, {wireframe}. {help}\"></canvas>\
         <span>{shaded}</span><span>{wireframe}</span></div><p class=\"weak\">{help}</p></section>"
    );
}

/// Text that is nothing but text, in elements and in attributes; its lines stay lines.
pub(crate) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe += "&amp;",
            '<' => safe += "&lt;",
            '>' => safe += "&gt;",
            '"' => safe += "&quot;",
            '\'' => safe += "&#39;",
            letter if letter.is_control() && letter != '\n' => safe.push(' '),
            letter => safe.push(letter),
        }
    }
    safe
}

fn facts(page: &mut String, head: &str, list: &[Row]) {
    let _ = write!(page, "<section><h2>{}</h2><table class=\"facts\">", escaped(head));
    rows(page, list);
    *page += "</table></section>";
}

fn rows(page: &mut String, rows: &[Row]) {
    for (name, value) in rows {
        let _ = write!(page, "<tr><td>{}</td><td>{}</td></tr>", escaped(name), escaped(value));
    }
}

fn table(page: &mut String, head: &str, table: &Table) {
    if table.rows.is_empty() {
        return;
    }
    let _ = write!(page, "<h2>{}</h2><div class=\"wide\"><table><thead><tr>", escaped(head));
    for head in &table.heads {
        let _ = write!(page, "<th scope=\"col\">{}</th>", escaped(head));
    }
    *page += "</tr></thead><tbody>";
    for row in &table.rows {
        *page += "<tr>";
        for cell in row {
            let _ = write!(page, "<td>{}</td>", escaped(cell));
        }
        *page += "</tr>";
    }
    *page += "</tbody></table></div>\n";
}

/// A plot as a file of its own, in the colours of paper, with its title and what it is not for.
#[cfg(not(target_arch = "wasm32"))]
pub fn svg_file(plot: &Plot) -> String {
    let (high, title, notice) = (plot.height(), escaped(&plot.title), escaped(&say!("report-not-clinical")));
    let mut file = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 -24 {WIDE} {}\" font-size=\"{LETTERS}\">\
         <style>svg{{--ink:#1d252c;--weak:#5c6770;--line:#d5dbe0;--accent:#0b6e8a;font-family:sans-serif}}</style>\
         <title>{title}</title><rect y=\"-24\" width=\"100%\" height=\"100%\" fill=\"#fff\"/>\
         <text x=\"2\" y=\"-8\" font-weight=\"600\">{title}</text>\
         <text x=\"2\" y=\"{}\" style=\"fill:var(--weak)\">{notice}</text>",
        high + 44.0,
        high + 12.0,
    );
    marks(&mut file, plot);
    file + "</svg>\n"
}

fn svg(page: &mut String, plot: &Plot) {
    let (high, title) = (plot.height(), escaped(&plot.title));
    let _ =
        write!(page, "<svg viewBox=\"0 0 {WIDE} {high}\" font-size=\"{LETTERS}\" role=\"img\" aria-label=\"{title}\">");
    marks(page, plot);
    *page += "</svg>";
}

fn marks(page: &mut String, plot: &Plot) {
    for mark in plot.drawn() {
        match mark {
            Mark::Line { points, ink, is_dashed } => {
                let dash = if is_dashed { " stroke-dasharray=\"4 3\"" } else { "" };
                let stroke = colour(ink);
                let _ =
                    write!(page, "<polyline fill=\"none\" stroke-width=\"1.5\" stroke=\"{stroke}\"{dash} points=\"");
                for [x, y] in points {
                    let _ = write!(page, "{x:.1},{y:.1} ");
                }
                *page += "\"/>";
            }
            Mark::Text { at: [x, y], pull, text, ink } => {
                let anchor = ["start", "middle", "end"][(2.0 * pull) as usize];
                let (fill, text) = (colour(ink), escaped(&text));
                let _ = write!(
                    page,
                    "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" style=\"fill:{fill}\">{text}</text>"
                );
            }
        }
    }
}

fn colour(ink: Ink) -> &'static str {
    match ink {
        Ink::Accent => "var(--accent)",
        Ink::Text => "var(--ink)",
        Ink::Weak => "var(--weak)",
        Ink::Line => "var(--line)",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Language, built_in, speak};

    #[test]
    fn the_page_is_in_the_language_that_is_spoken_and_says_so() {
        let document = Document {
            title: "A".to_owned(),
            line: "B".to_owned(),
            about: Vec::new(),
            file: Vec::new(),
            settings: Vec::new(),
            numbers: Vec::new(),
            head: "C".to_owned(),
            is_safe: None,
            findings: Vec::new(),
            vessels: Table::default(),
            stretches: Table::default(),
            measures: Table::default(),
            patches: Table::default(),
            surface: None,
            pictures: Vec::new(),
            plots: Vec::new(),
        };
        assert!(write(&document).contains("<html lang=\"en\">"));
        speak(Language::German, built_in(Language::German).unwrap());
        let page = write(&document);
        speak(Language::English, &[]);
        assert!(page.contains("<html lang=\"de\">") && page.contains("<h2>Einstellungen</h2>"), "{page}");
    }
}
