// The guidewire trial: started, steered to the target by the autopilot, saved. It runs in a Worker of its own.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { atEntry, atRest, fed, settled, workersOn } from "./app.mjs";
import { COARSE, eventually, frames, launch, openApp, press, texts, twin } from "./browser.mjs";

/** How long the autopilot may take. */
const LIMIT = 120_000;

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

/** Waits until some text of the app is as wanted, and returns it. */
const told = (page, pattern, what, timeout = 60_000) =>
  eventually(
    async () => (await texts(page)).find((text) => pattern.test(text)) ?? null,
    (text) => text !== null,
    { timeout, what },
  );

test("the autopilot steers the wire to the target, and the log is saved", { timeout: 4 * LIMIT }, async (t) => {
  // On the surface that users have.
  const { page, wrong } = await openApp(t, browser, { context: COARSE, query: "" });
  await settled(page);
  assert.equal(workersOn(page, "trial").length, 0, "no Worker before it is needed");

  await press(page, "button", "Trial");
  await twin(page, "img", "Fluoroscopy view").waitFor({ state: "attached" });
  await told(page, /^[\d.]+ cm$/, "the wire at the entry");
  assert.equal(workersOn(page, "trial").length, 1, "the trial has a Worker of its own");
  await press(page, "button", "Autopilot");
  const end = await told(page, /^(Success|Failed)/, "the end of the trial", LIMIT);
  t.diagnostic(end);
  assert.match(end, /^Success: the tip arrived/);

  const downloads = [];
  page.on("download", (download) => downloads.push(download));
  // It is at the foot of the panel.
  await page.mouse.move(150, 600);
  await page.mouse.wheel(0, 3000);
  await frames(page, 20);
  await press(page, "button", "Save log");
  await eventually(() => downloads.length, (count) => count === 2, { what: "the log's two files" });
  const files = {};
  for (const download of downloads) {
    const name = download.suggestedFilename();
    files[name.split(".").pop()] = await readFile(await download.path(), "utf8");
  }
  const summary = JSON.parse(files.json);
  assert(Number.isInteger(summary.schema) && summary.schema >= 1, `schema ${summary.schema}`);
  assert.equal(summary.success, true);
  assert(summary.tip_distance_mm <= 2, `${summary.tip_distance_mm} mm from the target`);
  assert.match(summary.notice, /clinical/i);
  // How fast is for the benches (benches/trial.mjs) to say.
  t.diagnostic(`${Math.round(summary.steps_per_second)} steps a second in the Worker`);
  // What a step is, however fast the machine: 2 ms, of one of five kinds.
  assert(Math.abs(summary.time_s - summary.steps * 0.002) < 1e-6, `${summary.time_s} s of ${summary.steps} steps`);
  const kinds = summary.step_kinds;
  assert.equal(kinds.balanced + kinds.unsettled + kinds.braked + kinds.waited + kinds.held, summary.steps);
  assert(summary.unbalanced_share < 0.5, `${summary.unbalanced_share} of the steps are not balanced`);
  const lines = files.csv.trim().split("\n").filter((line) => !line.startsWith("#"));
  assert.match(lines[0], /time_s/);
  assert(lines.length > 100, `${lines.length} samples`);

  await press(page, "button", "Prepare");
  await twin(page, "img", /shaded/i).waitFor({ state: "attached" });
  assert.deepEqual(wrong, []);
});

test("keys drive the wire while they are held", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE });
  await settled(page);
  await press(page, "button", "Trial");
  const start = await atEntry(page);
  await page.keyboard.down("w");
  await fed(page, start);
  await page.keyboard.up("w");
  await atRest(page, 500);
  assert.deepEqual(wrong, []);
});
