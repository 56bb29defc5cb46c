// With WebGPU the app draws what it draws with WebGL2, which the other tests use.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { settled, silhouette, views } from "./app.mjs";
import { launch, openApp } from "./browser.mjs";

/** WebGPU on the processor: Chromium brings SwiftShader as a Vulkan driver. */
const WEBGPU = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan", "--use-vulkan=swiftshader"];

let browser;
before(async () => (browser = await launch(WEBGPU)));
after(() => browser.close());

/** The canvas has a context of one kind; asking for another gives null. */
const kind = (page) =>
  page.evaluate(() => ["webgpu", "webgl2"].find((kind) => document.getElementById("lumen").getContext(kind) !== null));

test("the app draws with WebGPU where there is one, and with WebGL2 when it is asked to", async (t) => {
  const drawn = {};
  for (const [query, expected] of [["", "webgpu"], ["?renderer=webgl", "webgl2"]]) {
    const { page, wrong } = await openApp(t, browser, { query });
    await settled(page);
    assert.equal(await kind(page), expected);
    drawn[expected] = await silhouette(page, views.shaded(page));
    assert.deepEqual(wrong, []);
    await page.close();
  }
  t.diagnostic(`pixels of the silhouette: ${JSON.stringify(drawn)}`);
  assert(drawn.webgpu > 10_000, "there is something to see");
  assert(Math.abs(drawn.webgpu - drawn.webgl2) <= 0.01 * drawn.webgl2, "both draw the same");
});
