// The page around the app: loading, "cannot run", "has stopped", the policy, the size, the controls' twins.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { gzipSync } from "node:zlib";
import { settled } from "./app.mjs";
import { dist, eventually, frames, launch, openApp, openPage, started, twin, value } from "./browser.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

test("a first visit downloads at most 3.2 MB, compressed, before the app starts", async (t) => {
  for (const locale of ["en-US", "de-DE"]) {
    const { page } = await openPage(t, browser, { context: { locale } });
    await started(page);
    // What the start waits for. The texts of other languages and what reads scans are asked for by the program, which runs then.
    const names = await page.evaluate(() => {
      const all = performance.getEntriesByType("resource").map(({ name, startTime, responseEnd }) => ({ name, startTime, responseEnd }));
      const program = all.find(({ name }) => name.includes("lumen-web_bg.wasm"));
      return all.filter(({ startTime }) => startTime <= program.responseEnd).map(({ name }) => new URL(name).pathname.split("/").pop());
    });
    const all = [...new Set([...names, "index.html"])];
    const sizes = all.map(async (name) => gzipSync(await readFile(join(dist, name))).length);
    const total = (await Promise.all(sizes)).reduce((sum, size) => sum + size, 0);
    t.diagnostic(`${locale}: ${total} bytes: ${all.join(", ")}`);
    assert(all.includes("lumen-web_bg.wasm") && total > 1_000_000, "the program was asked for");
    assert(total <= 3_200_000, `${total} bytes`);
  }
});

test("the loading screen shows how far the download is", async (t) => {
  const { page } = await openPage(t, browser, { slow: 2000 });
  const seen = new Set();
  while ((await page.evaluate(() => document.documentElement.dataset.state)) === "loading") {
    seen.add(await page.locator("#loading-text").textContent());
    await new Promise((later) => setTimeout(later, 50));
  }
  await started(page);
  const fractions = [...seen].map((text) => text.match(/^[\d.]+ of ([\d.]+) MB, (\d+) %$/)).filter(Boolean);
  const module = (await readFile(join(dist, "lumen-web_bg.wasm"))).length;
  assert(fractions.length >= 3, `only saw ${[...seen].join("; ")}`);
  assert(fractions.every(([, total]) => Math.abs(total * 1e6 - module) < 0.06e6), "the total is the module's size");
  const percents = fractions.map(([, , percent]) => Number(percent));
  assert.deepEqual(percents, [...percents].sort((a, b) => a - b), "it only grows");
  assert(percents.every((percent) => percent <= 100));
  assert.equal(await page.locator("#loading").isVisible(), false);
});

test("the app starts under any path, within its policy, and without an error", async (t) => {
  const started = Date.now();
  const { page, wrong } = await openApp(t, browser, { query: "?samples=10000" });
  t.diagnostic(`start to first frame: ${Date.now() - started} ms`);
  const policy = await page.locator('meta[http-equiv="Content-Security-Policy"]').getAttribute("content");
  assert.match(policy, /default-src 'none'/);
  assert.match(policy, /connect-src 'self'(;|$)/);
  assert.doesNotMatch(policy, /unsafe-inline|'unsafe-eval'|https?:|\*/);
  const triangles = (await settled(page)).map((text) => text.match(/ of ([\d,]+)$/)).find(Boolean)[1].replaceAll(",", "");
  assert(Math.abs(triangles - 10_000) < 500, `the address asks for a sample of 10,000 triangles, it has ${triangles}`);
  assert.deepEqual(wrong, []);
  // The policy is in force, not only written down.
  const allowed = await page.evaluate(() => fetch("http://127.0.0.2:9/").then(() => true, () => false));
  assert.equal(allowed, false);
  assert.match(wrong.join("\n"), /Content Security Policy directive: "connect-src 'self'"/);
});

test("the page says which language it is in and names its controls", async (t) => {
  const { page } = await openApp(t, browser);
  assert.equal(await page.locator("html").getAttribute("lang"), "en");
  await twin(page, "slider", "Reduction").waitFor({ state: "attached" });
  const unnamed = await page.locator("#twins").evaluate((twins) => {
    const needName = ["button", "checkbox", "combobox", "link", "menuitemcheckbox", "option", "radio", "slider", "spinbutton", "tab", "textbox"];
    const roles = [...twins.querySelectorAll("[role]")].filter((twin) => needName.includes(twin.getAttribute("role")));
    return roles.filter((twin) => !twin.getAttribute("aria-label")).map((twin) => twin.outerHTML);
  });
  assert.deepEqual(unnamed, []);
});

