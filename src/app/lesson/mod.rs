//! Lessons: short ones that come with Lumen, and those that a teacher writes. A step of a lesson says something, sets the
//! app as a hand would, by [`Action`](super::Action)s, and may ask a question before it answers it.

pub(super) mod action;
mod card;
mod format;
mod glossary;

use std::collections::VecDeque;
use std::sync::Arc;

use egui::Ui;

pub use self::action::Action;
pub use self::format::{Lesson, LessonError, Show, Step, Trial};
pub(super) use self::glossary::glossary;
use super::action::Action as Ask;
use super::collapses;
use super::deviating::Deviating;
use super::mode::{Acting, Beside, Layer, Now, Panel, Place};
use super::options::{Colours, ViewOptions};
use super::reference;
use super::reveal::Reveal;
use super::row::Part;
use super::state::State;
use super::{solver, trial, vessels};
use crate::engine::Source;
use crate::language::Key;
use crate::pipeline::settings::Settings;
use crate::prepare::prepare::Plan;
use crate::say;
use crate::sharing::measures::Measure;

/// What a lesson's file ends in.
pub const ENDING: &str = "lesson";

/// The lessons that come with Lumen: name in a link, title, and the text of its file.
pub const LESSONS: [(&str, Key, Key); 8] = [
    ("stair-steps", Key("lesson-stair-steps"), Key("lesson-stair-steps-text")),
    ("nets", Key("lesson-nets"), Key("lesson-nets-text")),
    ("pass-band", Key("lesson-pass-band"), Key("lesson-pass-band-text")),
    ("windows", Key("lesson-windows"), Key("lesson-windows-text")),
    ("shrinkage", Key("lesson-shrinkage"), Key("lesson-shrinkage-text")),
    ("decimation", Key("lesson-decimation"), Key("lesson-decimation-text")),
    ("wire", Key("lesson-wire"), Key("lesson-wire-text")),
    ("solver", Key("lesson-solver"), Key("lesson-solver-text")),
];

/// The lesson that is given, if one is.
#[derive(Default)]
pub struct Lessons {
    open: Option<Given>,
    /// What waits for the surface or the trial that a step has asked for.
    waiting: VecDeque<Ask>,
    /// What stood before the first step.
    stood: Option<Stood>,
}

/// What a lesson sets, as the user had it before.
#[derive(Clone, Debug)]
pub(super) struct Stood {
    /// The surface, and its number.
    pub(super) surface: Option<(u64, Source)>,
    /// What was measured on it.
    pub(super) measures: Arc<Vec<Measure>>,
    pub(super) settings: Settings,
    pub(super) options: ViewOptions,
}

/// From this width on of the window the card stands at its side, in points.
const BESIDE: f32 = 1000.0;

/// A lesson that is given.
#[derive(Clone, Debug)]
pub struct Given {
    /// The lesson.
    pub lesson: Lesson,
    /// Its name in a link, if it came with Lumen.
    pub name: Option<&'static str>,
    /// The step that is shown, from 0.
    pub step: usize,
    /// Whether its answer is shown.
    pub is_answered: bool,
}

/// What of the app a step has to know before it sets it.
#[derive(Clone, Copy)]
pub(super) struct Before<'a> {
    pub(super) state: &'a State,
    pub(super) options: ViewOptions,
    pub(super) in_trial: bool,
    /// Whether the autopilot steers the trial.
    pub(super) has_autopilot: bool,
    pub(super) are_vessels_open: bool,
    pub(super) are_collapses_open: bool,
}

impl Lessons {
    /// The lesson that is given.
    pub fn given(&self) -> Option<&Given> {
        self.open.as_ref()
    }

    /// Takes the lesson of this name.
    pub(super) fn open(&mut self, name: &str) -> Result<(), String> {
        let Some(&(name, _, text)) = LESSONS.iter().find(|(known, ..)| *known == name) else {
            let names: Vec<&str> = LESSONS.iter().map(|(name, ..)| *name).collect();
            return Err(say!("lesson-no-such", names = names.join(", ")));
        };
        self.take(text.say().as_bytes(), Some(name)).map_err(|error| error.to_string())
    }

