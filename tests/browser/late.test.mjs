// The half of the program that the first picture does without: when it is asked for, and what happens where it is not there.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { OCTAHEDRON, atEntry, openFile, says, settled, shownTriangles, stlTriangles, workersOn } from "./app.mjs";
import { COARSE, dist, eventually, launch, openApp, press } from "./browser.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

const NAME = "lumen-web_late.wasm";

/** The requests for it that a page or a Worker has made: when, and whether anything waited for the answer. */
const requests = (of) =>
  of.evaluate((name) => {
    const all = performance.getEntriesByType("resource").filter((entry) => entry.name.includes(name));
    return all.map(({ startTime, initiatorType }) => ({ startTime, waits: initiatorType === "xmlhttprequest" }));
  }, NAME);

/** What is served in its place: `answer(n)` for the n-th request. */
const served = (answer) => {
  let count = 0;
  return {
    // Not every host knows what it is.
    type: "application/octet-stream",
    get body() {
      return answer((count += 1));
    },
  };
};

const whole = () => readFile(join(dist, NAME));

test("it is fetched once, after the first picture, and neither page nor engine waits for it", async (t) => {
  const context = { ...COARSE, serviceWorkers: "block" };
  const ready = () => new MutationObserver(() => performance.mark(document.documentElement.dataset.state)).observe(document, { subtree: true, attributeFilter: ["data-state"] });
  const { page, server, wrong } = await openApp(t, browser, { context, query: "", before: (page) => page.addInitScript(ready) });
  await settled(page);
  const [only, ...more] = await eventually(() => requests(page), (all) => all.length > 0);
  const drawn = await page.evaluate(() => performance.getEntriesByName("ready")[0].startTime);
  assert.deepEqual(more, []);
  assert(!only.waits && only.startTime >= drawn, JSON.stringify({ only, drawn }));
  assert.deepEqual(await requests(workersOn(page, "pipeline")[0]), []);

  await openFile(page, OCTAHEDRON);
  await eventually(() => settled(page), (all) => shownTriangles(all) < 8);
  assert.equal(server.asked.filter((path) => path.startsWith(NAME)).length, 1, "a file asks for nothing more");
  assert.deepEqual(wrong, []);
});

test("a file that is opened before it has come waits, and holds up nothing", async (t) => {
  const context = { ...COARSE, serviceWorkers: "block" };
  let arrive;
  const arrival = new Promise((resolve) => (arrive = resolve));
  const files = { [NAME]: served(() => arrival.then(whole)) };
  const { page, wrong } = await openApp(t, browser, { context, files });
  const shown = shownTriangles(await settled(page));
  await openFile(page, OCTAHEDRON);
  assert.equal(shownTriangles(await settled(page)), shown);
  arrive();
  await eventually(() => settled(page), (all) => shownTriangles(all) < 8);
  const all = [...(await requests(page)), ...(await requests(workersOn(page, "pipeline")[0]))];
  assert(all.length === 1 && !all[0].waits, JSON.stringify(all));
  assert.deepEqual(wrong, []);
});

test("what could not be fetched at first is asked for again", async (t) => {
  const context = { ...COARSE, serviceWorkers: "block" };
  const files = { [NAME]: served((count) => (count < 3 ? Promise.reject(new Error("no network")) : whole())) };
  const { page } = await openApp(t, browser, { context, files });
  const shown = shownTriangles(await settled(page));
  await openFile(page, OCTAHEDRON);
  await says(page, /^Not opened: the part of Lumen that reads files could not be downloaded yet/);
  assert.equal(shownTriangles(await settled(page)), shown);
  await eventually(() => page.evaluate(() => Boolean(globalThis.lumenLateModule)), Boolean);
  await openFile(page, OCTAHEDRON);
  await eventually(() => settled(page), (all) => shownTriangles(all) < 8);
  assert((await requests(page)).every(({ waits }) => !waits));
});

test("what is called before it has come asks for it at once, and where there is no network what is shown can be saved", async (t) => {
  const context = { ...COARSE, serviceWorkers: "block" };
  for (const isThere of [true, false]) {
    const files = { [NAME]: served(() => Promise.reject(new Error("no network"))) };
    const { page } = await openApp(t, browser, { context, files });
    const shown = shownTriangles(await settled(page));
    if (isThere) files[NAME] = { type: "application/wasm", body: whole() };
    await press(page, "button", "Trial");
    if (isThere) {
      await atEntry(page);
      assert((await requests(page)).some(({ waits }) => waits));
      continue;
    }
    await page.waitForSelector('html[data-state="failed"]', { state: "attached" });
    assert.match(await page.locator("#failed-details").textContent(), /A part of Lumen could not be downloaded: 404 Not Found/);
    const download = page.waitForEvent("download");
    await page.getByRole("button", { name: /save/i }).click();
    assert.equal(stlTriangles(await readFile(await (await download).path())), shown);
  }
});
