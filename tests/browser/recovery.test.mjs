// After a reload, and after a panic: what comes back by itself, what only where the user has asked for it, and what of a
// link is told.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { REDUCTION, openFile, settled, shownTriangles, stlTriangles } from "./app.mjs";
import { COARSE, dragTo, eventually, launch, openApp, press, program, started, texts, twin, value } from "./browser.mjs";

let browser, folder, vessel;
before(async () => {
  browser = await launch();
  folder = await mkdtemp(join(tmpdir(), "lumen-recovery-"));
  vessel = join(folder, "vessel.stl");
  await promisify(execFile)(program, ["phantom", "aorta", "--triangles", "8000", "-o", vessel]);
});
after(async () => {
  await browser.close();
  await rm(folder, { recursive: true });
});

/** A link to a sample at 70 %. */
const LINK =
  "v=1&sample=aorta&keep=largest&window=hamming&pass-band=0.01&iterations=100&boundary=loop&preserve-volume=no&adapt=yes" +
  "&guard=yes&method=schroeder&feature-angle=60&spare-thin=no&reduction=70&tolerance=2";

/** Waits until the app says something. */
const says = (page, words) =>
  eventually(() => texts(page), (all) => all.some((text) => text.includes(words)), { timeout: 90_000, what: `"${words}"` });

/** What the page has kept as text. */
const kept = (page) => page.evaluate(() => JSON.stringify({ ...localStorage }));

/** How many surfaces it has kept. */
const surfaces = (page) =>
  page.evaluate(async () => {
    const names = (await indexedDB.databases()).map(({ name }) => name);
    const counts = names.map(
      (name) =>
        new Promise((resolve, reject) => {
          const opening = indexedDB.open(name);
          opening.onerror = () => reject(opening.error);
          opening.onsuccess = () => {
            const counting = opening.result.transaction("surface").objectStore("surface").count();
            counting.onsuccess = () => (opening.result.close(), resolve(counting.result));
          };
        }),
    );
    return (await Promise.all(counts)).reduce((sum, count) => sum + count, 0);
  });

/** Chooses an entry of the menu of what is saved. */
async function choose(page, role, name) {
  await press(page, "button", "Save");
  await press(page, role, name);
  await page.keyboard.press("Escape");
}

test("settings and the name come back after a reload, the surface only where it is kept", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE });
  await settled(page);
  await openFile(page, vessel);
  await says(page, "vessel.stl");
  await settled(page);
  const rate = await dragTo(page, REDUCTION, 60);
  await settled(page);
  await eventually(() => kept(page), (text) => text.includes("vessel.stl"), { what: "what is kept" });
  await new Promise((later) => setTimeout(later, 1500));
  assert.equal(await surfaces(page), 0, "no surface without being asked for");

  await page.reload();
  await started(page);
  await says(page, "vessel.stl was open before. Open it again");
  assert.equal(await value(twin(page, "slider", REDUCTION)), rate);
  await openFile(page, vessel);
  await says(page, "vessel.stl is back");

  await choose(page, "menuitemcheckbox", "Keep opened surfaces on this device");
  await eventually(() => surfaces(page), (count) => count === 1, { what: "the surface, kept" });
  await eventually(() => kept(page), (text) => text.includes('keeps_surface\\":true'), { what: "that it is kept" });
  await page.reload();
  await started(page);
  await says(page, "vessel.stl is back");

  await choose(page, "menuitem", "Forget what is kept here");
  await eventually(() => surfaces(page), (count) => count === 0, { what: "the surface, forgotten" });
  assert.equal(await kept(page), "{}");
  assert.deepEqual(wrong, []);
});

