//! What a browser gives the app: lines to engines in Workers, gamepads, haptic devices, the file dialog, dropped files,
//! downloads.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::rc::Rc;

use lumen::app::{
    Devices as AppDevices, Engines, Files, Gamepad, Hands, Languages, Listing, OTHER_ENDINGS, Offer, Platform,
    PlatformEvent, Screen, Sharing, Sound, Storage, Store, Tone, Video, Waker,
};
use lumen::engine::scan::ScanLink;
use lumen::engine::trial::TrialLink;
use lumen::engine::{Frame, Link};
use lumen::haptics::service::{DeviceCommand, DeviceStatus};
use lumen::io::{Format, may_be_volume};
use lumen::language::{Language, decimal};
use lumen::say;
use lumen_worker::speech;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;
use web_sys::{File, MediaQueryList};

use crate::hid::page::Devices;
use crate::job::{Pipeline, Trial};
use crate::link::WorkerLink;
use crate::scans::{self, ScanLine};
use crate::texts::AllTexts;
use crate::{address, files, late, store, video};

/// By what the page's field for what is typed is found.
pub(crate) const TYPED: &str = "typed";

/// The browser as a platform.
pub(crate) struct Browser {
    link: WorkerLink<Pipeline>,
    trial: WorkerLink<Trial>,
    scans: ScanLine,
    devices: Devices,
    texts: AllTexts,
    /// Whether those of all languages have been asked for.
    has_asked_for_texts: bool,
    inbox: Inbox,
    /// What came with the file that was opened last.
    next: Vec<File>,
    waker: Waker,
    /// `?embed` at the end of the page's address, which stays as it is while the page does; each frame asks.
    is_embedded: bool,
    /// Whether the user wants less motion, and whether what points is a finger: each frame asks, and asking anew is slow.
    less_motion: Option<MediaQueryList>,
    finger: Option<MediaQueryList>,
    /// Whether a gamepad was ever plugged in, or used, on this page.
    has_gamepad: Rc<Cell<bool>>,
}

type Inbox = Rc<RefCell<VecDeque<News>>>;

/// What has happened.
enum News {
    Event(PlatformEvent),
    /// A file was chosen or dropped, perhaps with others.
    File {
        name: String,
        bytes: Vec<u8>,
        rest: Vec<File>,
    },
    /// The files of a scan were chosen or dropped.
    Scan(Vec<File>),
}

impl Browser {
    /// Starts the engine, that of the trial when it is needed; `ctx` draws again whenever there is news.
    pub(crate) fn new(ctx: &egui::Context) -> Self {
        let waker = Waker::new(ctx);
        let has_gamepad = Rc::new(Cell::new(false));
        wake_at_gamepad(waker.clone(), Rc::clone(&has_gamepad));
        let devices = Devices::new(waker.clone());
        let link = WorkerLink::new(waker.clone());
        let trial = WorkerLink::idle(waker.clone()).with_devices(devices.clone());
        let scans = ScanLine::new(waker.clone());
        let browser = Self {
            link,
            trial,
            scans,
            devices,
            texts: AllTexts::default(),
            has_asked_for_texts: false,
            inbox: Inbox::default(),
            next: Vec::new(),
            waker,
            is_embedded: address::asked("embed").is_some(),
            less_motion: media("(prefers-reduced-motion: reduce)"),
            finger: media("(pointer: coarse)"),
            has_gamepad,
        };
        hear_links(browser.news());
        browser
    }

    /// Where news is put, from wherever it comes.
    fn news(&self) -> impl Fn(PlatformEvent) + Clone + 'static {
        let (inbox, waker) = (Rc::clone(&self.inbox), self.waker.clone());
        move |event| {
            inbox.borrow_mut().push_back(News::Event(event));
            waker.wake();
        }
    }
}

