// A page that nobody sees: what is held when it is hidden is not held on behind it.
//
// A browser without a window shows every page, so the page is told that it is hidden in the way in which it would find
// out: `document.hidden`, an event, no frames, timers once a second.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { atEntry, fed, inserted, settled } from "./app.mjs";
import { COARSE, eventually, frames, launch, openApp, press, started, twin } from "./browser.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

/** Runs in the page before the app: `hide()` and `show()`. */
function hideable() {
  const [frame, cancel, timer] = [window.requestAnimationFrame, window.cancelAnimationFrame, window.setTimeout];
  let [isHidden, last] = [false, 0];
  const waiting = new Map();
  Object.defineProperty(document, "hidden", { get: () => isHidden });
  Object.defineProperty(document, "visibilityState", { get: () => (isHidden ? "hidden" : "visible") });
  window.requestAnimationFrame = (work) => {
    if (!isHidden) return frame.call(window, work);
    waiting.set(--last, work);
    return last;
  };
  window.cancelAnimationFrame = (id) => (waiting.delete(id) ? undefined : cancel.call(window, id));
  window.setTimeout = (work, ms, ...rest) => timer.call(window, work, isHidden ? Math.max(ms ?? 0, 1000) : ms, ...rest);
  const turn = (hidden) => {
    isHidden = hidden;
    document.dispatchEvent(new Event("visibilitychange", { bubbles: true }));
    if (hidden) window.dispatchEvent(new FocusEvent("blur"));
    else for (const [id, work] of waiting) waiting.delete(id) && frame.call(window, work);
  };
  window.hide = () => turn(true);
  window.show = () => turn(false);
}

const hideablePage = { context: COARSE, before: (page) => page.addInitScript(hideable) };

test("the wire stops where the page is hidden with a key held", async (t) => {
  const { page } = await openApp(t, browser, hideablePage);
  await settled(page);
  await press(page, "button", "Trial");
  const start = await atEntry(page);
  await page.keyboard.down("w");
  await fed(page, start);
  await page.evaluate(() => window.hide());
  // The last that was drawn.
  const moving = await inserted(page);
  await new Promise((later) => setTimeout(later, 5000));
  await page.keyboard.up("w");
  await new Promise((later) => setTimeout(later, 1500));
  await page.evaluate(() => window.show());
  await frames(page, 30);
  const now = await inserted(page);
  t.diagnostic(`${(10 * (now - moving)).toFixed(0)} mm were fed while the page was hidden`);
  // At 15 mm/s: what was under way, and no more than a second of it.
  assert(now - moving <= 1.5, `from ${moving} cm to ${now} cm while nobody saw it`);
});

test("a key that is held while the window beside the page is used is let go", async (t) => {
  const { page } = await openApp(t, browser, { context: COARSE, before: (page) => page.addInitScript(() => {
    window.hasAttention = true;
    document.hasFocus = () => window.hasAttention;
  }) });
  await settled(page);
  await press(page, "button", "Trial");
  const start = await atEntry(page);
  await page.keyboard.down("w");
  await fed(page, start);
  await page.evaluate(() => (window.hasAttention = false));
  await new Promise((later) => setTimeout(later, 2000));
  const stopped = await inserted(page);
  await new Promise((later) => setTimeout(later, 3000));
  assert.equal(await inserted(page), stopped, "the wire stands, though the page is seen");
  // The key has come up elsewhere.
  await page.evaluate(() => (window.hasAttention = true));
  await new Promise((later) => setTimeout(later, 2000));
  assert.equal(await inserted(page), stopped, "and it does not go on by itself");
});

test("work that ends while the page is hidden is there when it is shown", async (t) => {
  // As users have it: of few triangles the work would be over before the page is hidden.
  const { page, wrong } = await openApp(t, browser, { ...hideablePage, query: "" });
  const result = (all) => all.slice(all.findIndex((text) => text === "Vertices"), all.findIndex((text) => text === "Area") + 2).join(" ");
  const before = result(await settled(page));
  const slider = twin(page, "slider", "Pass band");
  await slider.evaluate((twin) => twin.focus());
  await eventually(() => page.locator("#lumen").getAttribute("aria-activedescendant"), (id) => id !== null);
  const isWorking = () => twin(page, "button", "Cancel").count();
  for (let tries = 0; !(await isWorking()); tries++) {
    assert(tries < 20, "no work was begun");
    await page.keyboard.press("ArrowRight");
    await frames(page, 2);
  }
  await page.evaluate(() => window.hide());
  assert(await isWorking(), "the work was over before the page was hidden");
  await new Promise((later) => setTimeout(later, 4000));
  assert(await isWorking(), "nothing is drawn behind a page that nobody sees");
  await page.evaluate(() => window.show());
  await started(page);
  const after = result(await settled(page));
  assert(/mm/.test(before) && /mm/.test(after) && before !== after, `the result was ${before} and is ${after}`);
  assert.deepEqual(wrong, []);
});
