// The page for the record, saved in the browser and read by others.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { inflateSync } from "node:zlib";
import { settled } from "./app.mjs";
import { COARSE, launch, openApp, press, twin } from "./browser.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

/** The text that a PDF shows: the strings of its unpacked pages, in their order. */
function textOf(bytes) {
  const raw = bytes.toString("latin1");
  const pages = [];
  for (const { index } of raw.matchAll(/>>\s*stream\r?\n/g)) {
    const head = raw.slice(raw.lastIndexOf("obj", index), index);
    if (!head.includes("/Subtype /Image") && head.includes("/FlateDecode")) {
      const start = raw.indexOf("stream", index) + 7;
      pages.push(inflateSync(bytes.subarray(start), { finishFlush: 2 }).toString("latin1"));
    }
  }
  return pages.flatMap((page) => [...page.matchAll(/\(((?:\\.|[^\\)])*)\) Tj/g)].map((found) => found[1])).join(" ");
}

/** Saves what a button of the report's sheet names and returns the file's name and bytes. */
async function saved(page, item) {
  await press(page, "button", "Save");
  await press(page, "menuitem", "Report...");
  const download = page.waitForEvent("download");
  await press(page, "button", item);
  const file = await download;
  const path = await file.path();
  return { name: file.suggestedFilename(), bytes: await readFile(path) };
}

test("a report is saved as PDF, whose text can be searched, and as a page that needs nothing else", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE, query: "" });
  await settled(page);
  // The vessels come last.
  await twin(page, "button", "Show vessels").and(page.locator(":not([aria-disabled=true])")).waitFor();

  const pdf = await saved(page, "Save as PDF...");
  assert.equal(pdf.name, "abdominal-aorta-report.pdf");
  const text = textOf(pdf.bytes);
  for (const part of ["Safe to simulate on", "Not for clinical decisions", "branch 1", "pass band 0.01", "As opened"]) {
    assert(text.includes(part), `${part} in ${text}`);
  }

  const html = await saved(page, "Save as web page...");
  assert.equal(html.name, "abdominal-aorta-report.html");
  const other = await browser.newPage();
  t.after(() => other.close());
  const asked = [];
  other.on("request", (request) => asked.push(request.url()));
  await other.setContent(html.bytes.toString());
  assert.deepEqual(asked.filter((url) => !url.startsWith("data:")), []);
  assert.equal(await other.locator("img").count(), 4);
  assert.equal(await other.locator("script").count(), 0);
  const drawn = await other.locator("img").evaluateAll((images) => images.every((image) => image.naturalWidth > 0));
  assert(drawn, "the pictures are pictures");
  assert.deepEqual(wrong, []);
});