/// Opens the files that `gather` finds.
fn take(inbox: &Inbox, waker: &Waker, gather: impl Future<Output = Result<Gathered, String>> + 'static) {
    let (inbox, waker) = (Rc::clone(inbox), waker.clone());
    spawn_local(async move {
        let news = match gather.await {
            Ok(gathered) => match late::arrived().await {
                Ok(()) => gathered.news().await,
                Err(message) => Err(message),
            },
            Err(message) => Err(message),
        };
        let failed = |message| News::Event(PlatformEvent::Failed { message });
        inbox.borrow_mut().push_back(news.unwrap_or_else(failed));
        waker.wake();
    });
}

/// Files that were chosen or dropped together.
struct Gathered {
    files: Vec<File>,
    /// Whether they were in a folder, which is opened as a scan whatever is in it.
    is_folder: bool,
}

impl Gathered {
    /// The scan in them, or the bytes of the first surface.
    async fn news(mut self) -> Result<News, String> {
        if self.files.is_empty() {
            return Err(say!("scan-folder-empty"));
        }
        let mut is_scan = self.is_folder;
        for file in &self.files {
            if is_scan {
                break;
            }
            is_scan = may_be_volume(&files::head(file).await?);
        }
        if is_scan {
            return Ok(News::Scan(self.files));
        }
        let surface = self.files.iter().position(|file| Format::from_name(&file.name()).is_some());
        let first = self.files.remove(surface.unwrap_or(0));
        Ok(News::File { name: first.name(), bytes: files::read(&first).await?, rest: self.files })
    }
}

/// Tells of the link that the page was opened by, and of each that is put into its address later. What was told is taken
/// out of the address: a reload brings back what was made of it since, and the same link can be followed again.
fn hear_links(tell: impl Fn(PlatformEvent) + 'static) {
    let Some(window) = web_sys::window() else { return };
    let page = window.clone();
    let look = Closure::<dyn Fn()>::new(move || {
        let fragment = page.location().hash().unwrap_or_default();
        if fragment.len() > 1 {
            tell(PlatformEvent::Linked { fragment });
            // Where that is refused, a reload follows the link once more; so it is in a part of another page, which keeps
            // nothing.
            if address::asked("embed").is_none() {
                let _ = without_fragment(&page);
            }
        }
    });
    let look_now: &js_sys::Function = look.as_ref().unchecked_ref();
    // Where it cannot be heard, a link is followed at the next start.
    let _ = look_now.call0(&JsValue::NULL);
    let _ = window.add_event_listener_with_callback("hashchange", look_now);
    // It lives as long as the page.
    look.forget();
}

/// Takes the fragment out of the page's address.
fn without_fragment(page: &web_sys::Window) -> Result<(), JsValue> {
    let location = page.location();
    let address = location.pathname()? + &location.search()?;
    page.history()?.replace_state_with_url(&JsValue::NULL, "", Some(&address))
}

/// Draws again when a gamepad is plugged in: until then it is not asked.
fn wake_at_gamepad(waker: Waker, is_there: Rc<Cell<bool>>) {
    let wake = Closure::<dyn Fn()>::new(move || {
        is_there.set(true);
        waker.wake();
    });
    let window = web_sys::window();
    // Where it cannot be heard there is none.
    let _ = window.map(|w| w.add_event_listener_with_callback("gamepadconnected", wake.as_ref().unchecked_ref()));
    // It lives as long as the page.
    wake.forget();
}

/// Makes a download, or says why not.
fn save(name: &str, bytes: &[u8]) -> Result<(), String> {
    files::save(name, bytes).map_err(|_| say!("scan-not-saved", name = name, mb = decimal(bytes.len() as f64 / 1e6, 1)))
}

/// What the page is told of its user and machine, now and later; where it cannot be asked, nothing.
fn media(query: &str) -> Option<MediaQueryList> {
    web_sys::window()?.match_media(query).ok().flatten()
}

impl Platform for Browser {
    fn enter(&mut self, ctx: &egui::Context) {
        self.waker.enter(ctx);
    }

