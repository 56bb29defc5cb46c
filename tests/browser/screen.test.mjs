// The window changes its size. And the finger in place of the mouse.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { REDUCTION, atEntry, atRest, fed, settled, shownTriangles, silhouette, views } from "./app.mjs";
import { COARSE, eventually, frames, launch, openApp, press, twin, value } from "./browser.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

/** A phone; with `--long` with the pixels it has, else with another number than one a point: drawing is what takes the time. */
const PHONE = {
  viewport: { width: 390, height: 844 },
  deviceScaleFactor: process.env.LUMEN_LONG ? 2 : COARSE.deviceScaleFactor,
  hasTouch: true,
  isMobile: true,
};

/** Size of the canvas in CSS pixels and in its own. */
const sizes = (page) =>
  page.evaluate(() => {
    const canvas = document.getElementById("lumen");
    const { width, height } = canvas.getBoundingClientRect();
    return { css: [width, height], own: [canvas.width, canvas.height] };
  });

/** Every control lies within the window. */
async function controlsAreWithin(page, [width, height]) {
  for (const name of ["Open...", "Save"]) {
    const box = await twin(page, "button", name).boundingBox();
    assert(box.x >= 0 && box.y >= 0 && box.x + box.width <= width && box.y + box.height <= height, `${name}: ${JSON.stringify(box)}`);
  }
}

test("the picture follows the window's size", async (t) => {
  const { page, wrong } = await openApp(t, browser);
  await settled(page);
  const device = await page.context().newCDPSession(page);
  // Not the pixels of a point: the emulation does not reach the canvas's own pixels (`devicePixelContentBoxSize`).
  for (const [width, height] of [[1280, 800], [900, 600], [1024, 700], [480, 800], [1280, 800]]) {
    await device.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
    const wanted = [width, height];
    await eventually(() => sizes(page), ({ css, own }) => css[0] === width && own[0] === wanted[0] && own[1] === wanted[1], {
      what: `a canvas of ${wanted} pixels`,
    });
    await frames(page, 5);
    await controlsAreWithin(page, [width, height]);
    const view = await views.shaded(page).boundingBox();
    const pixels = await silhouette(page, views.shaded(page));
    const part = pixels / (view.width * view.height);
    t.diagnostic(`${width} x ${height}: the vessel covers ${(100 * part).toFixed(1)} % of its view`);
    assert(part > 0.02 && part < 0.7, `the vessel covers ${part} of its view`);
  }
  assert.deepEqual(wrong, []);
});

/** Touches at these points, as { x, y, id }, for one event. */
const touch = (session, type, points) =>
  session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(({ x, y, id = 0 }) => ({ x, y, id, radiusX: 5, radiusY: 5, force: 1 })) });

const middle = ({ x, y, width, height }) => ({ x: x + width / 2, y: y + height / 2 });

/** Swipes the panel up from below its handle until a control is in sight; its box. */
async function swipedTo(page, session, control) {
  const { height } = PHONE.viewport;
  for (let i = 0; i < 9; i++) {
    const box = await control.boundingBox();
    if (box.y + box.height < height - 48) return box;
    const x = [250, 200, 340][i % 3];
    await touch(session, "touchStart", [{ x, y: 580 }]);
    for (let y = 580; y > 390; y -= 30) {
      await touch(session, "touchMove", [{ x, y }]);
      await frames(page, 2);
    }
    await touch(session, "touchEnd", []);
    await frames(page, 10);
  }
  throw new Error(`the control is still at ${JSON.stringify(await control.boundingBox())}`);
}

test("a finger moves the slider, turns the view, and two of them zoom", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: PHONE });
  const shown = shownTriangles(await settled(page));
  const session = await page.context().newCDPSession(page);

  const slider = twin(page, "slider", REDUCTION);
  const rate = await value(slider);
  const box = await swipedTo(page, session, slider);
  const at = (part) => [{ x: box.x + box.width * part, y: box.y + box.height / 2 }];
  await touch(session, "touchStart", at(0.8));
  for (const part of [0.7, 0.6, 0.5]) {
    await touch(session, "touchMove", at(part));
    await frames(page, 2);
  }
  await touch(session, "touchEnd", []);
  await eventually(() => value(slider), (now) => now < rate, { what: "the slider" });
  assert.notEqual(shownTriangles(await settled(page)), shown, "another level is shown");

  const view = middle(await views.shaded(page).boundingBox());
  const pixels = () => silhouette(page, views.shaded(page));
  const before = await pixels();
  const pair = (gap) => [{ x: view.x - gap, y: view.y, id: 0 }, { x: view.x + gap, y: view.y, id: 1 }];
  await touch(session, "touchStart", pair(80));
  for (let gap = 80; gap >= 40; gap -= 5) {
    await touch(session, "touchMove", pair(gap));
    await frames(page, 2);
  }
  await touch(session, "touchEnd", []);
  await frames(page, 5);
  const small = await pixels();
  assert(small < 0.6 * before, `two fingers drawn together: ${small} pixels of ${before}`);

  const turned = await page.screenshot({ clip: await views.shaded(page).boundingBox() });
  await touch(session, "touchStart", [view]);
  for (let x = 0; x <= 60; x += 10) {
    await touch(session, "touchMove", [{ x: view.x + x, y: view.y }]);
    await frames(page, 2);
  }
  await touch(session, "touchEnd", []);
  await frames(page, 5);
  assert.notDeepEqual(await page.screenshot({ clip: await views.shaded(page).boundingBox() }), turned, "one finger turns");
  assert.deepEqual(wrong, []);
});

test("a finger on the pad feeds the wire for as long as it is there", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: { ...COARSE, viewport: { width: 1280, height: 800 }, hasTouch: true } });
  await settled(page);
  const session = await page.context().newCDPSession(page);
  await press(page, "button", "Trial");
  const start = await atEntry(page);
  const pad = await twin(page, "slider", "Feed pad").boundingBox();
  const held = [{ x: pad.x + pad.width * 0.8, y: pad.y + pad.height / 2 }];
  await touch(session, "touchStart", held);
  await fed(page, start);
  await touch(session, "touchEnd", []);
  await atRest(page, 1000);
  assert.deepEqual(wrong, []);
});
