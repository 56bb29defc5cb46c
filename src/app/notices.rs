//! What the user is told in the bar below, the newest first. What was done is told for as long as it takes to read, anything
//! else until it is taken away or the next file is opened.

use std::time::Duration;

use crate::say;

/// How many are kept.
const MOST: usize = 8;

/// What a notice is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Tells what was done.
    Done,
    /// Asks the user to do something.
    Asks,
    /// Offers to open the files that came with the one that was opened.
    OffersNext,
    /// Tells what went wrong.
    Wrong,
}

/// A sentence for the user.
#[derive(Clone, Debug, PartialEq)]
pub struct Notice {
    /// The sentence.
    pub text: String,
    /// What it is for.
    pub kind: Kind,
    /// How often it was told since it was last taken away.
    times: usize,
    /// Seconds for which it has still to be seen, unless it stands.
    left_s: f64,
}

impl Notice {
    /// The sentence; of what went wrong, how often it did.
    pub fn said(&self) -> String {
        if self.kind == Kind::Wrong && self.times > 1 {
            return say!("app-told-again", text = &self.text, count = self.times);
        }
        self.text.clone()
    }

    /// Whether it stands until it is taken away.
    pub fn stands(&self) -> bool {
        self.kind != Kind::Done
    }
}

/// All that is to be told.
#[derive(Clone, Debug, Default)]
pub struct Notices {
    all: Vec<Notice>,
    /// Until when the newest has been seen without a break, in seconds of the window's clock.
    seen_s: Option<f64>,
}

impl Notices {
    /// Tells this, once where it is told already. What was done before is told after it for what time is left,
    /// unless the user is to do something now.
    pub fn tell(&mut self, kind: Kind, text: &str) {
        let same = self.all.iter().position(|notice| notice.text == text);
        let times = same.map_or(0, |at| self.all.remove(at).times) + 1;
        self.all.retain(|notice| match notice.kind {
            Kind::Done => kind == Kind::Done,
            Kind::OffersNext => kind != Kind::OffersNext,
            Kind::Asks | Kind::Wrong => true,
        });
        if self.all.len() == MOST {
            self.all.remove(0);
        }
        self.seen_s = None;
        self.all.push(Notice { text: text.to_owned(), kind, times, left_s: seconds_to_read(text) });
    }

    /// Tells what nobody has asked for: it waits where something stands.
    pub fn mention(&mut self, text: &str) {
        let standing = self.all.pop_if(|notice| notice.stands());
        self.tell(Kind::Done, text);
        self.all.extend(standing);
    }

    /// What is to be told now.
    pub fn newest(&self) -> Option<&Notice> {
        self.all.last()
    }

    /// Takes away what is told now.
    pub fn take_away(&mut self) {
        self.all.pop();
        self.seen_s = None;
    }

    /// Takes this away, told or not: it is so no longer.
    pub fn withdraw(&mut self, text: &str) {
        if self.newest().is_some_and(|notice| notice.text == text) {
            self.seen_s = None;
        }
        self.all.retain(|notice| notice.text != text);
    }

    /// Takes away everything: what follows is another matter.
    pub fn clear(&mut self) {
        self.all.clear();
    }

    /// Lets what has been read go; `is_seen` says whether the newest is on the screen. Gives the time after which to ask
    /// again, if that is to be.
    pub fn follow(&mut self, now_s: f64, is_seen: bool) -> Option<Duration> {
        let notice = self.all.last_mut().filter(|notice| !notice.stands())?;
        if !is_seen {
            self.seen_s = None;
            return None;
        }
        notice.left_s -= self.seen_s.replace(now_s).map_or(0.0, |seen_s| now_s - seen_s);
        let left = Duration::try_from_secs_f64(notice.left_s).unwrap_or_default();
        if left.is_zero() {
            self.take_away();
        }
        Some(left)
    }
}

