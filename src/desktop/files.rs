//! File dialogs and files, each on a thread of its own so that no frame waits for a disk.

use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Mutex};
use std::thread;

use rfd::FileDialog;

use super::scans::{self, Disk};
use super::{lock, speech};
use crate::app::{OTHER_ENDINGS, Offer, PlatformEvent, Waker};
use crate::io::Format;
use crate::say;

/// The files that came with the one that was read last.
#[derive(Clone, Default)]
pub(super) struct Next(Arc<Mutex<Vec<PathBuf>>>);

impl Next {
    /// Takes them, in their order.
    pub(super) fn take(&self) -> Vec<PathBuf> {
        std::mem::take(&mut lock(&self.0))
    }
}

/// Where files are read from, and who is told.
pub(super) struct Reader {
    pub(super) disk: Disk,
    pub(super) next: Next,
    pub(super) events: Sender<PlatformEvent>,
    pub(super) waker: Waker,
}

impl Reader {
    fn read(&self, paths: &[PathBuf]) {
        let (event, rest) = load(paths, &self.disk);
        send(&self.events, &self.waker, event);
        let names: Vec<String> = rest.iter().map(|path| name(path)).collect();
        *lock(&self.next.0) = rest;
        if !names.is_empty() {
            send(&self.events, &self.waker, PlatformEvent::More { names });
        }
    }
}

/// Lets the user choose files and reads them.
pub(super) fn choose(reader: Reader) {
    thread::spawn(move || {
        speech::follow();
        let extensions: Vec<&str> = Format::opened().chain(scans::ENDINGS).chain(OTHER_ENDINGS).collect();
        let dialog = FileDialog::new()
            .add_filter(say!("app-dialog-opened"), &extensions)
            .add_filter(say!("app-dialog-all"), &["*"]);
        if let Some(paths) = dialog.pick_files() {
            reader.read(&paths);
        }
    });
}

/// Reads a file, or the scan in several or in a folder.
pub(super) fn read(paths: Vec<PathBuf>, reader: Reader) {
    thread::spawn(move || {
        speech::follow();
        reader.read(&paths);
    });
}

/// Finds the scan in some files, or reads the first of them; what of them is left for later.
fn load(paths: &[PathBuf], disk: &Disk) -> (PlatformEvent, Vec<PathBuf>) {
    // The files of a series often have no ending at all.
    let is_surface = |path: &PathBuf| Format::from_name(&path.to_string_lossy()).is_some();
    let surface = paths.iter().position(is_surface).filter(|_| paths.len() > 1);
    if surface.is_none() {
        match disk.files(paths) {
            Ok(Some(files)) => return (PlatformEvent::Scan { files }, Vec::new()),
            Ok(None) => {}
            Err(message) => return (PlatformEvent::Failed { message }, Vec::new()),
        }
    }
    let mut rest = paths.to_vec();
    if rest.is_empty() {
        return (PlatformEvent::Failed { message: say!("app-no-file") }, rest);
    }
    let first = rest.remove(surface.unwrap_or(0));
    (load_one(&first), rest)
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).display().to_string()
}

fn load_one(path: &Path) -> PlatformEvent {
    let name = name(path);
    match fs::read(path) {
        Ok(bytes) => PlatformEvent::Chosen { name, bytes },
        Err(error) => PlatformEvent::Failed { message: say!("app-not-read", name = name, error = error.to_string()) },
    }
}

/// Lets the user choose where to and writes a file there.
pub(super) fn save(name: String, bytes: Vec<u8>, events: Sender<PlatformEvent>, waker: Waker) {
    thread::spawn(move || {
        speech::follow();
        let Some(path) = FileDialog::new().set_file_name(&name).save_file() else { return };
        send(
            &events,
            &waker,
            match fs::write(&path, bytes) {
                Ok(()) => PlatformEvent::Saved { message: say!("app-saved", name = path.display().to_string()) },
                Err(error) => {
                    let (name, error) = (path.display().to_string(), error.to_string());
                    PlatformEvent::Failed { message: say!("app-not-written", name = name, error = error) }
                }
            },
        );
    });
}

/// Lets the user choose where the first file goes, and writes both there.
pub(super) fn save_pair(pair: [Offer; 2], events: Sender<PlatformEvent>, waker: Waker) {
    thread::spawn(move || {
        speech::follow();
        if let Some(path) = FileDialog::new().set_file_name(&pair[0].name).save_file() {
            send(&events, &waker, write_pair(path, &pair));
        }
    });
}

