//! A tone through a program that plays: PipeWire's, PulseAudio's or ALSA's own, whichever is there and plays, fed with samples
//! through its standard input. So no sound library is linked, which on Linux would be a C library.
//!
//! Samples are handed on as time goes by and 20 ms ahead of it: what waits in the pipe is heard late. The program runs while
//! something sounds and is ended some seconds after; it is killed where it does not end when its input does, or takes none for
//! a quarter of a second: from then on all would be late, by what is in the pipe. One that ends early does not play, and makes
//! way for the next; one that ends later is started again.

use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::lock;
use super::synth::{RATE, Synth};
use crate::app::Tone;

/// Programs that play, the first that is there first: each is told to take bare samples of 16 bits, 48,000 a second, one
/// channel, from its standard input, and to keep few of them waiting.
const PROGRAMS: [(&str, &[&str]); 3] = [
    ("pw-play", &["--raw", "--format=s16", "--rate=48000", "--channels=1", "--latency=20ms", "-"]),
    ("paplay", &["--raw", "--format=s16le", "--rate=48000", "--channels=1", "--latency-msec=20"]),
    (
        "aplay",
        &[
            "--quiet",
            "--file-type=raw",
            "--format=S16_LE",
            "--rate=48000",
            "--channels=1",
            "--period-time=15000",
            "--buffer-time=60000",
        ],
    ),
];

/// How far samples are ahead of the time at which they are to be heard.
const AHEAD: Duration = Duration::from_millis(20);
/// Between two times that samples are handed on.
const LOOK: Duration = Duration::from_millis(5);
/// A delay after which what was not handed on is left out, and not caught up with.
const LATE: Duration = Duration::from_millis(50);
/// How long the program runs on in silence.
const REST: Duration = Duration::from_secs(5);
/// How long it may take to end by itself.
const END: Duration = Duration::from_secs(1);
/// How long it may take to take what it is handed.
const HUNG: Duration = Duration::from_millis(250);
/// One that ends before this does not play.
const EARLY: Duration = Duration::from_millis(500);

/// What sounds, or could.
pub(super) struct Sound {
    programs: Arc<[(PathBuf, &'static [&'static str])]>,
    /// The first of them that was not found to fail.
    first: Arc<AtomicUsize>,
    sounding: Option<Sounding>,
}

/// A thread that hands samples on.
struct Sounding {
    tones: Sender<Tone>,
    player: Arc<Player>,
    thread: JoinHandle<()>,
}

/// What is known of the program by its thread and by whoever does not want to wait for that.
#[derive(Default)]
struct Player {
    /// The program that samples are handed to.
    child: Mutex<Option<Child>>,
    /// Since when it has not taken them.
    since: Mutex<Option<Instant>>,
}

impl Player {
    /// Kills the program where it has hung for too long: its thread hears of it.
    fn end_if_hung(&self) {
        if lock(&self.since).is_some_and(|since| since.elapsed() > HUNG)
            && let Some(child) = &mut *lock(&self.child)
        {
            // One that has ended meanwhile is heard of as well.
            let _ = child.kill();
        }
    }

    /// Ends the program: it has until [`END`] where it is not killed at once.
    fn end(&self, at_once: bool) {
        let has_ended = || lock(&self.child).as_mut().is_none_or(|child| !matches!(child.try_wait(), Ok(None)));
        if (at_once || !is_over(has_ended))
            && let Some(child) = &mut *lock(&self.child)
        {
            // One that has ended meanwhile cannot be killed; either way it is over.
            let _ = child.kill();
            let _ = child.wait();
        }
        *lock(&self.child) = None;
    }
}

impl Sound {
    /// By the programs that the system finds by their names.
    pub(super) fn new() -> Self {
        let path = std::env::var_os("PATH").unwrap_or_default();
        Self::among(&std::env::split_paths(&path).collect::<Vec<_>>())
    }

    fn among(folders: &[PathBuf]) -> Self {
        let found = |name: &str| folders.iter().map(|folder| folder.join(name)).find(|file| file.is_file());
        let programs = PROGRAMS.iter().filter_map(|&(name, arguments)| Some((found(name)?, arguments)));
        Self { programs: programs.collect(), first: Arc::default(), sounding: None }
    }

    /// Whether there is a program that plays, or may.
    pub(super) fn is_there(&self) -> bool {
        self.first.load(Ordering::Relaxed) < self.programs.len()
    }

    /// Sounds so until something else does, or for [`SHAKE_MS`](crate::app::SHAKE_MS).
    pub(super) fn play(&mut self, tone: Tone) {
        if let Some(Sounding { tones, player, .. }) = &self.sounding {
            player.end_if_hung();
            // Nobody hears it where no program plays.
            let _ = tones.send(tone);
            return;
        }
        if !self.is_there() {
            return;
        }
        let (tones, inbox) = channel();
        let player = Arc::default();
        let (programs, first, shared) = (Arc::clone(&self.programs), Arc::clone(&self.first), Arc::clone(&player));
        let thread = thread::spawn(move || sound(&programs, &first, &inbox, &shared));
        // It is there to hear it.
        let _ = tones.send(tone);
        self.sounding = Some(Sounding { tones, player, thread });
    }
}