    fn poll(&mut self) -> Option<PlatformEvent> {
        if self.scans.has_picture() && !std::mem::replace(&mut self.has_asked_for_texts, true) {
            self.texts.fetch_all();
        }
        let news = self.inbox.borrow_mut().pop_front()?;
        Some(match news {
            News::Event(event) => event,
            News::File { name, bytes, rest } => {
                let names: Vec<String> = rest.iter().map(File::name).collect();
                self.next = rest;
                if !names.is_empty() {
                    self.inbox.borrow_mut().push_front(News::Event(PlatformEvent::More { names }));
                }
                PlatformEvent::Chosen { name, bytes }
            }
            News::Scan(files) => PlatformEvent::Scan { files: self.scans.hand_over(&files) },
        })
    }
}

impl Engines for Browser {
    fn link(&mut self) -> &mut dyn Link {
        &mut self.link
    }

    fn trial(&mut self) -> &mut TrialLink {
        &mut self.trial
    }

    fn scans(&mut self) -> Option<&mut ScanLink> {
        Some(&mut self.scans)
    }

    fn memory_limit(&self) -> Option<u64> {
        // Of a program with addresses of 32 bits.
        Some(1 << 32)
    }
}

impl Files for Browser {
    fn choose_file(&mut self, _: &egui::Context) {
        let endings = Format::opened().chain(scans::ENDINGS).chain(OTHER_ENDINGS);
        let accept: Vec<String> = endings.map(|ending| format!(".{ending}")).collect();
        let (inbox, waker) = (Rc::clone(&self.inbox), self.waker.clone());
        let take = move |files| take(&inbox, &waker, async move { Ok(Gathered { files, is_folder: false }) });
        if files::open(&accept.join(","), take).is_err() {
            self.news()(PlatformEvent::Failed { message: say!("scan-no-dialog") });
        }
    }

    fn read_dropped(&mut self, dropped: Vec<egui::DroppedFileHandle>, _: &egui::Context) {
        take(&self.inbox, &self.waker, async move {
            let (files, is_folder) = match files::dropped_folders().await? {
                Some(files) => (files, true),
                None => (dropped.iter().filter_map(|file| file.web_file().cloned()).collect(), false),
            };
            Ok(Gathered { files, is_folder })
        });
    }

    fn open_next(&mut self) {
        let files = std::mem::take(&mut self.next);
        take(&self.inbox, &self.waker, async move { Ok(Gathered { files, is_folder: false }) });
    }

    fn offer_file(&mut self, name: &str, bytes: Vec<u8>, _: &egui::Context) {
        let event = match save(name, &bytes) {
            Ok(()) => PlatformEvent::Saved { message: say!("scan-saved", name = name) },
            Err(message) => PlatformEvent::Failed { message },
        };
        self.news()(event);
    }

    fn offer_pair(&mut self, [first, second]: [Offer; 2], _: &egui::Context) {
        let saved = save(&first.name, &first.bytes).and_then(|()| save(&second.name, &second.bytes));
        let event = match saved {
            Ok(()) => {
                PlatformEvent::Saved { message: say!("scan-both-saved", first = &first.name, second = &second.name) }
            }
            Err(message) => PlatformEvent::Failed { message },
        };
        self.news()(event);
    }
}

impl Video for Browser {
    fn has_video(&self) -> bool {
        video::is_there()
    }

    fn offer_video(&mut self, name: &str, frames: Vec<Frame>, pause_ms: u16) {
        let (name, tell) = (name.to_owned(), self.news());
        spawn_local(async move {
            let saved = match video::recorded(frames, pause_ms).await {
                Ok(bytes) => save(&name, &bytes),
                Err(sentence) => Err(sentence),
            };
            tell(match saved {
                Ok(()) => PlatformEvent::Saved { message: say!("scan-saved", name = name) },
                Err(message) => PlatformEvent::Failed { message },
            });
        });
    }
}

impl Storage for Browser {
    fn store(&mut self) -> Option<&mut dyn Store> {
        (!self.is_embedded()).then_some(self as &mut dyn Store)
    }
}

impl Screen for Browser {
    fn today(&self) -> String {
        let now = js_sys::Date::new_0();
        format!("{:04}-{:02}-{:02}", now.get_full_year(), now.get_month() + 1, now.get_date())
    }

