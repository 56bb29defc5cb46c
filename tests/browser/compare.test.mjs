// Several settings side by side: computed by the Worker, drawn with WebGL2.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { drawn, grouped, settled } from "./app.mjs";
import { COARSE, eventually, frames, launch, openApp, press, texts, twin } from "./browser.mjs";

/** What the rates of Figure 7 leave of 74,307; Table II of the paper has 66,875 for the first. */
const MOST = [66_876, 7_430, 743];

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

/** Waits until `count` cells have their numbers. */
const compared = (page, count) =>
  eventually(
    async () => ({ all: await texts(page), busy: await twin(page, "button", "Cancel").count() }),
    ({ all, busy }) => !busy && all.filter((text) => text === "From original").length === count,
    { timeout: 180_000, what: `the numbers of ${count} cells` },
  ).then(({ all }) => all);

test("six settings are compared, and a click takes one", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE, query: "" });
  await settled(page);
  await press(page, "button", "Compare");
  const seven = await compared(page, 3);
  for (const count of MOST) {
    assert([0, 1, 2].some((less) => seven.includes(grouped(count - less))), `${count} in ${seven.join("; ")}`);
  }
  await press(page, "button", "Figure 6");
  await compared(page, 6);
  const cells = twin(page, "radio", /^Pass band/);
  assert.equal(await cells.count(), 6);
  await page.mouse.move(2, 2);
  await frames(page, 3);
  for (let i = 0; i < 6; i++) assert((await drawn(page, cells.nth(i))) > 1000, `cell ${i} is empty`);
  await press(page, "radio", "Pass band 0.1, 30 iterations");
  const field = twin(page, "spinbutton", "Iterations value");
  await eventually(() => field.getAttribute("aria-valuenow"), (now) => Number(now) === 30, { what: "the setting" });
  await settled(page);
  assert.deepEqual(wrong, []);
});
