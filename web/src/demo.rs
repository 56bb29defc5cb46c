//! A stand-in for the app while it is being written: each kind of control, a file in and out, the engine's answers.

use std::cell::RefCell;
use std::rc::Rc;

use lumen::engine::{Command, Event, Link as _, Source};
use lumen::io::ImportOptions;
use lumen::pipeline::settings::Settings;

use crate::files;
use crate::link::WorkerLink;

pub(crate) struct Demo {
    reduction: f64,
    status: String,
    link: WorkerLink,
    chosen: Rc<RefCell<Option<files::Chosen>>>,
    bytes: Vec<u8>,
}

impl Demo {
    pub(crate) fn new(cc: &eframe::CreationContext<'_>) -> Self {
        let link = WorkerLink::new(cc.egui_ctx.clone());
        Self { reduction: 50.0, status: "Ready".to_owned(), link, chosen: Rc::default(), bytes: Vec::new() }
    }
}

impl eframe::App for Demo {
    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        if let Some((name, bytes)) = self.chosen.take() {
            match bytes {
                Ok(bytes) => {
                    self.bytes.clone_from(&bytes);
                    let source = Source::File { name, bytes: bytes.into(), options: ImportOptions::default() };
                    self.link.send(Command::Open { id: 1, source, settings: Settings::default() });
                }
                Err(sentence) => self.status = sentence,
            }
        }
        while let Some(event) = self.link.poll() {
            match event {
                Event::Opened(opened) => self.status = format!("Opened {} triangles", opened.mesh.triangles.len()),
                Event::OpenFailed { message, .. } => self.status = message,
                Event::Measured { complete: true, report, .. } => {
                    self.status = format!("Result: {} triangles", report.output.triangles);
                }
                _ => {}
            }
        }
        if let Some(why) = self.link.failure() {
            self.status = why;
            self.link.restart();
        }
        ui.heading("Lumen");
        ui.add(egui::Slider::new(&mut self.reduction, 0.0..=99.9).text("Reduction").suffix(" %"));
        if ui.button("Open...").clicked() {
            let (chosen, ctx) = (Rc::clone(&self.chosen), ui.ctx().clone());
            let opened = files::open(".stl,.ply", move |file| {
                chosen.replace(Some(file));
                ctx.request_repaint();
            });
            if let Err(error) = opened {
                self.status = format!("{error:?}");
            }
        }
        if ui.button("Save...").clicked() {
            files::save("demo.stl", &self.bytes).ok();
        }
        ui.label(&self.status);
    }
}
