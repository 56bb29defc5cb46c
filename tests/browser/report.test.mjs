// The page for the record, saved in the browser and read by others.

import assert from "node:assert/strict";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { inflateSync } from "node:zlib";
import { settled } from "./app.mjs";
import { COARSE, launch, openApp, picture, press, twin } from "./browser.mjs";
import { pathToFileURL } from "node:url";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

/** The text that a PDF shows: the strings of its unpacked pages, in their order. */
function textOf(bytes) {
  const raw = bytes.toString("latin1");
  const pages = [];
  for (const { index } of raw.matchAll(/>>\s*stream\r?\n/g)) {
    const head = raw.slice(raw.lastIndexOf("obj", index), index);
    if (!head.includes("/Subtype /Image") && head.includes("/FlateDecode")) {
      const start = raw.indexOf("stream", index) + 7;
      pages.push(inflateSync(bytes.subarray(start), { finishFlush: 2 }).toString("latin1"));
    }
  }
  return pages.flatMap((page) => [...page.matchAll(/\(((?:\\.|[^\\)])*)\) Tj/g)].map((found) => found[1])).join(" ");
}

/** Saves what a button of the report's sheet names and returns the file's name and bytes. */
async function saved(page, item) {
  await press(page, "button", "Save");
  await press(page, "menuitem", "Report...");
  const download = page.waitForEvent("download");
  await press(page, "button", item);
  const file = await download;
  const path = await file.path();
  return { name: file.suggestedFilename(), bytes: await readFile(path) };
}

test("a report is saved as PDF, whose text can be searched, and as a page that needs nothing else", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE, query: "" });
  await settled(page);
  // The vessels come last.
  await twin(page, "button", "Show vessels").and(page.locator(":not([aria-disabled=true])")).waitFor();

  const pdf = await saved(page, "Save as PDF...");
  assert.equal(pdf.name, "abdominal-aorta-report.pdf");
  const text = textOf(pdf.bytes);
  for (const part of ["Safe to simulate on", "Not for clinical decisions", "branch 1", "pass band 0.01", "As opened"]) {
    assert(text.includes(part), `${part} in ${text}`);
  }

  const html = await saved(page, "Save as web page...");
  assert.equal(html.name, "abdominal-aorta-report.html");
  const other = await browser.newPage();
  t.after(() => other.close());
  const asked = [];
  other.on("request", (request) => asked.push(request.url()));
  await other.setContent(html.bytes.toString());
  assert.deepEqual(asked.filter((url) => !url.startsWith("data:")), []);
  assert.equal(await other.locator("img").count(), 4);
  assert.equal(await other.locator("script").count(), 0);
  const drawn = await other.locator("img").evaluateAll((images) => images.every((image) => image.naturalWidth > 0));
  assert(drawn, "the pictures are pictures");
  assert.deepEqual(wrong, []);
});

/** How many points of two pictures differ, in their left and in their right half, or the upper and the lower one. */
function halves(isTall, one, other) {
  assert.deepEqual([one.width, one.height], [other.width, other.height]);
  const counts = [0, 0];
  for (let i = 0; i < one.data.length; i += 4) {
    const isSecond = isTall ? i / 4 / one.width >= one.height / 2 : (i / 4) % one.width >= one.width / 2;
    if ([0, 1, 2].some((k) => Math.abs(one.data[i + k] - other.data[i + k]) > 24)) counts[Number(isSecond)]++;
  }
  return counts;
}

