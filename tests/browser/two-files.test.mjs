// The open surface beside another file: chosen in the dialog, compared in the Worker, told and saved.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { tube } from "../npm/tube.mjs";
import { openFile, says, settled } from "./app.mjs";
import { COARSE, eventually, frames, launch, openApp, press, twin } from "./browser.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

test("a file is compared with another: a tube with one that is a tenth wider", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE });
  await settled(page);
  await openFile(page, { name: "narrow.stl", buffer: Buffer.from(tube({ radius: 3 })) });
  await says(page, /narrow\.stl/);
  await settled(page);
  await press(page, "button", "Compare");
  // It is there before it has its place.
  const place = () => twin(page, "button", "Compare with a file...").boundingBox();
  const stands = async () => {
    const before = await place();
    await frames(page, 12);
    return before !== null && JSON.stringify(before) === JSON.stringify(await place());
  };
  await eventually(stands, (still) => still, { what: "a button that stands still" });
  const chooser = page.waitForEvent("filechooser");
  await press(page, "button", "Compare with a file...");
  await (await chooser).setFiles({ name: "wide.stl", mimeType: "application/octet-stream", buffer: Buffer.from(tube({ radius: 3.3 })) });
  await twin(page, "button", "Save JSON").waitFor({ timeout: 60_000 });
  await says(page, /The vessel changed by more than 2 %/);
  const download = page.waitForEvent("download");
  await press(page, "button", "Save JSON");
  const told = JSON.parse(await readFile(await (await download).path()));
  assert.deepEqual([told.reference.file, told.surface.file], ["wide.stl", "narrow.stl"]);
  // 0.3 mm by 1 + 0.2 sin 5t, on the mean over t from 0 to 1.
  const mean = 0.3 * (1 + (0.2 * (1 - Math.cos(5))) / 5);
  assert(Math.abs(told.deviation_mm.mean - mean) < 0.015, JSON.stringify(told.deviation_mm));
  assert.equal(told.disclaimer, "Not for clinical decisions.");
  assert.deepEqual(wrong, []);
});
