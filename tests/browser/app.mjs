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

/** The number of triangles shown, as the status bar has it, or null. */
export function shownTriangles(all) {
  const counts = all.map((text) => text.match(/^([\d,]+) triangles$/)).filter(Boolean);
  return counts.length > 0 ? Number(counts.at(-1)[1].replaceAll(",", "")) : null;
}

/** Opens a file (a path, or { name, buffer }) through the browser's own dialog. */
export async function openFile(page, file) {
  const chooser = page.waitForEvent("filechooser");
  await press(page, "button", "Open...");
  const payload = typeof file === "string" ? file : { mimeType: "application/octet-stream", ...file };
  await (await chooser).setFiles(payload);
}

/** Saves in a format ("STL", "PLY", "OBJ", "GLB") and returns the file's name and bytes. */
export async function save(page, format) {
  await press(page, "button", "Save");
  const download = page.waitForEvent("download");
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

/**
 * How many pixels of a view differ from its background. The background is graded from top to bottom, so each row is
 * compared with its own leftmost pixel.
 */
export async function drawnPixels(page, view) {
  // The pointer would light up what is below it.
  await page.mouse.move(2, 2);
  await frames(page, 3);
  const { width, height, data } = await picture(page, view);
  let drawn = 0;
  for (let y = 2; y < height - 2; y++) {
    const ground = (y * width + 2) * 4;
    for (let x = 2; x < width - 2; x++) {
      const at = (y * width + x) * 4;
      const difference = Math.max(...[0, 1, 2].map((c) => Math.abs(data[at + c] - data[ground + c])));
      if (difference > 24) drawn++;
    }
  }
  return drawn;
}
