// What the tests know about the app: the names of its controls and how to read what it shows. They are in one place,
// so that renaming a control is one change.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { eventually, frames, picture, press, texts, twin } from "./browser.mjs";

export const REDUCTION = "Reduction";

/** The two views, as the page names them. */
export const views = {
  shaded: (page) => twin(page, "img", /shaded/i),
  wireframe: (page) => twin(page, "img", /wireframe/i),
};

/** A whole number as the app writes it. */
export const grouped = (number) => number.toLocaleString("en");

/** Waits until nothing is being computed and a result is shown; returns all the text there is. */
export async function settled(page, timeout = 120_000) {
  let calm = 0;
  return eventually(
    async () => ({ busy: await twin(page, "button", "Cancel").count(), all: await texts(page) }),
    // A result can be followed by the next piece of work a moment later.
    ({ busy, all }) => (calm = !busy && shownTriangles(all) !== null ? calm + 1 : 0) >= 6,
    { timeout, what: "the result" },
  ).then(({ all }) => all);
}

/** Waits until the sample is shown and all that is kept for a time without a network is: nothing is loaded after that. */
export async function loaded(page) {
  await settled(page);
  await page.evaluate(async () => void (await navigator.serviceWorker.ready));
}

/** The number of triangles shown, as the panel's result has it ("Triangles", "6,698 of 66,982"), or null. */
export function shownTriangles(all) {
  const row = all.findIndex((text, i) => text === "Triangles" && /^[\d,]+ of [\d,]+$/.test(all[i + 1] ?? ""));
  return row < 0 ? null : Number(all[row + 1].split(" of ")[0].replaceAll(",", ""));
}

/** The Workers on a job ("pipeline", "trial", "scan"). */
export const workersOn = (page, job) => page.workers().filter((worker) => worker.url().endsWith(`#${job}`));

/** An octahedron of 30 mm as an OBJ file: eight triangles. */
export const OCTAHEDRON = {
  name: "octahedron.obj",
  buffer: Buffer.from(
    "v 30 0 0\nv -30 0 0\nv 0 30 0\nv 0 -30 0\nv 0 0 30\nv 0 0 -30\n" +
      "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n",
  ),
};

/** Opens a file (a path, or { name, buffer }), or several, through the browser's own dialog. */
export async function openFile(page, file) {
  const chooser = page.waitForEvent("filechooser");
  await press(page, "button", "Open...");
  const payload = (file) => (typeof file === "string" ? file : { mimeType: "application/octet-stream", ...file });
  await (await chooser).setFiles(Array.isArray(file) ? file.map(payload) : payload(file));
}

/** Saves in a format ("STL", "PLY", "OBJ", "GLB") and returns the file's name and bytes. */
export async function save(page, format, timeout = 30_000) {
  await press(page, "button", "Save");
  const download = page.waitForEvent("download", { timeout });
  await press(page, "menuitem", `${format}...`);
  const file = await download;
  return { name: file.suggestedFilename(), bytes: await readFile(await file.path()) };
}

/** Triangles in a binary STL file, from its length and from its header, which have to agree. */
export function stlTriangles(bytes) {
  const count = bytes.readUInt32LE(80);
  assert.equal(bytes.length, 84 + 50 * count);
  return count;
}

/** Looks from a side ("Anterior", "Superior", ...; "Front", "Top", ... where the file does not know the patient's). */
export async function lookFrom(page, side) {
  await press(page, "button", "View");
  await press(page, "menuitem", side);
  // The menu has to be gone from the picture.
  await twin(page, "menuitem", side).waitFor({ state: "detached" });
}

/** Pixels of a view that are not background: the silhouette of what is shown. */
export const silhouette = (page, view) => differing(page, view, () => 24);

/**
 * Pixels of a view that are as dark as an edge. Where lines are far apart most pixels are only grazed by one, so a
 * pixel counts from two thirds of the strongest difference.
 */
export const edgePixels = (page, view) => differing(page, view, (strongest) => (strongest * 2) / 3);

/**
 * How many points differ from the background by more than `from(strongest difference)`, of 255. The background is
 * graded from top to bottom, so each row is compared with its own leftmost pixel.
 */
async function differing(page, view, from) {
  // The pointer would light up what is below it.
  await page.mouse.move(2, 2);
  await frames(page, 3);
  const { width, height, data } = await picture(page, view);
  const differences = [];
  for (let y = 2; y < height - 2; y++) {
    const ground = (y * width + 2) * 4;
    for (let x = 2; x < width - 2; x++) {
      const at = (y * width + x) * 4;
      differences.push(Math.max(...[0, 1, 2].map((c) => Math.abs(data[at + c] - data[ground + c]))));
    }
  }
  const least = from(differences.reduce((strongest, it) => Math.max(strongest, it), 0));
  // In points, however many pixels a point has.
  const scale = await page.evaluate(() => devicePixelRatio);
  return differences.filter((difference) => difference > least).length / scale ** 2;
}

/** Pixels of a picture that are not as the ones at its left edge, in points, however many pixels a point has. */
export async function drawn(page, control) {
  const { width, height, data } = await picture(page, control);
  const scale = await page.evaluate(() => devicePixelRatio);
  const margin = Math.ceil(8 * scale);
  let count = 0;
  for (let y = margin; y < height - margin; y++) {
    const ground = (y * width + margin) * 4;
    for (let x = margin; x < width - margin; x++) {
      const at = (y * width + x) * 4;
      if (Math.abs(data[at] - data[ground]) + Math.abs(data[at + 2] - data[ground + 2]) > 48) count++;
    }
  }
  return count / scale ** 2;
}

/** Waits until the app says something. */
export const says = (page, pattern, more = {}) =>
  eventually(() => texts(page), (all) => all.some((text) => pattern.test(text)), { what: `a sentence like ${pattern}`, ...more });

/** How much wire is in, in cm, as the trial's panel has it, or null. */
export async function inserted(page) {
  const text = (await texts(page)).find((text) => /^[\d.]+ cm$/.test(text));
  return text ? Number(text.split(" ")[0]) : null;
}

/** Waits until a trial has begun; how much wire is in at the entry, in cm. */
export const atEntry = (page) => eventually(() => inserted(page), (cm) => cm !== null, { timeout: 60_000, what: "the wire at the entry" });

/** Waits until so many more centimetres of wire are in than `start`. */
export const fed = (page, start, more = 1) => eventually(() => inserted(page), (cm) => cm >= start + more, { what: `${more} cm of wire` });

/** Waits until the wire stands, for `ms`. */
export async function atRest(page, ms) {
  let last = -1;
  const stands = async () => {
    const now = await inserted(page);
    const rests = now === last;
    last = now;
    if (rests) await new Promise((later) => setTimeout(later, ms));
    return rests && (await inserted(page)) === now;
  };
  return eventually(stands, (rests) => rests, { what: "the wire at rest" });
}