impl Drop for Sound {
    fn drop(&mut self) {
        let Some(Sounding { tones, player, thread }) = self.sounding.take() else { return };
        drop(tones);
        if !is_over(|| thread.is_finished()) {
            // It takes no samples any more, and so the thread does not come to its end.
            player.end(true);
        }
    }
}

/// Waits until something is over, or for [`END`].
fn is_over(is_over: impl Fn() -> bool) -> bool {
    let until = Instant::now() + END;
    while !is_over() {
        if Instant::now() > until {
            return false;
        }
        thread::sleep(LOOK);
    }
    true
}

/// Hands samples on to the first program that plays, until nobody tells any more what to sound.
fn sound(programs: &[(PathBuf, &[&str])], first: &AtomicUsize, inbox: &Receiver<Tone>, player: &Player) {
    let mut synth = Synth::default();
    let (mut has_rested, mut has_failed) = (false, false);
    // To start a program for silence would be for nothing, but for the first: it is there when it is needed.
    while let Some(tone) = inbox.iter().find(|tone| tone.loudness > 0.0 || !has_rested) {
        synth.set(tone);
        loop {
            let Some((program, arguments)) = programs.get(first.load(Ordering::Relaxed)) else { return };
            let since = Instant::now();
            if feed(program, arguments, &mut synth, inbox, player).is_ok() {
                has_failed = false;
                break;
            }
            player.end(true);
            let lasted = since.elapsed();
            if lasted > REST || !has_failed && lasted > EARLY {
                // It has played: it is started again for the next tone.
                has_failed = true;
                break;
            }
            // It has no server to play through, does not understand what it is told, or hangs each time.
            first.fetch_add(1, Ordering::Relaxed);
            has_failed = false;
        }
        has_rested = true;
    }
}

