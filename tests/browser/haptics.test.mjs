// A haptic device by WebHID and by Web Serial: paired by a click, served in the trial's Worker, felt and stopped. The device is
// a mock behind `navigator.hid` (fake-hid.js) or `navigator.serial` (fake-serial.js) with the descriptor of the open feeder;
// nothing here was tried on hardware.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { atEntry, atRest, fed, inserted, says, settled } from "./app.mjs";
import { COARSE, dist, eventually, frames, launch, openApp, press, started, twin } from "./browser.mjs";

const beside = (name) => readFile(new URL(name, import.meta.url), "utf8");
const [feeder, collections] = [await beside("fake-feeder.js"), await beside("../haptics/feeder-collections.json")];
const fake = [`const COLLECTIONS = ${collections};`, feeder, await beside("fake-hid.js")].join("\n");
/** The same where Workers have no WebHID: before Chromium 131. */
const fakeInPage = `const SERVED_IN_PAGE = true;\n${fake}`;

/** The feeder at a serial port, in a browser without WebHID: its descriptor's bytes are those of the app's source. */
async function bySerial() {
  const source = await beside("../../src/haptics/feeder.rs");
  const table = source.slice(source.indexOf("DESCRIPTOR: &[u8]")).replace(/\/\/.*/g, "");
  const descriptor = (table.match(/0x[0-9A-F]{2}\b/g) ?? []).map(Number);
  const known = `const FEEDER = { collections: ${collections}, descriptor: ${JSON.stringify(descriptor)} };`;
  return [known, feeder, await beside("fake-serial.js")].join("\n");
}

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

/** A gamepad at rest, whose motors note what they are told. */
function gamepad() {
  globalThis.shaken = [];
  const vibrationActuator = {
    playEffect: async (kind, how) => (globalThis.shaken.push({ kind, ...how }), "complete"),
    reset: async () => (globalThis.shaken.push("reset"), "complete"),
  };
  const pad = Object.create(Gamepad.prototype);
  for (const [key, value] of Object.entries({ axes: [0, 0, 0, 0], buttons: [], vibrationActuator })) {
    Object.defineProperty(pad, key, { value });
  }
  navigator.getGamepads = () => [pad];
}

/** A loudspeaker that notes what it is told: a machine for tests may have none. */
function loudspeaker() {
  globalThis.sounded = [];
  const param = (what) => ({
    value: 0,
    cancelScheduledValues() {
      return this;
    },
    setTargetAtTime(value, from, constant) {
      globalThis.sounded.push({ what, value, from, constant });
      return this;
    },
  });
  const connect = (to) => to;
  globalThis.AudioContext = class {
    currentTime = 0;
    destination = {};
    resume = async () => {};
    createOscillator = () => ({ frequency: param("pitch"), connect, start() {} });
    createGain = () => ({ gain: param("loudness"), connect });
  };
}

