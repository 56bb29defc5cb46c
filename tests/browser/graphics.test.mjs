// The browser takes the graphics back: WebGL2 context, WebGPU device, its process for them, or its memory is full.
// What was open, how it is set and from where it is seen stays as it was.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { REDUCTION, atEntry, fed, lookFrom, settled, shownTriangles, silhouette, views } from "./app.mjs";
import { COARSE, WEBGPU, contextKind, dragTo, eventually, frames, launch, openApp, press, texts, twin } from "./browser.mjs";

let webgl, webgpu;
before(async () => ([webgl, webgpu] = [await launch(), await launch(WEBGPU)]));
after(() => Promise.all([webgl.close(), webgpu.close()]));

const AGAIN = /^The graphics were interrupted and have been started again\. Nothing was lost\.$/;

/** Takes the canvas's WebGL2 context away, as a reset of the driver does. */
const loseContext = (page) =>
  page.evaluate(() => {
    document.getElementById("lumen").getContext("webgl2").getExtension("WEBGL_lose_context").loseContext();
  });

/** Runs in the page before the app: keeps the devices that are made, to break them. */
function keepDevices() {
  window.devices = [];
  const request = globalThis.GPUAdapter?.prototype.requestDevice;
  if (!request) return;
  GPUAdapter.prototype.requestDevice = async function (...all) {
    const device = await request.apply(this, all);
    window.devices.push(device);
    return device;
  };
}

/** Waits until the app says that its graphics were started again, on a canvas that draws. */
const startedAgain = (page) =>
  eventually(
    async () => ({ state: await page.evaluate(() => document.documentElement.dataset.state), all: await texts(page) }),
    ({ state, all }) => state === "ready" && all.some((text) => AGAIN.test(text)),
    { timeout: 60_000, what: "the graphics" },
  );

/** Makes the app other than it is at first, and returns how to see that it still is. */
async function arranged(page) {
  await settled(page);
  await dragTo(page, REDUCTION, 50);
  await settled(page);
  await lookFrom(page, "Left");
  const look = async () => {
    const triangles = shownTriangles(await settled(page));
    return { triangles, pixels: await silhouette(page, views.shaded(page)) };
  };
  const was = await look();
  assert(was.pixels > 5000, `${was.pixels} pixels of the vessel`);
  return async () => {
    const is = await look();
    assert.equal(is.triangles, was.triangles);
    assert(Math.abs(is.pixels - was.pixels) <= 0.01 * was.pixels, `${is.pixels} pixels, ${was.pixels} before`);
  };
}

test("egui's shader has no way that is never taken", async (t) => {
  // What reaches the browser, after the page has had it.
  const keepSources = () => {
    const { prototype } = WebGL2RenderingContext;
    const plain = prototype.shaderSource;
    window.sources = [];
    prototype.shaderSource = function (shader, source) {
      window.sources.push(source);
      plain.call(this, shader, source);
    };
  };
  const { page } = await openApp(t, webgl, { context: COARSE, before: (page) => page.addInitScript(keepSources) });
  const ofEgui = (await page.evaluate(() => window.sources)).filter((source) => /\.predictable_texture_filtering;/.test(source));
  assert.equal(ofEgui.length, 1, "one shader filters");
  assert.match(ofEgui[0], /predictable_texture_filtering;\s*if \(true\)/);
});

test("a lost WebGL2 context is made again, and all is as it was", async (t) => {
  const { page, wrong } = await openApp(t, webgl, { context: COARSE });
  const asItWas = await arranged(page);
  await loseContext(page);
  await startedAgain(page);
  if (process.env.LUMEN_SHOTS) await page.screenshot({ path: `${process.env.LUMEN_SHOTS}/web-recovered-1280x800.png` });
  await asItWas();
  await press(page, "button", "Undo");
  await eventually(async () => shownTriangles(await texts(page)), (now) => now !== null, { what: "the level before" });
  assert.equal(await page.locator("canvas").count(), 1, "one canvas, no more");
  assert.deepEqual(wrong, []);
});