/// Hands samples on to this one, until nobody tells what to sound, or nothing has sounded for a while.
///
/// # Errors
/// When it does not start or does not take them: what was to sound goes on from there.
fn feed(
    program: &Path,
    arguments: &[&str],
    synth: &mut Synth,
    inbox: &Receiver<Tone>,
    player: &Player,
) -> std::io::Result<()> {
    let mut started = Command::new(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()?;
    let mut input = started.stdin.take().ok_or(ErrorKind::BrokenPipe)?;
    *lock(&player.child) = Some(started);
    let mut hand = |samples: Vec<i16>| {
        *lock(&player.since) = Some(Instant::now());
        let taken = input.write_all(&samples.into_iter().flat_map(i16::to_le_bytes).collect::<Vec<u8>>());
        *lock(&player.since) = None;
        taken
    };
    let count = |time: Duration| (time.as_secs_f64() * f64::from(RATE)) as u64;
    let since = Instant::now();
    let (mut handed, mut sounded) = (0, Instant::now());
    loop {
        let is_left = loop {
            match inbox.try_recv() {
                Ok(tone) => synth.set(tone),
                Err(TryRecvError::Empty) => break false,
                Err(TryRecvError::Disconnected) => break true,
            }
        };
        if !synth.is_silent() {
            sounded = Instant::now();
        }
        if is_left || sounded.elapsed() > REST {
            // A program that takes the last no more has nothing to end.
            let _ = hand(synth.fade());
            drop(input);
            player.end(false);
            return Ok(());
        }
        let now = since.elapsed();
        // What waited in the program has run out; to hand on all that is missing would be late from then on.
        handed = handed.max(count(now.saturating_sub(LATE)));
        let due = count(now + AHEAD).saturating_sub(handed);
        handed += due;
        hand((0..due).map(|_| synth.sample()).collect())?;
        thread::sleep(LOOK);
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::super::synth::tests::{most_step, rises, step};
    use super::*;

    const TONE: Tone = Tone { pitch_hz: 440.0, loudness: 0.2 };

    /// A folder with programs of these names, which are scripts.
    struct Folder(PathBuf);

    impl Folder {
        fn new(name: &str, programs: &[(&str, &str)]) -> Self {
            let folder = std::env::temp_dir().join(format!("lumen-sound-{name}-{}", std::process::id()));
            std::fs::create_dir_all(&folder).unwrap();
            for (program, script) in programs {
                // By a process of its own: a file that this one writes may be held open by what another test starts
                // meanwhile, and cannot be run then.
                let file = folder.join(program);
                let text = format!("#!/bin/sh\ncd '{}'\n{script}\n", folder.display());
                let mut writes = Command::new("sh");
                writes.args(["-c", "printf %s \"$1\" > \"$0\" && chmod +x \"$0\""]).arg(&file).arg(text);
                assert!(writes.status().unwrap().success());
            }
            Self(folder)
        }

        fn sound(&self) -> Sound {
            Sound::among(std::slice::from_ref(&self.0))
        }

        fn read(&self, name: &str) -> Vec<u8> {
            std::fs::read(self.0.join(name)).unwrap_or_default()
        }

        fn samples(&self) -> Vec<i16> {
            self.read("heard").as_chunks().0.iter().map(|&pair| i16::from_le_bytes(pair)).collect()
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            // What is left in the system's own folder for such is no harm.
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }

    /// Plays for so long, as an app does: renewed every 50 ms.
    fn play(sound: &mut Sound, times: u32) {
        for _ in 0..times {
            sound.play(TONE);
            thread::sleep(Duration::from_millis(50));
        }
    }

    /// Waits until something is so, or too long.
    fn until(mut is_so: impl FnMut() -> bool) -> bool {
        (0..1000).any(|_| {
            thread::sleep(LOOK);
            is_so()
        })
    }

    #[test]
    fn the_first_program_that_is_there_hears_the_tone_and_is_ended_with_the_app() {
        let hears = "echo \"$*\" > arguments; cat > heard; echo > over";
        let folder = Folder::new("hears", &[("aplay", "echo > wrong"), ("pw-play", hears)]);
        let mut sound = folder.sound();
        assert!(sound.is_there());
        let since = Instant::now();
        play(&mut sound, 12);
        assert!(until(|| folder.samples().len() > RATE as usize / 4));
        let passed = since.elapsed();
        drop(sound);
        assert!(!folder.read("over").is_empty(), "its input has ended, and it with that");
        let arguments = String::from_utf8(folder.read("arguments")).unwrap();
        assert!(arguments.contains("--raw") && arguments.contains("--rate=48000") && arguments.ends_with("-\n"));
        assert!(folder.read("wrong").is_empty());
        let heard = folder.samples();
        // 440 Hz, in what of the first tone is loud whether it is renewed in time or not.
        let loud = heard.iter().position(|&sample| sample > 3000).unwrap();
        let span = 0.075;
        let cycles = rises(&heard[loud..][..(span * f64::from(RATE)) as usize]) as f64;
        assert!((cycles - 440.0 * span).abs() <= 1.0, "{cycles} in {span} s");
        assert_eq!((heard[0].abs() <= 1, heard.last()), (true, Some(&0)));
        assert!(step(&heard) <= most_step(), "{} of {}", step(&heard), most_step());
        // With the last look's, and those of the fade.
        let most = (passed + AHEAD + 2 * LOOK).as_secs_f64() + 0.01;
        assert!(heard.len() as f64 <= most * f64::from(RATE), "{} samples within {passed:?}", heard.len());
    }

    #[test]
    fn one_that_does_not_play_makes_way_for_the_next_and_at_last_there_is_none() {
        let folder = Folder::new("next", &[("pw-play", "exit 1"), ("paplay", "cat > heard")]);
        let mut sound = folder.sound();
        assert!(until(|| {
            sound.play(TONE);
            folder.samples().len() > 5000
        }));
        assert!(sound.is_there());
        drop(sound);

        let folder = Folder::new("none", &[("aplay", "exit 1")]);
        let mut sound = folder.sound();
        assert!(until(|| {
            sound.play(TONE);
            !sound.is_there()
        }));
        sound.play(TONE);
        assert!(!Folder::new("empty", &[]).sound().is_there());
    }

    #[test]
    fn one_that_takes_nothing_more_is_started_again() {
        // It has room for more than half a second in its pipe.
        let stops = "echo >> starts; head -c 1000 > /dev/null; exec sleep 60";
        let folder = Folder::new("stops", &[("aplay", stops)]);
        let mut sound = folder.sound();
        assert!(until(|| {
            sound.play(TONE);
            folder.read("starts").len() > 1
        }));
        assert!(sound.is_there(), "it has played");
    }

    #[test]
    fn one_that_hangs_each_time_gives_way_to_the_next() {
        let folder =
            Folder::new("gives-way", &[("pw-play", "echo >> starts; exec sleep 60"), ("aplay", "cat > heard")]);
        let mut sound = folder.sound();
        assert!(until(|| {
            sound.play(TONE);
            !folder.samples().is_empty()
        }));
        assert_eq!(folder.read("starts").len(), 2, "it is tried once more, and no more");
    }

    #[test]
    fn one_that_hangs_is_killed() {
        let folder = Folder::new("hangs", &[("paplay", "echo $$ > pid; exec sleep 60")]);
        let mut sound = folder.sound();
        assert!(until(|| {
            sound.play(TONE);
            folder.read("pid").ends_with(b"\n")
        }));
        let since = Instant::now();
        drop(sound);
        assert!(since.elapsed() < Duration::from_secs(5), "{:?}", since.elapsed());
        let pid = String::from_utf8(folder.read("pid")).unwrap();
        let is_there =
            || Command::new("kill").args(["-0", pid.trim()]).stderr(Stdio::null()).status().unwrap().success();
        assert!(until(|| !is_there()), "{pid}");
    }
}