/// The time that a sentence is told: 4 s to notice it, and a tenth of a second for each letter, half as fast as is usual.
fn seconds_to_read(text: &str) -> f64 {
    4.0 + 0.1 * text.chars().count() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(notices: &Notices) -> Option<String> {
        notices.newest().map(Notice::said)
    }

    #[test]
    fn what_was_done_is_told_for_as_long_as_it_takes_to_read_and_has_been_seen() {
        let mut notices = Notices::default();
        notices.tell(Kind::Done, &"x".repeat(60));
        assert_eq!(notices.follow(100.0, true), Some(Duration::from_secs(10)));
        assert_eq!(notices.follow(104.0, true), Some(Duration::from_secs(6)));
        // Work hides it for a while, which does not count.
        assert_eq!(notices.follow(105.0, false), None);
        assert_eq!(notices.follow(300.0, true), Some(Duration::from_secs(6)));
        assert_eq!(notices.follow(305.9, true).map(|left| left.as_millis()), Some(100));
        assert_eq!(notices.follow(306.1, true), Some(Duration::ZERO));
        assert_eq!((told(&notices), notices.follow(307.0, true)), (None, None));
    }

    #[test]
    fn what_went_wrong_stands_under_what_is_told_later() {
        let mut notices = Notices::default();
        notices.tell(Kind::Done, "Reading.");
        notices.tell(Kind::Wrong, "b.stl was not read.");
        assert_eq!((notices.follow(0.0, true), notices.follow(1e6, true)), (None, None));
        notices.tell(Kind::Done, "Saved.");
        notices.tell(Kind::Done, "Copied.");
        for (from_s, text) in [(1e6, "Copied."), (2e6, "Saved.")] {
            assert_eq!(told(&notices).as_deref(), Some(text));
            notices.follow(from_s, true);
            notices.follow(from_s + 60.0, true);
        }
        assert_eq!(told(&notices).as_deref(), Some("b.stl was not read."));
        notices.take_away();
        assert_eq!(told(&notices), None, "what was done before is old by now");
    }

    #[test]
    fn what_is_so_no_longer_goes_wherever_it_stands() {
        let mut notices = Notices::default();
        for text in ["Presenting.", "Copied."] {
            notices.tell(Kind::Done, text);
        }
        notices.withdraw("Presenting.");
        assert_eq!(told(&notices).as_deref(), Some("Copied."));
        notices.withdraw("Copied.");
        assert_eq!(told(&notices), None);
    }

    #[test]
    fn what_nobody_has_asked_for_waits_for_what_went_wrong() {
        let mut notices = Notices::default();
        notices.tell(Kind::Wrong, "a.stl was not read.");
        notices.tell(Kind::Wrong, "b.stl was not read.");
        notices.mention("Reduced by 78.1 %.");
        for text in ["b.stl was not read.", "Reduced by 78.1 %.", "a.stl was not read."] {
            assert_eq!(told(&notices).as_deref(), Some(text));
            notices.take_away();
        }
        notices.tell(Kind::Done, "Saved.");
        notices.mention("Reduced by 78.1 %.");
        assert_eq!(told(&notices).as_deref(), Some("Reduced by 78.1 %."));
    }

    #[test]
    fn the_same_again_is_told_once_with_how_often() {
        let mut notices = Notices::default();
        for text in ["a", "b", "a", "a"] {
            notices.tell(Kind::Wrong, text);
        }
        assert_eq!(told(&notices).as_deref(), Some("a (3 times)"));
        for kind in [Kind::Done, Kind::Asks, Kind::OffersNext] {
            notices.tell(kind, "c");
            notices.tell(kind, "c");
            assert_eq!(told(&notices).as_deref(), Some("c"), "{kind:?}");
            notices.take_away();
        }
        notices.take_away();
        assert_eq!(told(&notices).as_deref(), Some("b"));
        for i in 0..20 {
            notices.tell(Kind::Wrong, &i.to_string());
        }
        assert_eq!(notices.all.len(), MOST);
    }
}
