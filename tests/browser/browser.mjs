// The one place where a browser is started, and how a test finds and moves what the app draws.
//
// The app draws into a canvas. Its controls have twins in the page with role, name and value; a test finds a control
// through its twin, as an assistive tool would, and then moves it with real pointer events on the canvas.

import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { fileURLToPath } from "node:url";
import { serve } from "./server.mjs";

const checkout = fileURLToPath(new URL("../../", import.meta.url));
/** Where what comes from npm is. */
export const npm = process.env.LUMEN_NPM ?? `${checkout}target/npm`;
const { chromium } = createRequire(`${npm}/`)("playwright-core");

/** The built app. */
export const dist = process.env.LUMEN_DIST ?? `${checkout}dist`;
/** Where the surfaces with known facts are. */
export const data = process.env.LUMEN_DATA ?? `${checkout}../shared/data`;
/** The command line, whose files the browser's are compared with. */
export const program = process.env.LUMEN_PROGRAM ?? `${checkout}target/debug/lumen`;

/** What WebGL is drawn by: the SwiftShader that Chromium brings, or, faster, Mesa's driver ("gl-egl") where there is one. */
const ANGLE = process.env.LUMEN_ANGLE ?? "swiftshader";

/** How long the app may take to draw its first frame: there is no graphics card here. */
const START_MS = 60_000;

/** WebGPU on the processor: Chromium brings SwiftShader as a Vulkan driver. */
export const WEBGPU = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan", "--use-vulkan=swiftshader"];

/**
 * A page that is drawn with a quarter of a pixel a point in each direction, a sixteenth of all: for tests that do not look at
 * single ones. Drawing is what takes the time where there is no graphics card.
 */
export const COARSE = { deviceScaleFactor: 0.25 };

/** Samples of few triangles, where a test wants nothing of theirs; with `--long` all open them as users have them. */
const COARSE_SAMPLES = process.env.LUMEN_LONG ? "" : "?samples=10000";

/** A browser that draws without a graphics card and talks to nobody by itself. */
export function launch(more = []) {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--no-sandbox",
      `--use-angle=${ANGLE}`,
      // What is there where Mesa does not start.
      "--enable-unsafe-swiftshader",
      ...(ANGLE === "swiftshader" ? [] : ["--ignore-gpu-blocklist"]),
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      "--no-first-run",
      ...more,
    ],
  });
}

/**
 * Serves dist/ and opens a page of its own for one test, closed when the test ends. `before(page)` runs before the
 * address is opened; `query` ends it, "" for what users open; `files` are served in place of those in dist/, or all of another
 * `folder`. The result has the page, the server with its address, and what went wrong so far: errors that were thrown or
 * written to the console, where the browser writes violations of the page's policy too.
 */
export async function openPage(t, browser, { before, query = COARSE_SAMPLES, slow, files, folder = dist, context: options = {} } = {}) {
  const server = await serve(folder, { slow, files });
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, reducedMotion: "reduce", ...options });
  t.after(async () => {
    await context.close();
    await server.close();
  });
  const page = await context.newPage();
  const wrong = [];
  page.on("console", (message) => message.type() === "error" && wrong.push(message.text()));
  page.on("pageerror", (error) => wrong.push(String(error)));
  await before?.(page);
  await page.goto(server.address + query);
  return { page, server, address: server.address, wrong };
}

/** As `openPage`, and waits until the app draws. */
export async function openApp(t, browser, options) {
  const opened = await openPage(t, browser, options);
  await started(opened.page);
  return opened;
}

/** Waits until the app draws. */
export async function started(page) {
  await page.waitForSelector('html[data-state="ready"], html[data-state="failed"], html[data-state="unsupported"]', {
    state: "attached",
    timeout: START_MS,
  });
  const state = await page.evaluate(() => document.documentElement.dataset.state);
  assert.equal(state, "ready", await page.evaluate(() => document.body.innerText));
}

/** What the canvas draws with: it has a context of one kind, and asking for another gives null. */
export const contextKind = (page) =>
  page.evaluate(() => ["webgpu", "webgl2"].find((kind) => document.getElementById("lumen").getContext(kind) !== null));

/** The twin of a control; `name` is a text or a pattern. */
export function twin(page, role, name) {
  return page.locator("#twins").getByRole(role, { name, exact: typeof name === "string" });
}

