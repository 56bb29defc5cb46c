// The npm package's element on a page of somebody else, which allows scripts, styles and requests of its own origin alone.

import assert from "node:assert/strict";
import { cp, mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { eventually, launch, openPage, picture } from "./browser.mjs";
import { built } from "../npm/built.mjs";
import { tube } from "../npm/tube.mjs";

const SIZE = { around: 24, along: 60 };
const TRIANGLES = 2 * SIZE.around * SIZE.along;

let browser, folder;
before(async () => {
  browser = await launch();
  folder = await mkdtemp(join(tmpdir(), "lumen-"));
  await cp(built, join(folder, "lumen-vessel"), { recursive: true });
  await writeFile(join(folder, "tube.stl"), tube(SIZE));
  await writeFile(join(folder, "broken.stl"), tube(SIZE).subarray(0, 5000));
  const policy = "default-src 'none'; connect-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; img-src data:";
  await writeFile(
    join(folder, "index.html"),
    `<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>Lecture</title>
    <link rel="icon" href="data:,"><meta http-equiv="Content-Security-Policy" content="${policy}">
    <script type="module" src="lumen-vessel/element.js"></script>
    <h1>A lecture</h1><lumen-vessel src="tube.stl" pass-band="0.01" iterations="100" reduction="90" controls></lumen-vessel>`,
  );
});
after(async () => {
  await browser.close();
  await rm(folder, { recursive: true });
});

/** The page, and what of the element is read. */
async function lecture(t, context) {
  const asked = [];
  const { page, wrong, address } = await openPage(t, browser, { folder, query: "", context, before: (page) => page.context().on("request", (request) => asked.push(request.url())) });
  const element = page.locator("lumen-vessel");
  const text = (part) => element.locator(part).textContent();
  const count = async () => Number((await text(".counts")).split(" ")[0].replaceAll(",", ""));
  const judged = () => eventually(() => text(".verdict"), (verdict) => verdict !== "" && !verdict.startsWith("Being"), { what: "the verdict" });
  return { page, wrong, address, asked, element, text, count, judged };
}

const near = (count, wanted) => Math.abs(count - wanted) <= 1;

for (const [width, height, colorScheme] of [[1280, 800, "light"], [390, 844, "dark"]]) {
  test(`a surface is drawn, judged and reduced on a page ${width} points wide`, async (t) => {
    const { page, wrong, address, asked, element, text, count, judged } = await lecture(t, { viewport: { width, height }, colorScheme, hasTouch: width < 600 });
    await judged();
    assert(near(await count(), TRIANGLES / 10), await text(".counts"));
    assert(await element.getByText("Not for clinical decisions.").isVisible());
    const canvas = element.locator("canvas");
    const seen = () => page.evaluate(() => new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)))).then(() => picture(page, canvas));
    const differing = (one, other) => one.data.filter((x, i) => i % 4 === 0 && Math.abs(x - other.data[i]) > 24).length;
    const first = await seen();
    const plain = { data: first.data.map((_, i) => first.data[(8 * first.width + 8) * 4 + (i % 4)]) };
    assert(differing(first, plain) > 0.02 * first.width * first.height, "something is drawn");
    if (process.env.LUMEN_SHOTS) await page.screenshot({ path: join(process.env.LUMEN_SHOTS, `element-${width}.png`) });
    await canvas.focus();
    await page.keyboard.press("ArrowLeft");
    assert(differing(first, await seen()) > 500, "keys turn");
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true, "nothing is cut off");

    const nothingElse = () => {
      assert.deepEqual(asked.filter((url) => !url.startsWith(address) && !url.startsWith("data:")), []);
      assert.deepEqual(wrong, []);
    };
    nothingElse();
    // What follows is the same at any width.
    if (width < 600 && !process.env.LUMEN_LONG) return;

    // Another rate is there before anything is measured; the wireframe is another.
    const sparse = await seen();
    await element.getByLabel("Reduction").fill("50");
    await eventually(count, (count) => near(count, TRIANGLES / 2), { what: "the count" });
    assert.equal(await element.getAttribute("reduction"), "50");
    assert(differing(sparse, await seen()) > 500, "the other level is drawn");
    await judged();
    assert(near(await count(), TRIANGLES / 2));
    // Attributes and sliders are one.
    await element.evaluate((vessel) => vessel.setAttribute("pass-band", "0.1"));
    await judged();
    const settings = await element.evaluate((vessel) => vessel.result.report.settings);
    assert.deepEqual([settings.smoothing.pass_band, settings.target], [0.1, { Reduction: 500 }]);
    assert.equal(await element.getByLabel("Pass band").getAttribute("aria-valuetext"), "0.1 ");
    nothingElse();
  });
}