test("an assistive tool's click works, and the keyboard stays with the canvas", async (t) => {
  const { page } = await openApp(t, browser);
  const open = twin(page, "button", "Open...");
  await open.waitFor({ state: "attached" });
  await open.evaluate((twin) => twin.focus());
  await page.waitForFunction(() => document.getElementById("lumen").hasAttribute("aria-activedescendant"));
  assert.equal(await page.evaluate(() => document.activeElement.id), "lumen");
  assert.equal(
    await page.locator("#lumen").getAttribute("aria-activedescendant"),
    await open.getAttribute("id"),
  );
  await settled(page);
  const slider = twin(page, "slider", "Reduction");
  await slider.evaluate((twin) => twin.focus());
  const own = await slider.getAttribute("id");
  const focused = () => page.locator("#lumen").getAttribute("aria-activedescendant");
  await eventually(focused, (id) => id === own, { what: "the slider's focus" });
  const rate = await value(slider);
  await page.keyboard.press("ArrowLeft");
  await eventually(() => value(slider), (now) => now < rate, { what: "the arrow key's step" });
});

for (const [what, stub, sentence] of [
  ["WebGL2 and WebGPU", () => {
    HTMLCanvasElement.prototype.getContext = () => null;
    Object.defineProperty(Navigator.prototype, "gpu", { value: undefined });
  }, /needs WebGL2 or WebGPU/],
  ["WebAssembly SIMD", () => (WebAssembly.validate = () => false), /needs WebAssembly with SIMD/],
]) {
  test(`a browser without ${what} gets a plain sentence`, async (t) => {
    const { page } = await openPage(t, browser, { before: (page) => page.addInitScript(stub) });
    const screen = page.getByRole("alert");
    await screen.waitFor();
    assert.match(await screen.innerText(), sentence);
    assert.equal(await page.locator("#failed").isVisible(), false);
  });
}

test("a panic shows what can be copied, and a way back", async (t) => {
  const { page } = await openApp(t, browser, { context: { permissions: ["clipboard-read", "clipboard-write"] } });
  // The program asks for the time in every frame and has no answer to a browser without a clock.
  await page.evaluate(() => Object.defineProperty(window, "performance", { value: undefined, configurable: true }));
  await page.mouse.move(300, 300);
  await page.mouse.move(400, 400);
  const screen = page.getByRole("alert");
  await screen.waitFor();
  assert.match(await screen.innerText(), /Lumen has stopped/);
  const details = await page.locator("#failed-details").textContent();
  assert.match(details, /panicked at .+\.rs:\d+/);
  await page.getByRole("button", { name: "Copy details" }).click();
  await page.getByText("Copied.").waitFor();
  // What is copied may come back with the line ends of the system.
  assert.equal((await page.evaluate(() => navigator.clipboard.readText())).replaceAll("\r\n", "\n"), details);
  await page.getByRole("button", { name: "Reload" }).click();
  await started(page);
});

test("the page fits a telephone", async (t) => {
  const { page } = await openApp(t, browser, { context: { viewport: { width: 360, height: 740 }, deviceScaleFactor: 3 } });
  const { width, height } = await page.locator("#lumen").boundingBox();
  assert.deepEqual([width, height], [360, 740]);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360);
});

test("as a part of another page it shows views and sliders alone, and keeps nothing", async (t) => {
  const { page, address, wrong } = await openApp(t, browser, { query: "?samples=10000" });
  await settled(page);
  await twin(page, "button", "Open...").waitFor({ state: "attached" });
  await page.route("**/lecture.html", (route) =>
    route.fulfill({
      contentType: "text/html",
      body: `<!doctype html><title>A lecture</title><iframe src="${address}?embed&samples=10000" width="900" height="600"></iframe>`,
    }),
  );
  await page.goto(`${address}lecture.html`);
  const twins = page.frameLocator("iframe").locator("#twins");
  for (const name of ["Pass band", "Iterations", "Reduction"]) {
    await twins.getByRole("slider", { name, exact: true }).waitFor({ state: "attached", timeout: 60_000 });
  }
  await twins.getByText(/^Not for clinical decisions$/).first().waitFor({ state: "attached" });
  for (const name of ["Open...", "Save", "Sample"]) {
    assert.equal(await twins.getByRole("button", { name, exact: true }).count(), 0, name);
  }
  assert.deepEqual(wrong, []);
});