/** Opens the app with the mock in the page and in its Workers, and the trial. */
async function openTrial(t, more = [], mock = fake) {
  const worker = await readFile(`${dist}/worker.js`, "utf8");
  const opened = await openApp(t, browser, {
    context: COARSE,
    before: async (page) => {
      await page.addInitScript(mock);
      for (const script of more) await page.addInitScript(script);
    },
    files: { "worker.js": { type: "text/javascript", body: `${mock}\n${worker}` } },
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
const isStop = ({ id, bytes }) => (id === 4 && bytes[1] === 3) || (id === 6 && bytes[0] === 3);
const heard = (page) => page.evaluate(() => globalThis.fakeHid.heard);
const there = (page, name) => twin(page, "button", name).waitFor({ state: "attached", timeout: 60_000 });

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
  const stop = last.findLastIndex(isStop);
  assert(stop >= 0, "a stop was sent");
  assert.equal(last.slice(stop).filter(isStart).length, 0, "and nothing starts after it");
  assert.deepEqual(await page.evaluate(() => globalThis.fakeHid.wrong), [], "every report was of its length");
  assert.deepEqual(wrong, []);
});

test("leaving the window ends the force at once, unplugging pauses the trial, plugging in goes on", { timeout: 300_000 }, async (t) => {
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
  const all = await eventually(async () => (await heard(page)).slice(count), (all) => all.some(isStop), { what: "the stop" });
  t.diagnostic(`the stop came ${(all.find(isStop).at - left).toFixed(1)} ms after the window was left`);
  await atRest(page, 300);
  const later = (await heard(page)).slice(count);
  assert.equal(later.slice(later.findLastIndex(isStop)).filter(isStart).length, 0, "and nothing starts after it");
  await says(page, /ended as the window was left/, { what: "why" });

  await page.evaluate(() => globalThis.fakeHid.plug(false));
  await says(page, /no longer there/, { what: "that it is gone" });
  await says(page, /^Paused/, { what: "the trial, which waits" });

  const [before, start] = [(await heard(page)).length, await inserted(page)];
  await page.evaluate(() => globalThis.fakeHid.plug(true));
  await there(page, "Arm force...");
  await says(page, /holds the wire again; its force is not armed/, { what: "that it is back" });
  // What it did while it was out is not made up for; from here on it feeds, and is not pushed.
  await page.evaluate(() => globalThis.fakeHid.go(1, 0, 1000));
  await fed(page, start, 0.5);
  assert.equal((await heard(page)).slice(before).filter(isStart).length, 0, "no effect is started before it is armed again");
});

test("where Workers have no WebHID the page opens the device, and all else is as in the Worker", { timeout: 300_000 }, async (t) => {
  const { page, wrong } = await openTrial(t, [], fakeInPage);
  assert.equal(await page.evaluate(() => typeof navigator.hid), "object", "the page has it");
  await choose(page, "Pair a device...");
  await there(page, "Arm force...");
  assert.equal((await heard(page)).filter(({ id }) => id === 4).length, 0, "no effect is started before it is armed");
  const start = await inserted(page);
  await page.evaluate(() => globalThis.fakeHid.go(0.8, 0, 2000));
  await fed(page, start, 2);

  await find(page, "button", "Arm force...");
  await find(page, "button", "Arm force");
  await there(page, "Stop force");
  await page.evaluate(() => globalThis.fakeHid.go(-0.5, 0.3, 1500));
  await eventually(() => heard(page), (all) => all.some(isStart), { what: "an effect that is started" });
  await page.evaluate(() => dispatchEvent(new Event("blur")));
  await says(page, /ended as the window was left/, { what: "why" });
  await eventually(() => heard(page), (all) => all.some(isStop), { what: "the stop" });
  await atRest(page, 300);
  const all = await heard(page);
  assert.equal(all.slice(all.findLastIndex(isStop)).filter(isStart).length, 0, "and nothing starts after it");

  await page.evaluate(() => globalThis.fakeHid.plug(false));
  await says(page, /no longer there/, { what: "that it is gone" });
  await says(page, /^Paused/, { what: "the trial, which waits" });
  const [before, out] = [(await heard(page)).length, await inserted(page)];
  await page.evaluate(() => globalThis.fakeHid.plug(true));
  await there(page, "Arm force...");
  await says(page, /holds the wire again; its force is not armed/, { what: "that it is back" });
  await page.evaluate(() => globalThis.fakeHid.go(1, 0, 1000));
  await fed(page, out, 0.5);
  assert.equal((await heard(page)).slice(before).filter(isStart).length, 0, "no effect is started before it is armed again");

  // Another is chosen: the page lets the device go.
  await choose(page, "Virtual device");
  const isOpen = () => page.evaluate(async () => (await navigator.hid.getDevices())[0].opened);
  await eventually(isOpen, (is) => !is, { what: "the device, which is closed" });
  assert.deepEqual(await page.evaluate(() => globalThis.fakeHid.wrong), [], "every report was of its length");
  assert.deepEqual(wrong, []);
});

test("by serial the feeder is paired, feeds, pushes back once armed, is unplugged and plugged in, and let go", { timeout: 300_000 }, async (t) => {
  const { page, wrong } = await openTrial(t, [], await bySerial());
  const serial = (more) => page.evaluate(`globalThis.fakeSerial.${more}`);
  await says(page, /reaches the open feeder alone, by serial/, { what: "what this browser reaches" });
  await choose(page, "Pair by serial...");
  await there(page, "Arm force...");
  assert.equal((await serial("heard")).filter(isStart).length, 0, "no effect is started before it is armed");
  const start = await inserted(page);
  await serial("go(0.8, 0, 2000)");
  await fed(page, start, 2);

  await find(page, "button", "Arm force...");
  await find(page, "button", "Arm force");
  await there(page, "Stop force");
  await serial("go(-0.5, 0.3, 1500)");
  await eventually(() => serial("heard"), (all) => all.some(isStart), { what: "an effect that is started" });
  await page.keyboard.press("Escape");
  await there(page, "Arm force...");
  await eventually(() => serial("heard"), (all) => all.some(isStop), { what: "the stop" });
  await atRest(page, 300);
  const all = await serial("heard");
  assert.equal(all.slice(all.findLastIndex(isStop)).filter(isStart).length, 0, "and nothing starts after it");

  await serial("plug(false)");
  await says(page, /no longer there/, { what: "that it is gone" });
  await says(page, /^Paused/, { what: "the trial, which waits" });
  const [before, out] = [(await serial("heard")).length, await inserted(page)];
  await serial("plug(true)");
  await there(page, "Arm force...");
  await says(page, /holds the wire again; its force is not armed/, { what: "that it is back" });
  await serial("go(1, 0, 1000)");
  await fed(page, out, 0.5);
  assert.equal((await serial("heard")).slice(before).filter(isStart).length, 0, "no effect is started before it is armed again");

  await choose(page, "None");
  await eventually(() => serial("isOpen"), (is) => !is, { what: "the port, which is closed" });
  assert.deepEqual(await serial("wrong"), [], "every frame was whole, and every report of its length");
  assert.deepEqual(wrong, []);
});

test("without a device the virtual one holds the wire, its axes are remembered, a gamepad shakes, and a tone sounds", { timeout: 300_000 }, async (t) => {
  const { page, wrong } = await openTrial(t, [gamepad, loudspeaker]);
  await choose(page, "Virtual device");
  await there(page, "Arm force...");
  const feeds = () => twin(page, "combobox", "Feed: axis").textContent();
  assert.equal(await feeds(), "X");
  await find(page, "combobox", "Feed: axis");
  await press(page, "option", "Rx");
  await there(page, "Forget axes");
  // A virtual device has no numbers.
  const kept = () => page.evaluate(() => Object.values({ ...localStorage }).some((text) => text.includes("0000:0000:")));
  await eventually(kept, (is) => is, { what: "the axes in what is kept" });

  await page.reload();
  await started(page);
  await settled(page);
  await press(page, "button", "Trial");
  await atEntry(page);
  await choose(page, "Virtual device");
  await eventually(feeds, (axis) => axis === "Rx", { what: "the axis that was chosen" });
  await find(page, "button", "Forget axes");
  await eventually(feeds, (axis) => axis === "X", { what: "the axis that is proposed" });
  await eventually(kept, (is) => !is, { what: "nothing of it in what is kept" });

  // A gamepad shakes by the force once it is armed, and is still as the window is left.
  const shakes = () => page.evaluate(() => globalThis.shaken.filter((it) => it !== "reset"));
  await find(page, "button", "Arm rumble...");
  assert.deepEqual(await shakes(), [], "nothing before it is armed");
  await find(page, "button", "Arm rumble");
  await there(page, "Stop rumble");
  const sounded = () => page.evaluate(() => globalThis.sounded);
  assert.deepEqual(await sounded(), [], "nothing sounds before it is turned on");
  await find(page, "checkbox", "Sound of the force");
  // Slowly: a fast wire may be at its target before a slow machine has drawn it often enough to shake.
  await page.keyboard.down("w");
  const heard = await eventually(shakes, (all) => all.length > 0, { timeout: 60_000, what: "a shake" });
  for (const { kind, duration, strongMagnitude, weakMagnitude } of heard) {
    assert.deepEqual([kind, duration, weakMagnitude], ["dual-rumble", 100, strongMagnitude]);
    assert(strongMagnitude > 0 && strongMagnitude <= 0.4, `${strongMagnitude} is within the cap`);
  }
  const isPitch = ({ what }) => what === "pitch";
  const tones = await eventually(sounded, (all) => all.some(isPitch), { timeout: 60_000, what: "a tone" });
  for (const tone of tones) {
    const [least, most] = isPitch(tone) ? [220, 880] : [0, 0.2 + 1e-6];
    assert(tone.value >= least && tone.value <= most, `${tone.what} ${tone.value} is within the bounds`);
  }
  const ending = tones[tones.findIndex(isPitch) + 1];
  assert(ending.what === "loudness" && ending.value === 0 && Math.abs(ending.from - 0.1) < 1e-9, "each tone ends by itself");
  await page.evaluate(() => dispatchEvent(new Event("blur")));
  await says(page, /ended as the window was left/, { what: "why it is still" });
  const count = (await shakes()).length;
  await frames(page, 30);
  assert.equal((await shakes()).length, count, "nothing after it");
  assert.equal(await page.evaluate(() => globalThis.shaken.at(-1)), "reset");
  await page.keyboard.up("w");
  assert.deepEqual(wrong, []);
});