    /// Says the lesson that is given anew, if it came with Lumen: another language is spoken.
    pub(super) fn speak(&mut self) {
        let Some(given) = &mut self.open else { return };
        let text = LESSONS.iter().find(|(known, ..)| given.name == Some(known)).map(|(_, _, text)| text.say());
        // All of them have the same steps, which a test sees to.
        if let Some(lesson) = text.and_then(|text| Lesson::read(text.as_bytes()).ok()) {
            given.lesson = lesson;
        }
    }

    /// Takes the lesson of a file.
    pub(super) fn take(&mut self, bytes: &[u8], name: Option<&'static str>) -> Result<(), LessonError> {
        let lesson = Lesson::read(bytes)?;
        self.open = Some(Given { lesson, name, step: 0, is_answered: false });
        Ok(())
    }

    /// Leaves the lesson; says what stood before it.
    pub(super) fn close(&mut self) -> Option<Stood> {
        std::mem::take(self).stood
    }

    /// Shows the answer.
    pub(super) fn answer(&mut self) {
        if let Some(given) = &mut self.open {
            given.is_answered = true;
        }
    }

    /// Goes to a step, and says what is to be done for it at once; the rest waits.
    pub(super) fn go(&mut self, step: usize, now: Before<'_>) -> Vec<Ask> {
        let Some(given) = &mut self.open else { return Vec::new() };
        given.step = step.min(given.lesson.steps.len() - 1);
        given.is_answered = false;
        self.stood.get_or_insert_with(|| Stood {
            surface: now.state.document.as_ref().map(|open| (open.revision.document, open.source.clone())),
            measures: now.state.measures.clone(),
            settings: now.state.settings.clone(),
            options: now.options,
        });
        let Step { sample, settings, view, show, trial, .. } = &given.lesson.steps[given.step];
        let shows = |what: Show| show.contains(&what);
        let mut asked = Vec::new();
        let goes_on = *trial != Trial::Off && sample.is_none() && settings.is_none();
        if now.in_trial && !goes_on {
            asked.push(Ask::ToggleTrial);
        }
        if now.state.comparison.is_open() {
            asked.push(Ask::Compare);
        }
        if now.state.against.is_open {
            asked.push(Ask::Reference(reference::Action::Show(false)));
        }
        if let Some(settings) = settings {
            let keep = now.state.settings.keep;
            asked.push(Ask::Set(Box::new(Settings { keep, ..settings.clone() })));
        }
        let open = now.state.document.as_ref().map(|document| &document.source);
        let is_open = |sample| matches!(open, Some(Source::Sample { sample: open, .. }) if *open == sample);
        asked.extend(sample.filter(|&sample| !is_open(sample)).map(Ask::Sample));
        asked.push(Ask::Show(options(now.options, show)));
        if now.are_vessels_open != shows(Show::Vessels) {
            asked.push(Ask::Vessels(vessels::action::Action::Toggle));
        }
        if now.are_collapses_open != shows(Show::Collapses) {
            asked.push(Ask::Collapses(collapses::action::Action::Toggle));
        }
        let parts = [(Show::Response, Part::Response), (Show::Error, Part::Error), (Show::Solver, Part::Solver)];
        asked.extend(parts.into_iter().filter(|(show, _)| shows(*show)).map(|(_, part)| Ask::Unfold(part)));
        self.waiting.clear();
        self.waiting.extend(view.map(Ask::View));
        let is_made = now.state.preparation.shown == Some(solver::Shown::Made);
        if now.state.preparation.shown.is_some() && !shows(Show::Solver) {
            asked.push(Ask::Solver(solver::Action::Show(None)));
        } else if !is_made && shows(Show::Solver) {
            asked.push(Ask::Solver(solver::Action::Set(Plan::flow())));
            self.waiting.push_back(Ask::Solver(solver::Action::Prepare));
        }
        let stays = now.in_trial && goes_on;
        if *trial != Trial::Off && !stays {
            self.waiting.push_back(Ask::ToggleTrial);
        }
        // The action turns it on or off; a trial begins without it.
        if *trial != Trial::Off && (*trial == Trial::Autopilot) != (stays && now.has_autopilot) {
            self.waiting.push_back(Ask::Trial(trial::Action::Autopilot));
        }
        asked
    }

