// What axe-core, the checker that others rely on, says of every screen: nothing. Contrast is drawn in a canvas, where it
// cannot look; the palette's is tested where it stands (src/app/theme.rs).

import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import { atEntry, settled } from "./app.mjs";
import { COARSE, frames, launch, npm, openApp, press } from "./browser.mjs";

const axe = createRequire(`${npm}/`)("axe-core").source;

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

/** Fails with what is wrong, where, and how to mend it. */
async function isAccessible(page, screen) {
  await frames(page, 10);
  await page.evaluate(axe);
  const { violations, passes } = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations", "passes"] }));
  const wrong = violations.flatMap(({ id, nodes }) => nodes.map(({ html, failureSummary }) => `${id}: ${html}: ${failureSummary}`));
  assert.deepEqual(wrong, [], screen);
  assert(passes.length > 20, `${screen}: ${passes.length} rules were looked at`);
}

test("every screen passes axe", { timeout: 300_000 }, async (t) => {
  const { page } = await openApp(t, browser, { context: COARSE });
  await settled(page);
  await isAccessible(page, "as it starts");
  for (const sheet of ["Help", "About"]) {
    await press(page, "button", sheet);
    await isAccessible(page, sheet);
    await page.keyboard.press("Escape");
    await frames(page, 10);
  }
  for (const menu of ["Sample", "Save", "View", "Learn"]) {
    await press(page, "button", menu);
    await isAccessible(page, `the menu ${menu}`);
    await page.keyboard.press("Escape");
    await frames(page, 10);
  }
  const keys = [["v", "the vessels"], ["c", "the comparison"], ["m", "the measures"], ["p", "presenting"]];
  for (const [key, screen] of keys) {
    await page.keyboard.press(key);
    await settled(page);
    await isAccessible(page, screen);
    await page.keyboard.press("Escape");
    await frames(page, 10);
  }
  for (const [menu, role, item] of [
    ["Save", "menuitem", "Report..."],
    ["Learn", "menuitem", "Glossary"],
    ["Learn", "menuitem", "What a wire feels"],
  ]) {
    await press(page, "button", menu);
    await press(page, role, item);
    await isAccessible(page, item);
    await page.keyboard.press("Escape");
    await frames(page, 10);
  }
  await press(page, "button", "Trial");
  await atEntry(page);
  await isAccessible(page, "the trial");
});

test("a part of another page passes axe", { timeout: 120_000 }, async (t) => {
  const context = { ...COARSE, viewport: { width: 500, height: 320 } };
  const { page } = await openApp(t, browser, { context, query: "?embed&samples=10000" });
  await isAccessible(page, "as it starts");
});

test("a phone's screen passes axe", { timeout: 120_000 }, async (t) => {
  const { page } = await openApp(t, browser, { context: { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true } });
  await settled(page);
  await isAccessible(page, "as it starts");
  await press(page, "button", "Menu");
  await isAccessible(page, "the menu");
});