    fn has_attention(&self) -> bool {
        let document = web_sys::window().and_then(|window| window.document());
        // Where it cannot be told, eframe's own word counts.
        document.is_none_or(|document| document.has_focus().unwrap_or(true))
    }

    fn was_left(&self) -> bool {
        self.devices.was_left()
    }

    fn prefers_less_motion(&self) -> bool {
        self.less_motion.as_ref().is_some_and(MediaQueryList::matches)
    }

    fn is_embedded(&self) -> bool {
        self.is_embedded
    }

    fn has_finger(&self) -> bool {
        self.finger.as_ref().is_some_and(MediaQueryList::matches)
    }
}

impl Sharing for Browser {
    fn address(&self) -> Option<String> {
        let address = web_sys::window()?.location().href().ok()?;
        address.split(['?', '#']).next().map(str::to_owned)
    }

    /// `?samples=10000` at the end of the page's address.
    fn sample_triangles(&self) -> Option<u32> {
        address::asked("samples")?.parse().ok()
    }
}

impl Languages for Browser {
    fn locale(&self) -> Option<String> {
        web_sys::window()?.navigator().language()
    }

    fn fetch_texts(&mut self, language: Language) {
        let tell = self.news();
        self.texts.want(language, Box::new(move |texts| tell(PlatformEvent::Texts { language, texts })));
    }

    fn speak(&mut self, language: Language, texts: &str) {
        // Each line keeps one for the Workers to come.
        self.link.speak(speech::value(language, texts));
        self.trial.speak(speech::value(language, texts));
        self.scans.speak(speech::value(language, texts));
        self.devices.change();
    }

    fn show_language(&mut self, tag: &'static str) {
        let Some(document) = web_sys::window().and_then(|window| window.document()) else { return };
        // Without a page there is nobody to read its language, and without graphics there is no field yet.
        let _ = document.document_element().map(|page| page.set_attribute("lang", tag));
        let _ = document.get_element_by_id(TYPED).map(|field| field.set_attribute("aria-label", &say!("scan-typed")));
    }
}

impl Hands for Browser {
    fn gamepad(&self) -> Option<Gamepad> {
        self.has_gamepad.get().then(crate::gamepad::read).flatten()
    }

    fn rumble(&mut self, strength: f64) {
        crate::gamepad::shake(strength);
    }

    fn devices(&mut self) -> Option<&mut dyn AppDevices> {
        Some(self)
    }
}

impl Sound for Browser {
    fn has_sound(&self) -> bool {
        crate::sound::is_there()
    }

    fn sound(&mut self, tone: Tone) {
        crate::sound::play(tone);
    }
}

impl Store for Browser {
    fn text(&self) -> Option<String> {
        store::text()
    }

    fn set_text(&mut self, text: &str) {
        store::set_text(Some(text));
    }

    fn keep_surface(&mut self, name: &str, bytes: &[u8]) {
        store::keep_surface(name, bytes, self.news());
    }

    fn restore_surface(&mut self) {
        store::restore_surface(self.news());
    }

    fn forget_surface(&mut self) {
        store::forget_surface(self.news());
    }

    fn forget(&mut self) {
        store::set_text(None);
        store::forget_surface(self.news());
    }
}

impl AppDevices for Browser {
    fn look(&mut self) -> (Vec<String>, Option<String>) {
        let Listing { names, problem, .. } = self.devices.listing();
        (names, problem)
    }

    fn changed(&mut self) -> Option<Listing> {
        self.devices.changed()
    }

    fn choose(&mut self, number: Option<usize>) {
        // It is served beside the trial's engine.
        if number.is_some() && !self.trial.has_begun() {
            self.trial.restart();
        }
        self.devices.choose(number);
    }

    fn ask(&mut self, command: DeviceCommand) {
        self.devices.ask(command);
    }

    fn status(&self) -> Option<DeviceStatus> {
        self.devices.status()
    }
}