    /// The next thing that has waited: for the level of the settings, or for the wire to be in.
    pub(super) fn next(&mut self, has_level: bool, trial: &trial::Trial) -> Option<Ask> {
        match self.waiting.front()? {
            Ask::Trial(_) if !trial.is_open() => {
                // It was refused, or taken off.
                self.waiting.pop_front();
                None
            }
            Ask::Trial(_) => self.waiting.pop_front_if(|_| trial.is_on()),
            _ => self.waiting.pop_front_if(|_| has_level),
        }
    }
}

impl Panel for Lessons {
    fn id(&self) -> &'static str {
        "lesson"
    }

    fn is_there(&self, _: &State, _: Beside) -> bool {
        self.open.is_some()
    }

    fn place(&self, ui: &Ui, _: Now<'_>) -> Place {
        // Never over the views: what it tells one to look at is there.
        if ui.available_width() >= BESIDE {
            Place::Side(280.0, 240.0..=440.0)
        } else {
            Place::Foot((ui.available_height() * 0.28).clamp(120.0, 210.0))
        }
    }

    fn escape(&self, _: Now<'_>, layer: Layer) -> Option<Ask> {
        (layer == Layer::Open && self.open.is_some()).then_some(Ask::Lesson(Action::Close))
    }

    fn show(&mut self, ui: &mut Ui, now: Now<'_>, asked: &mut Vec<Ask>) {
        if let Some(given) = &self.open {
            let is_measuring = now.state.is_measuring() && (now.state.calibre().is_none() || now.state.is_deciding());
            card::show(ui, given, now.has_links, is_measuring, asked);
        }
    }

    /// A step asks for what other panels do: the app does it.
    fn act(&mut self, action: Ask, _: &mut Acting<'_>) -> Option<Ask> {
        Some(action)
    }
}

/// The options with just what a step shows.
fn options(now: ViewOptions, show: &[Show]) -> ViewOptions {
    let shows = |what: Show| show.contains(&what);
    let deviation = Deviating::default();
    let maps = [
        (Show::Deviation, Colours::Deviation(deviation)),
        (Show::Calibre, Colours::Calibre),
        (Show::Classes, Colours::Classes),
    ];
    ViewOptions {
        flat: shows(Show::Flat),
        raking: shows(Show::Raking),
        lines: shows(Show::Lines),
        before: shows(Show::Before),
        reveal: if shows(Show::Split) { Reveal::Association } else { Reveal::Off },
        deviation,
        colours: maps.into_iter().find(|(what, _)| shows(*what)).map_or(Colours::None, |(_, colours)| colours),
        ..now
    }
}

/// Whether a file is a lesson, by its name.
pub(super) fn is_lesson(name: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, ending)| ending.eq_ignore_ascii_case(ENDING))
}

/// The lesson that a link names, its step from 0, and the rest of the link, if it has any.
pub(super) fn in_link(fragment: &str) -> Option<(String, usize, String)> {
    let pairs = || fragment.trim_start_matches('#').split('&');
    let value = |key: &str| pairs().find_map(|pair| pair.strip_prefix(key)?.strip_prefix('='));
    let name = value("lesson")?.to_owned();
    let step = value("step").and_then(|step| step.parse::<usize>().ok()).map_or(0, |step| step.saturating_sub(1));
    let is_rest = |pair: &&str| !(pair.starts_with("lesson=") || pair.starts_with("step="));
    let rest: Vec<&str> = pairs().filter(is_rest).collect();
    Some((name, step, rest.join("&")))
}

