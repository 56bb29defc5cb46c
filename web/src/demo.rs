//! A stand-in for the app while it is being written: each kind of control, a file in and out, an echo from a Worker.

use std::cell::RefCell;
use std::rc::Rc;

use crate::files;
use crate::worker::{Heard, Message, WorkerLine};

pub(crate) struct Demo {
    reduction: f64,
    status: String,
    line: Option<WorkerLine>,
    chosen: Rc<RefCell<Option<files::Chosen>>>,
    bytes: Vec<u8>,
}

impl Demo {
    pub(crate) fn new(cc: &eframe::CreationContext<'_>) -> Self {
        let ctx = cc.egui_ctx.clone();
        let line = WorkerLine::start("echo", move || ctx.request_repaint()).ok();
        Self { reduction: 50.0, status: "Ready".to_owned(), line, chosen: Rc::default(), bytes: Vec::new() }
    }
}

impl eframe::App for Demo {
    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        if let Some((name, bytes)) = self.chosen.take() {
            self.status = match bytes {
                Ok(bytes) => {
                    self.bytes = bytes;
                    format!("{name}: {} bytes", self.bytes.len())
                }
                Err(sentence) => sentence,
            };
        }
        if let Some(line) = &mut self.line
            && let Some(heard) = line.poll()
        {
            self.status = match heard {
                Heard::Message(message) => {
                    format!(
                        "Echo: {} with {} bytes",
                        message.header,
                        message.buffers.iter().map(Vec::len).sum::<usize>()
                    )
                }
                Heard::Died(why) => {
                    line.restart().ok();
                    format!("Died: {why}")
                }
            };
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
        if ui.button("Echo").clicked()
            && let Some(line) = &self.line
        {
            line.send(&Message { header: "{\"a\":1}".to_owned(), buffers: vec![vec![7; 1000], vec![1; 24]] }).ok();
        }
        ui.label(&self.status);
    }
}