test("a context that is lost again and again is not made for ever, and the user decides", async (t) => {
  const { page } = await openApp(t, webgl, { context: COARSE });
  const asItWas = await arranged(page);
  const screen = page.getByRole("alert");
  let losses = 0;
  // Three in a minute are made again: on a slow machine those before count no more.
  for (let isUp = true; isUp && losses < 12; losses++) {
    await loseContext(page);
    // Another canvas stands in the page, or the screen.
    isUp = await eventually(
      async () => {
        if (await screen.isVisible()) return "screen";
        return page.evaluate(() => document.getElementById("lumen").getContext("webgl2")?.isContextLost() === false);
      },
      (found) => found !== false,
      { what: `what follows loss ${losses + 1}` },
    ).then((found) => found !== "screen");
    if (isUp) await startedAgain(page);
    if (isUp) await frames(page, 3);
  }
  assert(losses >= 4, `given up after ${losses} losses`);
  await screen.waitFor();
  assert.match(await screen.innerText(), /cannot draw at the moment[^]+still here/);
  if (process.env.LUMEN_SHOTS) {
    await page.screenshot({ path: `${process.env.LUMEN_SHOTS}/web-lost-1280x800.png` });
    await page.setViewportSize({ width: 390, height: 844 });
    await page.screenshot({ path: `${process.env.LUMEN_SHOTS}/web-lost-390x844.png` });
    await page.setViewportSize({ width: 1280, height: 800 });
  }
  await page.getByRole("button", { name: "Try again" }).click();
  await startedAgain(page);
  assert.equal(await screen.isVisible(), false);
  await asItWas();
});

test("a trial goes on where it was after the context is lost", async (t) => {
  const { page } = await openApp(t, webgl, { context: COARSE });
  await settled(page);
  await press(page, "button", "Trial");
  const start = await atEntry(page);
  await page.keyboard.down("w");
  await fed(page, start);
  await page.keyboard.up("w");
  await frames(page, 5);
  await loseContext(page);
  await startedAgain(page);
  const after = await atEntry(page);
  assert(after >= start + 1, `${after} cm, no less than before`);
  await twin(page, "img", "Fluoroscopy view").waitFor({ state: "attached" });
});

test("a lost WebGPU device is replaced, and all is as it was", async (t) => {
  const { page, wrong } = await openApp(t, webgpu, { context: COARSE, before: (page) => page.addInitScript(keepDevices) });
  assert.equal(await contextKind(page), "webgpu");
  const asItWas = await arranged(page);
  const before = await page.evaluate(() => window.devices.length);
  await page.evaluate(() => window.devices.at(-1).destroy());
  await startedAgain(page);
  assert(await page.evaluate(() => window.devices.length) > before, "another device");
  await asItWas();
  assert.deepEqual(wrong, []);
});

test("full graphics memory is told in a sentence, and a coarser level is drawn again", async (t) => {
  const { page, wrong } = await openApp(t, webgpu, { context: COARSE, before: (page) => page.addInitScript(keepDevices) });
  await settled(page);
  await press(page, "button", "Close the invitation");
  const before = await silhouette(page, views.shaded(page));
  await page.evaluate(() => {
    const error = new GPUOutOfMemoryError("injected");
    window.devices.at(-1).dispatchEvent(new GPUUncapturedErrorEvent("uncapturederror", { error }));
  });
  await eventually(() => texts(page), (all) => all.some((text) => /^The graphics memory is full/.test(text)), { what: "the sentence" });
  assert((await silhouette(page, views.shaded(page))) < before / 4, "the surface is not drawn");
  await dragTo(page, REDUCTION, 97);
  await settled(page);
  assert((await silhouette(page, views.shaded(page))) > before / 2, "the coarser level is");
  assert.deepEqual(wrong, []);
});

test("where WebGPU cannot be started the app draws with WebGL2", async (t) => {
  const fails = () => {
    GPUAdapter.prototype.requestDevice = async () => {
      throw new DOMException("injected", "OperationError");
    };
  };
  const { page } = await openApp(t, webgpu, { context: COARSE, before: (page) => page.addInitScript(fails) });
  await settled(page);
  assert.equal(await contextKind(page), "webgl2");
  assert((await silhouette(page, views.shaded(page))) > 10_000, "there is something to see");
});

for (const [what, browser] of [["WebGL2", () => webgl], ["WebGPU", () => webgpu]]) {
  test(`with ${what} the end of the browser's process for graphics is survived`, async (t) => {
    const { page } = await openApp(t, browser(), { context: COARSE });
    const asItWas = await arranged(page);
    const session = await browser().newBrowserCDPSession();
    // It ends in the middle of the answer.
    session.send("Browser.crashGpuProcess").catch(() => {});
    await startedAgain(page);
    await asItWas();
  });
}