test("what cannot be shown is told in a sentence, and the next address is shown", async (t) => {
  const { page, element, text, count, judged } = await lecture(t);
  await judged();
  const failure = () => eventually(() => text(".failure"), (words) => words !== "", { what: "the failure" });
  const set = (name, value) => element.evaluate((vessel, [name, value]) => vessel.setAttribute(name, value), [name, value]);
  await set("src", "not-there.stl");
  assert.match(await failure(), /^The surface cannot be loaded: the server answers 404\.$/);
  // Nothing of the old surface stays beside it.
  const left = () => element.evaluate(({ result, shadowRoot }) => [result, shadowRoot.querySelector(".stage").hidden, shadowRoot.querySelector(".counts").textContent]);
  assert.deepEqual(await left(), [null, true, ""]);
  await element.evaluate((vessel) => vessel.removeAttribute("src"));
  await element.locator(".failure").waitFor({ state: "hidden" });
  assert.deepEqual(await left(), [null, true, ""]);
  await set("src", "broken.stl");
  await eventually(() => text(".failure"), (words) => words.includes("cut short"));
  await page.route("**/tube-100%.stl", (route) => route.fulfill({ path: join(folder, "tube.stl") }));
  await set("src", "tube-100%.stl");
  await judged();
  await set("src", "http://%");
  await eventually(() => text(".failure"), (words) => words.startsWith("The surface cannot be loaded"));
  assert.deepEqual(await left(), [null, true, ""]);
  await set("src", "tube.stl");
  await judged();
  await set("unit", "feet");
  await eventually(() => text(".failure"), (words) => words.includes("feet"));
  await set("unit", "mm");
  await judged();
  await set("pass-band", "7");
  await eventually(() => text(".failure"), (words) => words === "The pass band must lie between 0.001 and 2, not 7.");
  await set("pass-band", "0.01");
  await judged();
  assert(near(await count(), TRIANGLES / 10));
  assert(await element.locator(".failure").isHidden());

  // A Worker that dies, and a change after it.
  const [worker] = page.workers();
  await worker.evaluate(() => setTimeout(() => { throw new Error("no memory is left"); }));
  await eventually(() => page.workers().length, (left) => left === 0);
  await set("reduction", "95");
  await eventually(count, (count) => near(count, TRIANGLES / 20));
  await judged();
});

test("one that is removed gives its graphics back, and is drawn anew where it is put again", async (t) => {
  const { page, wrong, element, judged } = await lecture(t);
  await judged();
  const lost = await page.evaluate(async () => {
    const vessel = document.querySelector("lumen-vessel");
    const context = vessel.shadowRoot.querySelector("canvas").getContext("webgl2");
    vessel.remove();
    // What was asked for before it was removed.
    await new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)));
    globalThis.removed = vessel;
    return context.isContextLost();
  });
  assert(lost);
  await page.evaluate(() => document.body.append(globalThis.removed));
  await judged();
  const canvas = element.locator("canvas");
  const seen = () => page.evaluate(() => new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)))).then(() => picture(page, canvas));
  await canvas.focus();
  const first = await seen();
  // Turned once, and back.
  await page.keyboard.press("ArrowLeft");
  const turned = await seen();
  assert(Buffer.compare(Buffer.from(first.data), Buffer.from(turned.data)) !== 0, "it is drawn and turned");
  await page.keyboard.press("ArrowRight");
  assert.equal(Buffer.compare(Buffer.from(first.data), Buffer.from((await seen()).data)), 0);
  // Moved, it goes on as it is.
  await page.evaluate(() => document.querySelector("h1").before(globalThis.removed));
  assert.equal(await element.evaluate((vessel) => vessel.shadowRoot.querySelector("canvas").getContext("webgl2").isContextLost()), false);
  assert.deepEqual(wrong, []);
});

test("the page scrolls over a surface that has no focus, and a count of triangles takes the place of the rate", async (t) => {
  const { page, element, count, judged } = await lecture(t);
  await judged();
  const canvas = element.locator("canvas");
  const scrolls = (ctrlKey) => canvas.evaluate((canvas, ctrlKey) => canvas.dispatchEvent(new WheelEvent("wheel", { deltaY: 100, ctrlKey, cancelable: true })), ctrlKey);
  const touch = () => canvas.evaluate((canvas) => getComputedStyle(canvas).touchAction);
  assert.deepEqual([await scrolls(false), await scrolls(true), await touch()], [true, false, "pan-y"]);
  await canvas.click();
  assert.deepEqual([await scrolls(false), await touch()], [false, "none"]);

  await element.evaluate((vessel) => {
    vessel.removeAttribute("reduction");
    vessel.setAttribute("triangles", "500");
  });
  await eventually(count, (count) => near(count, 500), { what: "the count" });
  assert(await element.getByLabel("Reduction").isDisabled());
  await element.evaluate((vessel) => vessel.removeAttribute("triangles"));
  await eventually(() => element.getByLabel("Reduction").isEnabled(), Boolean);
});
