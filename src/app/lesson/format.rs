//! The file of a lesson: plain text that a teacher can write ([docs/teaching.md](../../../docs/teaching.md)).
//!
//! ```text
//! lumen lesson 1
//! title: Stair-steps
//!
//! step: What a scan leaves
//! text: Each voxel is in the vessel or not.
//! sample: aorta
//! settings: iterations=0 reduction=0
//! ```
//!
//! After the first line each line is `key: value`; a line that begins with a blank goes on with the value above. Empty
//! lines, and those that begin with `#`, are passed over. What stands before the first `step` is of the whole lesson. The
//! keys, and what the app reads of their values, are the same in all languages.

use std::fmt;

use thiserror::Error;

use crate::language::tell;
use crate::phantom::Sample;
use crate::pipeline::settings::Settings;
use crate::render::StandardView;
use crate::say;
use crate::sharing::{LinkError, changed_settings};

/// What stands in the first line.
const FIRST: &str = "lumen lesson ";
/// The version that is read.
const VERSION: &str = "1";
/// The most bytes that are read.
const LONGEST: usize = 100_000;

/// A lesson.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lesson {
    /// What it is called.
    pub title: String,
    /// One after the other; at least one.
    pub steps: Vec<Step>,
}

/// A step of a lesson: what is told, and how the app is set for it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Step {
    /// Its heading.
    pub title: String,
    /// What is told.
    pub text: String,
    /// What to look at; empty where that is not said.
    pub look: String,
    /// A question, to be answered before the answer is shown, and the answer.
    pub question: Option<(String, String)>,
    /// The sample that is opened, unless it is open; `None` leaves what is open.
    pub sample: Option<Sample>,
    /// Settings, beside the defaults; `None` leaves those in force.
    pub settings: Option<Settings>,
    /// From where the surface is seen; `None` leaves the camera.
    pub view: Option<StandardView>,
    /// What is shown.
    pub show: Vec<Show>,
    /// Whether a trial is on.
    pub trial: Trial,
}

/// What a step shows, beside the plain surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Show {
    /// As opened and as it is now in one picture.
    Split,
    /// As opened.
    Before,
    /// Each triangle by itself.
    Flat,
    /// Under light from the side.
    Raking,
    /// Feature edges and open ends.
    Lines,
    /// The deviation as colours.
    Deviation,
    /// The change of calibre as colours.
    Calibre,
    /// The vertex classes as colours.
    Classes,
    /// The table of the vessels.
    Vessels,
    /// The collapses, one by one.
    Collapses,
    /// What the filter lets through, in the second step of the panel.
    Response,
    /// The error against the triangles, in the third.
    Error,
    /// The level made ready for a solver.
    Solver,
}

/// Whether a step has a trial.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Trial {
    /// None.
    #[default]
    Off,
    /// With the wire in the hand.
    Association,
    /// With the autopilot.
    Autopilot,
}

/// Why a lesson cannot be read.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum LessonError {
    /// The first line is another.
    First,
    /// Not text, or too much of it.
    Text,
    /// Nothing to teach.
    Empty,
    /// A line is not `key: value`, or its key has no meaning there.
    Key {
        /// Its number, from 1.
        line: usize,
        /// The key, cut to what can be shown.
        key: String,
    },
    /// A value that a key cannot have.
    Value {
        /// The number of its line, from 1.
        line: usize,
        /// The key.
        key: String,
        /// The value, cut to what can be shown.
        value: String,
    },
    /// Settings that cannot be.
    Settings {
        /// The number of its line, from 1.
        line: usize,
        /// What is wrong with them.
        error: LinkError,
    },
    /// A question without an answer, or the other way round.
    HalfQuestion(String),
}

impl fmt::Display for LessonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&match self {
            Self::First => say!("lesson-not-first", first = format!("{FIRST}{VERSION}")),
            Self::Text => say!("lesson-not-text"),
            Self::Empty => say!("lesson-no-step"),
            Self::Key { line, key } => say!("lesson-unknown-key", line = line.to_string(), key = key),
            Self::Value { line, key, value } => {
                say!("lesson-wrong-value", line = line.to_string(), key = key, value = value)
            }
            Self::Settings { line, error } => of_settings(*line, error),
            Self::HalfQuestion(step) => say!("lesson-half-question", step = step),
        })
    }
}