/// Writes the first file to `path`, with its own ending where that has another, and the second beside it under the same
/// stem. Over what is there already goes only what the user has named.
fn write_pair(path: PathBuf, [first, second]: &[Offer; 2]) -> PlatformEvent {
    let ending = |offer: &Offer| Path::new(&offer.name).extension().unwrap_or_default().to_owned();
    let is_named = path.extension().is_some_and(|given| given.eq_ignore_ascii_case(ending(first)));
    let chosen = if is_named { path } else { PathBuf::from(joined(path.as_os_str(), &ending(first))) };
    let beside = chosen.with_extension(ending(second));
    let failed = |path: &Path, error: &io::Error| {
        let name = path.display().to_string();
        let message = if error.kind() == io::ErrorKind::AlreadyExists {
            say!("app-pair-there-already", name = name)
        } else {
            say!("app-pair-not-written", name = name, error = error.to_string())
        };
        PlatformEvent::Failed { message }
    };
    if let Err(error) = write_new(&beside, &second.bytes) {
        return failed(&beside, &error);
    }
    let written = if is_named { fs::write(&chosen, &first.bytes) } else { write_new(&chosen, &first.bytes) };
    if let Err(error) = written {
        // It was made a moment ago; what it belongs to is not there.
        let _ = fs::remove_file(&beside);
        return failed(&chosen, &error);
    }
    let folder = chosen.parent().unwrap_or(Path::new("")).display().to_string();
    let message = say!("app-pair-saved", first = name(&chosen), second = name(&beside), folder = folder);
    PlatformEvent::Saved { message }
}

fn joined(name: &OsStr, ending: &OsStr) -> OsString {
    let mut joined = name.to_owned();
    joined.push(".");
    joined.push(ending);
    joined
}

/// Writes a file that is not there yet; one that does not come to its end is taken away again.
fn write_new(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let written = File::create_new(path)?.write_all(bytes);
    if written.is_err() {
        let _ = fs::remove_file(path);
    }
    written
}

fn send(events: &Sender<PlatformEvent>, waker: &Waker, event: PlatformEvent) {
    // The window may have been closed meanwhile; then nobody needs to know.
    if events.send(event).is_ok() {
        waker.wake();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair() -> [Offer; 2] {
        let offer = |name: &str, text: &str| Offer { name: name.to_owned(), bytes: text.into() };
        [offer("aorta-trial.csv", "a,b"), offer("aorta-trial.json", "{}")]
    }

    fn message(event: PlatformEvent) -> String {
        match event {
            PlatformEvent::Saved { message } | PlatformEvent::Failed { message } => message,
            PlatformEvent::Chosen { name, .. } => name,
            PlatformEvent::Scan { .. } => "a scan".to_owned(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn of_several_surfaces_the_first_is_opened_and_the_others_follow() {
        let path = |name: &str| Path::new("nowhere").join(name);
        let paths = ["notes.txt", "a.stl", "b.VTP"].map(path);
        let (first, rest) = load(&paths, &Disk::default());
        assert!(message(first).starts_with("a.stl could not be read"), "a surface is no file of a scan");
        assert_eq!(rest, ["notes.txt", "b.VTP"].map(path));
        let (second, rest) = load(&rest, &Disk::default());
        assert!(message(second).starts_with("b.VTP could not be read"));
        assert_eq!(rest, ["notes.txt"].map(path));
    }

    #[test]
    fn the_second_file_goes_beside_the_first_and_over_nothing_that_was_not_named() {
        let folder = std::env::temp_dir().join(format!("lumen-files-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let at = |name: &str| folder.join(name);
        let read = |name: &str| fs::read_to_string(at(name)).unwrap_or_default();
        let save = |name: &str| message(write_pair(at(name), &pair()));
        assert_eq!(save("run.2.csv"), format!("run.2.csv and run.2.json were saved in {}.", folder.display()));
        assert_eq!((read("run.2.csv").as_str(), read("run.2.json").as_str()), ("a,b", "{}"));

        fs::write(at("other.json"), "mine").unwrap();
        let refused =
            |name: &str| format!("Nothing was saved: {} is there already. Choose another name.", at(name).display());
        assert_eq!(save("other.csv"), refused("other.json"));
        assert_eq!((read("other.json").as_str(), at("other.csv").exists()), ("mine", false));

        fs::write(at("named.CSV"), "older").unwrap();
        save("named.CSV");
        assert_eq!(read("named.CSV"), "a,b", "the dialog has asked");

        assert!(save("bare").starts_with("bare.csv and bare.json were saved"));
        fs::remove_file(at("bare.json")).unwrap();
        assert_eq!(save("bare"), refused("bare.csv"));
        assert!(!at("bare.json").exists(), "neither is left alone");
        assert!(save("log.json").starts_with("log.json.csv and log.json.json were saved"));
        fs::remove_dir_all(&folder).unwrap();
    }
}
