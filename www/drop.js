// What was dropped on the page, of which egui is told the files alone: folders are looked into here (web/src/files.rs
// asks).

let dropped = [];
// Before the canvas hears of it; once the event has passed, what was dropped cannot be asked for any more.
addEventListener(
  "drop",
  ({ dataTransfer }) => {
    dropped = Array.from(dataTransfer?.items ?? [], (item) => item.webkitGetAsEntry?.()).filter(Boolean);
  },
  { capture: true },
);

const asked = (ask) => new Promise((resolve, reject) => ask(resolve, reject));

/** The files in a folder, but those in further folders. */
async function within(folder) {
  const [reader, entries] = [folder.createReader(), []];
  for (;;) {
    // They come by the hundred.
    const more = await asked((resolve, reject) => reader.readEntries(resolve, reject));
    if (more.length === 0) return entries.filter((entry) => entry.isFile);
    entries.push(...more);
  }
}

globalThis.lumenDrop = {
  /** The files in what was dropped, by name, or null where there is no folder among it. */
  async folders() {
    if (!dropped.some((entry) => entry.isDirectory)) return null;
    const found = await Promise.all(dropped.map((entry) => (entry.isDirectory ? within(entry) : [entry])));
    const entries = found.flat().sort((a, b) => (a.name < b.name ? -1 : 1));
    return Promise.all(entries.map((entry) => asked((resolve, reject) => entry.file(resolve, reject))));
  },
};