/** The middle of a control, in the page's pixels. */
async function middle(control) {
  const box = await control.boundingBox();
  assert(box && box.width > 0 && box.height > 0, `${control} is not drawn`);
  return { x: box.x + box.width / 2, y: box.y + box.height / 2, box };
}

/** Turns the wheel over a control until it stands above the bar at the window's foot, as a user does. */
export async function inSight(page, control) {
  const { height } = page.viewportSize();
  for (let turns = 0; turns < 8; turns++) {
    const { x, box } = await middle(control);
    if (box.y + box.height < height - 56) return;
    await page.mouse.move(x, height / 2);
    await page.mouse.wheel(0, 80);
    await frames(page, 12);
  }
}

/** Presses a control with the pointer. */
export async function press(page, role, name) {
  const control = twin(page, role, name);
  await control.waitFor({ state: "attached" });
  const { x, y } = await middle(control);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.up();
}

/** A control's value as a number. */
export async function value(control) {
  return Number(await control.getAttribute("aria-valuenow"));
}

/**
 * Drags a slider as near to `wanted` as whole pixels allow and returns the value reached. The scale may be
 * logarithmic, so the place is found by halving. The pointer goes down once and up once.
 */
export async function dragTo(page, name, wanted) {
  const slider = twin(page, "slider", name);
  await slider.waitFor({ state: "attached" });
  await inSight(page, slider);
  const { y, box } = await middle(slider);
  let [low, high] = [Math.floor(box.x), Math.ceil(box.x + box.width)];
  let best = { off: Infinity, x: low };
  const look = async (x) => {
    await page.mouse.move(x, y);
    await frames(page, 2);
    const reached = await value(slider);
    if (Math.abs(reached - wanted) < best.off) best = { off: Math.abs(reached - wanted), x };
    return reached;
  };
  await page.mouse.move(Math.round((low + high) / 2), y);
  await page.mouse.down();
  while (best.off > 0 && low <= high) {
    const x = Math.floor((low + high) / 2);
    if ((await look(x)) < wanted) low = x + 1;
    else high = x - 1;
  }
  await look(best.x);
  await page.mouse.up();
  await frames(page, 2);
  return value(slider);
}

/** Waits for `count` frames. */
export function frames(page, count = 1) {
  return page.evaluate(async (count) => {
    for (let i = 0; i < count; i++) await new Promise(requestAnimationFrame);
  }, count);
}

/** Waits until `read()` gives something that `accept`s, and returns it; says what it last gave if it never does. */
export async function eventually(read, accept, { timeout = 30_000, what = "the app" } = {}) {
  const end = Date.now() + timeout;
  for (;;) {
    const last = await read();
    if (accept(last)) return last;
    assert(Date.now() < end, `${what} never got there; last: ${JSON.stringify(last)}`);
    await new Promise((later) => setTimeout(later, 50));
  }
}

/** All the text the twins hold, in reading order. */
export function texts(page) {
  return page.locator("#twins").evaluate((twins) => {
    const leaves = [...twins.querySelectorAll("*")].filter((twin) => twin.childElementCount === 0);
    return leaves.map((twin) => twin.textContent).filter(Boolean);
  });
}

/** A control's picture, or the whole page's, as { width, height, data } in RGBA. */
export async function picture(page, control) {
  const clip = control && (await control.boundingBox());
  const png = await page.screenshot(clip ? { clip } : {});
  // The page decodes it, so that no image library is needed here; a page of its own, so that the app's policy holds.
  const decoder = await page.context().browser().newPage();
  try {
    const { width, height, address } = await decoder.evaluate(async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
      const canvas = new OffscreenCanvas(image.width, image.height);
      const context = canvas.getContext("2d");
      context.drawImage(image, 0, 0);
      const { width, height, data } = context.getImageData(0, 0, image.width, image.height);
      // As a text: an array of as many numbers takes the protocol seconds.
      const reader = new FileReader();
      const read = new Promise((done) => (reader.onload = done));
      reader.readAsDataURL(new Blob([data]));
      await read;
      return { width, height, address: reader.result };
    }, png.toString("base64"));
    return { width, height, data: Buffer.from(address.slice(address.indexOf(",") + 1), "base64") };
  } finally {
    await decoder.close();
  }
}