test("a link has the settings and tells whether the file is the same", async (t) => {
  const permissions = ["clipboard-read", "clipboard-write"];
  const { page, address } = await openApp(t, browser, { context: { ...COARSE, permissions } });
  await settled(page);
  await openFile(page, vessel);
  await says(page, "vessel.stl");
  await settled(page);
  const rate = await dragTo(page, REDUCTION, 60);
  await settled(page);
  await choose(page, "menuitem", "Copy link");
  const link = await eventually(() => page.evaluate(() => navigator.clipboard.readText()), (text) => text.includes("#v=1"), {
    what: "the link",
  });
  assert(link.startsWith(`${address}#v=1&file=`), link);
  assert(!link.includes("vessel"), "no name is in it");

  const other = await page.context().browser().newContext({ ...COARSE, viewport: { width: 1280, height: 800 } });
  t.after(() => other.close());
  const theirs = await other.newPage();
  await theirs.goto(link);
  await started(theirs);
  await says(theirs, "This link belongs to a file whose SHA-256 begins with");
  assert.equal(await value(twin(theirs, "slider", REDUCTION)), rate);
  const changed = await readFile(vessel);
  changed[0] ^= 1;
  await openFile(theirs, { name: "vessel.stl", buffer: changed });
  await says(theirs, "This is another file than the one that the link belongs to");
  await openFile(theirs, vessel);
  await says(theirs, "This is what the link belongs to: you see the same.");
});

test("a link is followed once: a reload brings back what was made of it since", async (t) => {
  const { page, address } = await openApp(t, browser, { context: COARSE, query: "" });
  const opened = page.url();
  await settled(page);
  await page.evaluate((link) => (location.hash = link), LINK);
  await says(page, "The settings of the link are in force.");
  assert.equal(await value(twin(page, "slider", REDUCTION)), 70);
  assert.equal(page.url(), opened);
  const rate = await dragTo(page, REDUCTION, 40);
  await settled(page);
  await eventually(() => kept(page), (text) => text.includes(`Reduction\\":${rate * 10}`), { what: "the rate, kept" });
  await page.reload();
  await started(page);
  await says(page, "The settings and the view are as they were left.");
  assert.equal(await value(twin(page, "slider", REDUCTION)), rate);
  // The same link once more, and the page by its own name.
  await page.evaluate((link) => (location.hash = link), LINK);
  await eventually(() => value(twin(page, "slider", REDUCTION)), (now) => now === 70, { what: "the rate of the link" });
  await page.goto(`${address}index.html`);
  await started(page);
  await says(page, "The settings and the view are as they were left.");
});

test("where there is no room for a surface, the one before does not come back in its place", async (t) => {
  const { page } = await openApp(t, browser, { context: COARSE });
  await settled(page);
  await openFile(page, vessel);
  await says(page, "vessel.stl");
  // While it is being opened, Escape would be for that.
  await settled(page);
  await choose(page, "menuitemcheckbox", "Keep opened surfaces on this device");
  await says(page, "vessel.stl, and each surface file that is opened after it, is kept on this device");
  await eventually(() => surfaces(page), (count) => count === 1, { what: "the surface, kept" });
  await page.evaluate(() => {
    IDBObjectStore.prototype.put = () => {
      throw new DOMException("no room", "QuotaExceededError");
    };
  });
  await openFile(page, { name: "second.stl", buffer: await readFile(vessel) });
  await says(page, "second.stl is not kept: this browser has no room for");
  assert.equal(await surfaces(page), 0);
});

test("after a panic the result can still be saved", async (t) => {
  const { page } = await openApp(t, browser, { context: COARSE });
  const triangles = shownTriangles(await settled(page));
  // The program asks for the time in every frame and has no answer to a browser without a clock.
  await page.evaluate(() => Object.defineProperty(window, "performance", { value: undefined, configurable: true }));
  await page.mouse.move(300, 300);
  await page.mouse.move(400, 400);
  await page.getByRole("alert").waitFor();
  const download = page.waitForEvent("download");
  await page.getByRole("button", { name: "Save the result" }).click();
  const file = await download;
  assert.equal(file.suggestedFilename(), "lumen-result.stl");
  assert.equal(stlTriangles(await readFile(await file.path())), triangles);
  await page.getByText("The newest result was saved as lumen-result.stl.").waitFor();
  await page.getByRole("button", { name: "Reload" }).click();
  await started(page);
});