/// What a link to a step says.
pub(super) fn fragment(name: &str, step: usize) -> String {
    format!("lesson={name}&step={}", step + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Language, built_in, speak};

    #[test]
    fn the_lessons_can_be_read_and_are_called_as_the_menu_says() {
        for (name, title, text) in LESSONS {
            let lesson = Lesson::read(text.say().as_bytes()).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(lesson.title, title.say());
            assert!((3..=5).contains(&lesson.steps.len()), "{name} is short");
            assert!(lesson.steps.iter().any(|step| step.question.is_some()), "{name} asks something");
            assert!(lesson.steps[0].sample.is_some(), "{name} begins with a surface that everybody has");
            for step in &lesson.steps {
                assert!(!step.text.is_empty() && step.settings.is_some(), "{name}: {}", step.title);
            }
        }
    }

    #[test]
    fn the_autopilot_is_turned_on_once_and_off_where_the_wire_goes_into_the_hand() {
        let step = |trial: &str| format!("step: {trial}\ntext: What is told.\ntrial: {trial}\n\n");
        let text = format!("lumen lesson 1\ntitle: Steps\n\n{}{}{}", step("autopilot"), step("autopilot"), step("on"));
        let mut lessons = Lessons::default();
        lessons.take(text.as_bytes(), None).unwrap();
        let (state, options) = (State::default(), ViewOptions::default());
        let mut turns = |step: usize, in_trial: bool, has_autopilot: bool| {
            let (are_vessels_open, are_collapses_open) = (false, false);
            let now = Before { state: &state, options, in_trial, has_autopilot, are_vessels_open, are_collapses_open };
            lessons.go(step, now);
            lessons.waiting.iter().filter(|ask| matches!(ask, Ask::Trial(trial::Action::Autopilot))).count()
        };
        assert_eq!(turns(0, false, false), 1, "a trial begins without it");
        assert_eq!(turns(1, true, true), 0, "it goes on");
        assert_eq!(turns(1, true, false), 1);
        assert_eq!(turns(2, true, true), 1, "off");
        assert_eq!(turns(2, true, false), 0);
        assert_eq!(turns(2, false, false), 0);
    }

    #[test]
    fn a_lesson_sets_the_app_the_same_in_all_languages() {
        // What a step sets, and which of its words it has.
        let settings = |step: &Step| {
            let Step { title, text, look, question, sample, settings, view, show, trial } = step.clone();
            let has = [title.is_empty(), text.is_empty(), look.is_empty(), question.is_none()];
            (has, sample, settings, view, show, trial)
        };
        let read = |language| {
            speak(language, built_in(language).unwrap());
            LESSONS.map(|(name, title, text)| {
                let lesson = Lesson::read(text.say().as_bytes());
                let lesson = lesson.unwrap_or_else(|error| panic!("{name} in {language:?}: {error}"));
                assert_eq!(lesson.title, title.say());
                lesson.steps.iter().map(settings).collect::<Vec<_>>()
            })
        };
        let english = read(Language::English);
        for language in Language::ALL {
            assert_eq!(read(language), english, "{language:?}");
        }
        speak(Language::English, &[]);
    }

    #[test]
    fn a_link_names_a_lesson_and_a_step() {
        assert_eq!(in_link("#lesson=shrinkage&step=2"), Some(("shrinkage".to_owned(), 1, String::new())));
        assert_eq!(in_link(&fragment("wire", 2)), Some(("wire".to_owned(), 2, String::new())));
        assert_eq!(
            in_link("lesson=wire&v=1&sample=aorta"),
            Some(("wire".to_owned(), 0, "v=1&sample=aorta".to_owned()))
        );
        assert_eq!(in_link("#v=1&sample=aorta"), None);
    }
}