test("the surface in a saved page is turned, zoomed and saved there, on a desk and on a telephone, and asks for nothing", async (t) => {
  const { page } = await openApp(t, browser, { context: COARSE });
  const all = await settled(page);
  await twin(page, "button", "Show vessels").and(page.locator(":not([aria-disabled=true])")).waitFor();
  const html = await saved(page, "Save as web page with the surface...");
  assert(html.bytes.length < 5e6, `${html.bytes.length} bytes`);
  const folder = await mkdtemp(join(tmpdir(), "lumen-"));
  t.after(() => rm(folder, { recursive: true }));
  const file = join(folder, html.name);
  await writeFile(file, html.bytes);

  for (const options of [{ viewport: { width: 1280, height: 800 } }, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 }]) {
    const context = await browser.newContext({ ...options, colorScheme: options.hasTouch ? "dark" : "light" });
    t.after(() => context.close());
    const other = await context.newPage();
    const [wrong, asked] = [[], []];
    other.on("console", (message) => message.type() === "error" && wrong.push(message.text()));
    other.on("pageerror", (error) => wrong.push(String(error)));
    other.on("request", (request) => asked.push(request.url()));
    await other.goto(pathToFileURL(file).href);
    const canvas = other.locator("#viewer canvas");
    await canvas.scrollIntoViewIfNeeded();
    const seen = () => other.evaluate(() => new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)))).then(() => picture(other, canvas));
    if (process.env.LUMEN_SHOTS) await other.screenshot({ path: join(process.env.LUMEN_SHOTS, `viewer-${options.viewport.width}.png`) });
    const differing = (one, other) => halves(options.hasTouch ?? false, one, other);
    const first = await seen();
    const plain = { ...first, data: Uint8Array.from(first.data, (_, i) => first.data[(8 * first.width + 8) * 4 + (i % 4)]) };
    const [shaded, lines] = differing(first, plain);
    t.diagnostic(`${options.viewport.width} points wide: ${shaded} pixels shaded, ${lines} of lines, of ${first.width} x ${first.height}`);
    assert(shaded > 0.01 * first.width * first.height && lines > 0.005 * first.width * first.height, "both are drawn");

    const box = await canvas.boundingBox();
    const [x, y] = [box.x + box.width / 4, box.y + box.height / 3];
    if (options.hasTouch) {
      const touch = await context.newCDPSession(other);
      const at = (type, ...points) => touch.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
      await at("touchStart", [x, y]);
      await at("touchMove", [x + 40, y]);
      await at("touchEnd");
      const turned = await seen();
      assert(differing(first, turned).every((count) => count > 500), "a finger turns both");
      await at("touchStart", [x - 20, y], [x + 20, y]);
      await at("touchMove", [x - 60, y], [x + 60, y]);
      await at("touchEnd");
      assert(differing(turned, await seen()).every((count) => count > 500), "two fingers zoom both");
    } else {
      await other.mouse.move(x, y);
      await other.mouse.down();
      await other.mouse.move(x + 80, y + 20, { steps: 4 });
      await other.mouse.up();
      const turned = await seen();
      assert(differing(first, turned).every((count) => count > 500), "both turn");
      await other.mouse.wheel(0, -300);
      assert(differing(turned, await seen()).every((count) => count > 500), "both are zoomed");
      await canvas.focus();
      await other.keyboard.press("0");
      // But for the corners of the ring that says where the keyboard is.
      assert(differing(first, await seen()).every((count) => count < 10), "0 shows the whole again");
      await other.keyboard.press("ArrowLeft");
      assert(differing(first, await seen()).every((count) => count > 500), "keys turn");
      await other.keyboard.press("0");
    }
    const before = await seen();
    await other.getByRole("radio", { name: /^Before/ }).check();
    const [, denser] = differing(before, await seen());
    assert(denser > 500, "the wireframe before is another");

    // What is saved has the triangles that the page names.
    const named = await other.getByRole("radio").evaluateAll((radios) => radios.map((radio) => Number(radio.parentElement.textContent.replace(/\D/g, ""))));
    assert(all.some((text) => text.includes(`${named[0].toLocaleString("en")} of`)), `${named}`);
    const download = other.waitForEvent("download");
    await other.getByRole("button", { name: "Save as GLB" }).click();
    const glb = await readFile(await (await download).path());
    const description = JSON.parse(glb.subarray(20, 20 + glb.readUInt32LE(12)).toString());
    assert.deepEqual([glb.readUInt32LE(0), glb.readUInt32LE(8), description.accessors[1].count], [0x46546c67, glb.length, 3 * named[1]]);
    assert.deepEqual(wrong, []);
    assert.deepEqual(asked.filter((url) => !/^(data|blob):/.test(url)), [pathToFileURL(file).href]);
  }
});

test("a turntable is saved as a video that plays", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE });
  await settled(page);
  await press(page, "button", "Save");
  const download = page.waitForEvent("download", { timeout: 120_000 });
  await press(page, "menuitem", "Turntable as video (WebM)...");
  const file = await download;
  assert.equal(file.suggestedFilename(), "abdominal-aorta-turntable.webm");
  const bytes = await readFile(await file.path());
  const other = await browser.newPage();
  t.after(() => other.close());
  const played = await other.evaluate(async (address) => {
    const video = Object.assign(document.createElement("video"), { muted: true, src: address, playbackRate: 4 });
    const until = (event) => new Promise((resolve, reject) => (video.addEventListener(event, resolve), (video.onerror = () => reject(new Error(video.error.message)))));
    await until("loadeddata");
    const seen = () => {
      const canvas = Object.assign(document.createElement("canvas"), { width: video.videoWidth, height: video.videoHeight });
      const context = canvas.getContext("2d");
      context.drawImage(video, 0, 0);
      return context.getImageData(0, 0, canvas.width, canvas.height).data;
    };
    const first = seen();
    const sides = new Promise((resolve) => video.addEventListener("timeupdate", () => video.currentTime > 0.5 && resolve(seen())));
    await Promise.all([until("ended"), video.play()]);
    const side = await sides;
    const differing = first.filter((value, i) => Math.abs(value - side[i]) > 24).length;
    return { seconds: video.currentTime, longer: Math.max(video.videoWidth, video.videoHeight), differing };
  }, `data:video/webm;base64,${bytes.toString("base64")}`);
  // 48 frames of 80 ms, or longer where the machine is slow.
  assert(played.seconds > 3.5 && played.longer === 480 && played.differing > 500, JSON.stringify(played));
  assert.deepEqual(wrong, []);
});