impl Lesson {
    /// Reads a lesson.
    ///
    /// # Errors
    /// The first line that is not understood.
    pub fn read(bytes: &[u8]) -> Result<Self, LessonError> {
        let text = std::str::from_utf8(bytes).ok().filter(|text| text.len() <= LONGEST).ok_or(LessonError::Text)?;
        let text = text.trim_start_matches('\u{feff}');
        let mut lines = (1..).zip(text.lines());
        let first = lines.next().map_or("", |(_, line)| line).trim_end();
        if first.strip_prefix(FIRST) != Some(VERSION) {
            return Err(LessonError::First);
        }
        let mut lesson = Self::default();
        for Entry { line, key, value } in entries(lines)? {
            lesson.take(line, key, &value)?;
        }
        if lesson.steps.is_empty() {
            return Err(LessonError::Empty);
        }
        let is_half =
            |step: &&Step| step.question.as_ref().is_some_and(|(ask, answer)| ask.is_empty() || answer.is_empty());
        match lesson.steps.iter().find(is_half) {
            Some(step) => Err(LessonError::HalfQuestion(shown(&step.title))),
            None => Ok(lesson),
        }
    }

    fn take(&mut self, line: usize, key: &str, value: &str) -> Result<(), LessonError> {
        let unknown = || LessonError::Key { line, key: shown(key) };
        let wrong = || LessonError::Value { line, key: key.to_owned(), value: shown(value) };
        if key == "step" {
            self.steps.push(Step { title: value.to_owned(), ..Step::default() });
            return Ok(());
        }
        let Some(step) = self.steps.last_mut() else {
            return if key == "title" {
                value.clone_into(&mut self.title);
                Ok(())
            } else {
                Err(unknown())
            };
        };
        match key {
            "text" => value.clone_into(&mut step.text),
            "look" => value.clone_into(&mut step.look),
            "ask" => value.clone_into(&mut step.question.get_or_insert_default().0),
            "answer" => value.clone_into(&mut step.question.get_or_insert_default().1),
            "sample" => step.sample = Some(value.parse().map_err(|_| wrong())?),
            "settings" => {
                let pairs: Option<Vec<(&str, &str)>> =
                    value.split_whitespace().map(|pair| pair.split_once('=')).collect();
                let changed = changed_settings(&Settings::default(), &pairs.ok_or_else(wrong)?);
                step.settings = Some(changed.map_err(|error| LessonError::Settings { line, error })?);
            }
            "view" => {
                step.view = Some(match value {
                    "anterior" => StandardView::Anterior,
                    "posterior" => StandardView::Posterior,
                    "left" => StandardView::Left,
                    "right" => StandardView::Right,
                    "superior" => StandardView::Superior,
                    "inferior" => StandardView::Inferior,
                    _ => return Err(wrong()),
                });
            }
            "show" => step.show = value.split_whitespace().map(Show::named).collect::<Option<_>>().ok_or_else(wrong)?,
            "trial" => {
                step.trial = match value {
                    "off" => Trial::Off,
                    "on" => Trial::Association,
                    "autopilot" => Trial::Autopilot,
                    _ => return Err(wrong()),
                }
            }
            _ => return Err(unknown()),
        }
        Ok(())
    }
}

impl Show {
    fn named(word: &str) -> Option<Self> {
        Some(match word {
            "split" => Self::Split,
            "before" => Self::Before,
            "flat" => Self::Flat,
            "raking" => Self::Raking,
            "lines" => Self::Lines,
            "deviation" => Self::Deviation,
            "calibre" => Self::Calibre,
            "classes" => Self::Classes,
            "vessels" => Self::Vessels,
            "collapses" => Self::Collapses,
            "response" => Self::Response,
            "error" => Self::Error,
            "solver" => Self::Solver,
            _ => return None,
        })
    }
}

/// A key with its value, put together from its lines.
struct Entry<'a> {
    line: usize,
    key: &'a str,
    value: String,
}

fn entries<'a>(lines: impl Iterator<Item = (usize, &'a str)>) -> Result<Vec<Entry<'a>>, LessonError> {
    let mut entries: Vec<Entry<'a>> = Vec::new();
    for (line, text) in lines {
        let unknown = || LessonError::Key { line, key: shown(text) };
        if text.trim().is_empty() || text.starts_with('#') {
            continue;
        }
        if text.starts_with([' ', '\t']) {
            let entry = entries.last_mut().ok_or_else(unknown)?;
            entry.value.push(' ');
            entry.value.push_str(text.trim());
        } else {
            let (key, value) = text.split_once(':').ok_or_else(unknown)?;
            entries.push(Entry { line, key: key.trim_end(), value: value.trim().to_owned() });
        }
    }
    Ok(entries)
}

