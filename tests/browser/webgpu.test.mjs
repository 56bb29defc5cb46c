// With WebGPU the app draws what it draws with WebGL2, which the other tests use.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { atEntry, drawn, fed, settled, silhouette, views } from "./app.mjs";
import { COARSE, WEBGPU, contextKind, eventually, frames, launch, openApp, press, texts, twin } from "./browser.mjs";

let browser;
before(async () => (browser = await launch(WEBGPU)));
after(() => browser.close());

test("the app draws with WebGPU where there is one, and with WebGL2 when it is asked to", async (t) => {
  const pixels = {};
  for (const [query, expected] of [["", "webgpu"], ["?renderer=webgl", "webgl2"]]) {
    const { page, wrong } = await openApp(t, browser, { query });
    await settled(page);
    assert.equal(await contextKind(page), expected);
    // Its card is as far from the background as what counts as drawn.
    await press(page, "button", "Close the invitation");
    const card = twin(page, "button", "Close the invitation");
    await eventually(() => card.count(), (count) => count === 0, { timeout: 60_000, what: "the card to be gone" });
    await frames(page, 3);
    pixels[expected] = await silhouette(page, views.shaded(page));
    assert.deepEqual(wrong, []);
    await page.close();
  }
  t.diagnostic(`pixels of the silhouette: ${JSON.stringify(pixels)}`);
  assert(pixels.webgpu > 10_000, "there is something to see");
  assert(Math.abs(pixels.webgpu - pixels.webgl2) <= 0.01 * pixels.webgl2, "both draw the same");
});

test("with WebGPU settings are compared", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE });
  assert.equal(await contextKind(page), "webgpu");
  await settled(page);
  await press(page, "button", "Compare");
  await eventually(
    async () => ({ all: await texts(page), busy: await twin(page, "button", "Cancel").count() }),
    ({ all, busy }) => !busy && all.filter((text) => text === "From original").length === 3,
    { timeout: 180_000, what: "the numbers of three cells" },
  );
  await page.mouse.move(2, 2);
  await frames(page, 3);
  const cells = twin(page, "radio", /^Reduction/);
  assert.equal(await cells.count(), 3);
  for (let i = 0; i < 3; i++) assert((await drawn(page, cells.nth(i))) > 1000, `cell ${i} is empty`);
  assert.deepEqual(wrong, []);
});

test("with WebGPU a wire is steered, and all three views show it", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE });
  assert.equal(await contextKind(page), "webgpu");
  await settled(page);
  await press(page, "button", "Trial");
  const start = await atEntry(page);
  await page.keyboard.down("w");
  await fed(page, start, 2);
  await page.keyboard.up("w");
  await page.mouse.move(2, 2);
  await frames(page, 10);
  for (const view of ["Trial view", "Fluoroscopy view", "Tip view"]) {
    const pixels = await drawn(page, twin(page, "img", view));
    t.diagnostic(`${view}: ${pixels} pixels`);
    assert(pixels > 500, `${view} is empty`);
  }
  assert.deepEqual(wrong, []);
});
