// A haptic device by WebHID: paired by a click, served in the trial's Worker, felt and stopped. The device is a mock behind
// `navigator.hid` (fake-hid.js) with the descriptor of the open feeder; nothing here was tried on hardware.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { atEntry, atRest, fed, inserted, settled } from "./app.mjs";
import { dist, eventually, frames, launch, openApp, press, texts, twin } from "./browser.mjs";

const beside = (name) => readFile(new URL(name, import.meta.url), "utf8");
const fake = (await beside("fake-hid.js")).replace(/^/, `const COLLECTIONS = ${await beside("../haptics/feeder-collections.json")};\n`);

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

/** Opens the app with the mock in the page and in its Workers, and the trial. */
async function openTrial(t) {
  const worker = await readFile(`${dist}/worker.js`, "utf8");
  const opened = await openApp(t, browser, {
    before: (page) => page.addInitScript(fake),
    files: { "worker.js": { type: "text/javascript", body: `${fake}\n${worker}` } },
  });
  await settled(opened.page);
  await press(opened.page, "button", "Trial");
  await atEntry(opened.page);
  return opened;
}

/** Turns the wheel over the panel until a control is in sight, and presses it. */
async function find(page, role, name) {
  await page.mouse.move(150, 500);
  await eventually(
    async () => {
      const box = await twin(page, role, name).first().boundingBox({ timeout: 500 }).catch(() => null);
      if (box && box.y > 60 && box.y + box.height < 740) return true;
      await page.mouse.wheel(0, box && box.y < 60 ? -120 : 120);
      await frames(page, 10);
      return false;
    },
    (is) => is,
    { what: `${role} ${name}` },
  );
  await press(page, role, name);
}

async function choose(page, name) {
  await find(page, "combobox", "Device");
  await twin(page, "option", name).waitFor({ state: "attached" });
  await press(page, "option", name);
}

const isStart = ({ id, bytes }) => id === 4 && bytes[1] < 3;
const heard = (page) => page.evaluate(() => globalThis.fakeHid.heard);
const there = (page, name) => twin(page, "button", name).waitFor({ state: "attached", timeout: 60_000 });
const shows = (page, pattern, what) => eventually(() => texts(page), (all) => all.some((text) => pattern.test(text)), { what });

test("a device is paired, feeds the wire, pushes back once armed, and is stopped", { timeout: 300_000 }, async (t) => {
  const { page, wrong } = await openTrial(t);
  await choose(page, "Pair a device...");
  await there(page, "Arm force...");
  assert.equal((await heard(page)).filter(({ id }) => id === 4).length, 0, "no effect is started before it is armed");

  const start = await inserted(page);
  await page.evaluate(() => globalThis.fakeHid.go(0.8, 0, 2000));
  await fed(page, start, 2);
  t.diagnostic(`fed to ${await inserted(page)} cm`);

  await find(page, "button", "Arm force...");
  await find(page, "button", "Arm force");
  await there(page, "Stop force");
  // Once the hand pushes, effects are started and renewed.
  await page.evaluate(() => globalThis.fakeHid.go(-0.5, 0.3, 1500));
  await eventually(() => heard(page), (all) => all.some(isStart), { what: "an effect that is started" });

  // Escape stops it.
  await page.keyboard.press("Escape");
  await there(page, "Arm force...");
  await atRest(page, 300);
  const last = await heard(page);
  const stop = last.findLastIndex(({ id, bytes }) => (id === 4 && bytes[1] === 3) || (id === 6 && bytes[0] === 3));
  assert(stop >= 0, "a stop was sent");
  assert.equal(last.slice(stop).filter(isStart).length, 0, "and nothing starts after it");
  assert.deepEqual(await page.evaluate(() => globalThis.fakeHid.wrong), [], "every report was of its length");
  assert.deepEqual(wrong, []);
});

test("leaving the window ends the force at once, and unplugging pauses the trial", { timeout: 300_000 }, async (t) => {
  const { page } = await openTrial(t);
  await choose(page, "Pair a device...");
  await there(page, "Arm force...");
  await find(page, "button", "Arm force...");
  await find(page, "button", "Arm force");
  await page.evaluate(() => globalThis.fakeHid.go(0.6, 0, 1500));
  await eventually(() => heard(page), (all) => all.some(isStart), { what: "an effect that is started" });
  const [count, left] = await page.evaluate(() => {
    const count = globalThis.fakeHid.heard.length;
    dispatchEvent(new Event("blur"));
    return [count, globalThis.fakeHid.now()];
  });
  const isStop = ({ id, bytes }) => (id === 4 && bytes[1] === 3) || (id === 6 && bytes[0] === 3);
  const all = await eventually(async () => (await heard(page)).slice(count), (all) => all.some(isStop), { what: "the stop" });
  t.diagnostic(`the stop came ${(all.find(isStop).at - left).toFixed(1)} ms after the window was left`);
  assert.equal(all.slice(all.findLastIndex(isStop)).filter(isStart).length, 0, "and nothing starts after it");
  await shows(page, /ended as the window was left/, "why");

  await page.evaluate(() => globalThis.fakeHid.plug(false));
  await shows(page, /no longer there/, "that it is gone");
  await shows(page, /^Paused/, "the trial, which waits");
});

test("without a device the virtual one holds the wire", { timeout: 300_000 }, async (t) => {
  const { page, wrong } = await openTrial(t);
  await choose(page, "Virtual device");
  await there(page, "Arm force...");
  assert.deepEqual(wrong, []);
});
