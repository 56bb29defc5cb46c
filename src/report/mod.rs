//! A page for the record: what a surface was, what was made of it and what is to be said of that, as PDF and as a web page
//! that needs nothing else.
//!
//! [`Document`] is what stands in it; `html` and `pdf` write that, and `viewer` puts the surface into the web page. Names are not trusted: a file may call an array anything.

mod document;
mod html;
mod letters;
mod pdf;
mod picture;
mod plot;
#[cfg(not(target_arch = "wasm32"))]
mod today;
mod viewer;
pub mod words;

use serde::{Deserialize, Serialize};

#[cfg(feature = "gui")]
pub(crate) use html::escaped;

pub use document::{Document, Heading, Row, Subject, Table};
#[cfg(not(target_arch = "wasm32"))]
pub use html::svg_file;
pub use picture::{Picture, PictureError, Pixels, Strip};
pub use plot::{Axis, Curve, Ink, Panel, Plot, sweep_plot};
#[cfg(not(target_arch = "wasm32"))]
pub use today::today;
pub use viewer::Carried;

/// What a report is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ReportFormat {
    /// PDF 1.7, A4.
    Pdf,
    /// One HTML file.
    Html,
    /// The same with the surface in it, to be turned.
    HtmlWithSurface,
}

impl ReportFormat {
    /// The extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Pdf => "pdf",
            Self::Html | Self::HtmlWithSurface => "html",
        }
    }

    /// The format that the name of a file asks for.
    pub fn from_name(name: &str) -> Option<Self> {
        let (_, extension) = name.rsplit_once('.')?;
        match &*extension.to_ascii_lowercase() {
            "pdf" => Some(Self::Pdf),
            "html" | "htm" => Some(Self::Html),
            _ => None,
        }
    }

    /// Writes a report.
    pub fn write(self, document: &Document) -> Vec<u8> {
        match self {
            Self::Pdf => pdf::write(document),
            Self::Html | Self::HtmlWithSurface => html::write(document).into_bytes(),
        }
    }
}
