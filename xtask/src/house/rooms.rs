//! The rooms of the house and their order, as ARCHITECTURE.md has it, and which crates are for which of them alone.

use std::collections::{BTreeMap, BTreeSet};

/// What every room may know, and what knows none.
const BELOW_ALL: [&str; 3] = ["chance", "language", "lib"];

/// Rooms that know none of those below them but these.
const ALONE: [(&str, &[&str]); 1] = [("render", &["mesh"])];

/// Files that know a room which theirs does not.
pub(super) const EXCEPT: [(&str, &[&str]); 2] = [
    // Figures and the pictures of a report are the app's, drawn off screen.
    ("src/cli/figures.rs", &["app", "render"]),
    ("src/cli/pictures.rs", &["app"]),
];

/// Crates of others, and the rooms that alone use them.
const ONLY: [(&[&str], &[&str]); 5] = [
    (&["eframe", "egui", "egui_plot", "egui_wgpu"], &["app", "desktop", "web"]),
    (&["hidapi", "rfd", "tungstenite"], &["desktop"]),
    (&["js_sys", "wasm_bindgen", "wasm_bindgen_futures", "web_sys"], &["web", "web/scan", "web/worker"]),
    (&["rayon"], &["parallel"]),
    (&["wgpu"], &["app", "render", "web"]),
];

/// Whether a file may use a crate of others.
pub(super) fn may_use(file: &str, name: &str) -> bool {
    let only = ONLY.iter().find(|(crates, _)| crates.contains(&name));
    only.is_none_or(|(_, rooms)| rooms.contains(&room(file)))
}

/// For each room those below it.
pub(super) struct Order(BTreeMap<String, BTreeSet<String>>);

impl Order {
    /// What lines such as `mesh < volume < io, vessel` say: each room is above all that stand before a `<`, and above what
    /// these are above.
    pub(super) fn of(lines: &str) -> Self {
        let mut below = BTreeMap::<String, BTreeSet<String>>::new();
        for line in lines.lines() {
            let mut before = BTreeSet::new();
            for level in line.split('<') {
                let rooms: Vec<String> = level.split(',').map(|room| room.trim().to_string()).collect();
                for room in &rooms {
                    below.entry(room.clone()).or_default().extend(before.clone());
                }
                before.extend(rooms);
            }
        }
        while let Some((room, more)) = further(&below) {
            below.entry(room).or_default().extend(more);
        }
        Self(below)
    }

    /// Whether a file may use one of another room.
    pub(super) fn allows(&self, file: &str, used: &str) -> bool {
        let (own, other) = (room(file), room(used));
        if own == other || BELOW_ALL.contains(&other) {
            return own == other || !BELOW_ALL.contains(&own) || other == "lib";
        }
        if EXCEPT.iter().any(|(except, rooms)| *except == file && rooms.contains(&other)) {
            return true;
        }
        if let Some((_, rooms)) = ALONE.iter().find(|(room, _)| *room == own) {
            return rooms.contains(&other);
        }
        self.0.get(own).is_some_and(|below| below.contains(other))
    }
}

/// A room, and those below one below it which are not known to be below it yet.
fn further(below: &BTreeMap<String, BTreeSet<String>>) -> Option<(String, BTreeSet<String>)> {
    below.iter().find_map(|(room, known)| {
        let all: BTreeSet<String> = known.iter().filter_map(|other| below.get(other)).flatten().cloned().collect();
        let more: BTreeSet<String> = all.difference(known).cloned().collect();
        (!more.is_empty()).then(|| (room.clone(), more))
    })
}

/// The room that a file is in: a folder of `src` or a file of it, or what stands before another `src`.
pub(super) fn room(file: &str) -> &str {
    match file.strip_prefix("src/") {
        Some(inside) => inside.split(['/', '.']).next().unwrap_or(inside),
        None => file.split("/src/").next().unwrap_or(file),
    }
}
