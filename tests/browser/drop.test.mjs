// A file that is dropped on the window is opened as one from the dialog is; of several each is offered after the one before.

import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { basename, join } from "node:path";
import { after, before, test } from "node:test";
import { grouped, openFile, says, settled } from "./app.mjs";
import { COARSE, data, eventually, frames, launch, openApp, press, texts } from "./browser.mjs";

const SEGMENT = join(data, "real/aorta-surface-segment-2.stl");
/** A fact of data/INDEX.md. */
const TRIANGLES = 24_372;

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

test("a file can be dropped on the window", { skip: existsSync(SEGMENT) ? false : `${SEGMENT} is not there` }, async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE });
  await settled(page);
  await press(page, "button", "Surface");
  const file = { name: basename(SEGMENT), base64: (await readFile(SEGMENT)).toString("base64") };
  const dataTransfer = await page.evaluateHandle(({ name, base64 }) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0))], name));
    return transfer;
  }, file);
  const place = { clientX: 640, clientY: 400, bubbles: true, cancelable: true };
  for (const event of ["dragenter", "dragover", "drop"]) {
    await page.dispatchEvent("#lumen", event, { ...place, dataTransfer });
    await frames(page, 2);
  }
  await page.locator("#twins").getByText(grouped(TRIANGLES), { exact: true }).first().waitFor({ state: "attached" });
  const told = await settled(page);
  assert(told.includes(file.name), told.join("\n"));
  assert.deepEqual(wrong, []);
});

test("of several surfaces the first is opened, and the others one after another", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE });
  await settled(page);
  const sheet = (faces) => Buffer.from(`v 0 0 0\nv 50 0 0\nv 0 50 0\nv 50 50 9\n${faces}`);
  const notes = { name: "notes.txt", buffer: Buffer.from("Dear colleague") };
  await openFile(page, [notes, { name: "one.obj", buffer: sheet("f 1 2 3\n") }, { name: "two.obj", buffer: sheet("f 1 2 3\nf 2 4 3\n") }]);
  await says(page, /^notes\.txt and one more came with it\.$/);
  await says(page, /^1 of 1$/);
  await press(page, "button", "Open next");
  await says(page, /^notes\.txt came with it\.$/);
  await says(page, / of 2$/);
  await press(page, "button", "Dismiss");
  await eventually(() => texts(page), (all) => !all.some((text) => text.includes("came with")), { what: "the dismissal" });
  assert.deepEqual(wrong, []);
});