/// What is wrong with the settings of a line, which are written as in a link, where there is no link.
fn of_settings(line: usize, error: &LinkError) -> String {
    let line = line.to_string();
    match error {
        LinkError::Twice(name) => say!("lesson-settings-twice", line = line, name = name),
        LinkError::Unknown(name) => say!("lesson-settings-unknown", line = line, name = name),
        LinkError::Value { key, value } => say!("lesson-settings-value", line = line, key = *key, value = value),
        LinkError::Range(error) => say!("lesson-settings-range", line = line, error = tell(error)),
        // The last two are of a whole link.
        LinkError::Long(_) | LinkError::Newer { .. } | LinkError::Missing(_) => {
            say!("lesson-settings-long", line = line)
        }
    }
}

/// The beginning of what may be long.
fn shown(text: &str) -> String {
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::settings::Target;

    const TEXT: &str = "lumen lesson 1\n\
        title: An own one\n\
        # A remark of the teacher's.\n\n\
        step: The first\n\
        text: So it begins,\n  and goes on.\n\
        sample: coronary\n\
        settings: pass-band=0.1 triangles=5000\n\
        view: left\n\
        show: classes lines\n\
        ask: Why?\n\
        answer: Because.\n\
        step: The second\n\
        trial: autopilot\n";

    #[test]
    fn what_a_teacher_writes_is_read() {
        let lesson = Lesson::read(TEXT.as_bytes()).unwrap();
        assert_eq!((lesson.title.as_str(), lesson.steps.len()), ("An own one", 2));
        let [first, second] = &lesson.steps[..] else { panic!("two steps") };
        assert_eq!(first.text, "So it begins, and goes on.");
        assert_eq!((first.sample, first.view), (Some(Sample::Coronary), Some(StandardView::Left)));
        let settings = first.settings.clone().unwrap();
        assert_eq!((settings.smoothing.pass_band, settings.target), (0.1, Target::Triangles(5000)));
        assert_eq!(settings.decimation, Settings::default().decimation, "the rest is as by default");
        assert_eq!(first.show, [Show::Classes, Show::Lines]);
        assert_eq!(first.question, Some(("Why?".to_owned(), "Because.".to_owned())));
        assert_eq!((second.trial, second.settings.as_ref(), &*second.title), (Trial::Autopilot, None, "The second"));
        // As an editor on Windows saves it.
        let windows = format!("\u{feff}{}", TEXT.replace('\n', "\r\n"));
        assert_eq!(Lesson::read(windows.as_bytes()), Ok(lesson));
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let said = |text: &str| Lesson::read(text.as_bytes()).unwrap_err().to_string();
        assert_eq!(said(""), "This is no lesson: its first line has to be \"lumen lesson 1\".");
        assert_eq!(said("lumen lesson 2\n"), said(""));
        assert_eq!(Lesson::read(&[0xff; 9]), Err(LessonError::Text));
        assert_eq!(Lesson::read(&[b'a'; 200_000]), Err(LessonError::Text));
        assert_eq!(said("lumen lesson 1\ntitle: Bare\n"), "The lesson has no step.");
        assert_eq!(said("lumen lesson 1\nview: left\n"), "Line 2 of the lesson is not understood: \"view\".");
        assert_eq!(said("lumen lesson 1\n  text\n"), "Line 2 of the lesson is not understood: \"  text\".");
        let with = |line: &str| said(&format!("lumen lesson 1\nstep: A\n{line}\n"));
        assert_eq!(with("colour: red"), "Line 3 of the lesson is not understood: \"colour\".");
        assert_eq!(with("view: front"), "Line 3 of the lesson: \"front\" is no value for \"view\".");
        assert_eq!(with("show: classes x"), "Line 3 of the lesson: \"classes x\" is no value for \"show\".");
        assert_eq!(with("settings: pass-band"), "Line 3 of the lesson: \"pass-band\" is no value for \"settings\".");
        assert!(with("settings: pass-band=9").contains("must lie between"), "{}", with("settings: pass-band=9"));
        let unknown = "Line 3 of the lesson: It says \"passband\", which means nothing here.";
        assert_eq!(with("settings: passband=1"), unknown);
        assert!(with("settings: pass-band=1&v=1").starts_with("Line 3"));
        assert!(with("ask: Why?").contains("without an answer"));
    }
}
