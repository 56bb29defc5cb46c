// A haptic device by WebHID and by Web Serial: paired by a click, served in the trial's Worker, felt and stopped. The device is
// a mock behind `navigator.hid` (fake-hid.js) or `navigator.serial` (fake-serial.js) with the descriptor of the open feeder;
// nothing here was tried on hardware.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { atEntry, atRest, fed, inserted, says, settled } from "./app.mjs";
import { COARSE, dist, eventually, frames, launch, openApp, press, started, twin } from "./browser.mjs";

const beside = (name) => readFile(new URL(name, import.meta.url), "utf8");
const [feeder, collections] = [await beside("fake-feeder.js"), await beside("../../crates/lumen-haptics/fixtures/feeder-collections.json")];
const fake = [`const COLLECTIONS = ${collections};`, feeder, await beside("fake-hid.js")].join("\n");
/** The same where Workers have no WebHID: before Chromium 131. */
const fakeInPage = `const SERVED_IN_PAGE = true;\n${fake}`;

/** The feeder at a serial port, in a browser without WebHID: its descriptor's bytes are those of the app's source. */
async function bySerial() {
  const source = await beside("../../crates/lumen-feeder-protocol/src/feeder.rs");
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
  // What is scrolled up goes behind the panel's head, whose last button this is.
  const head = await twin(page, "button", "Close").boundingBox();
  const top = head.y + head.height + 8;
  await eventually(
    async () => {
      const box = await twin(page, role, name).first().boundingBox({ timeout: 500 }).catch(() => null);
      if (box && box.y > top && box.y + box.height < 740) return true;
      await page.mouse.wheel(0, box && box.y < top ? -120 : 120);
      await frames(page, 10);
      return false;
    },
    (is) => is,
    { what: `${role} ${name}` },
  );
  await press(page, role, name);
}

async function choose(page, name) {
  const option = twin(page, "option", name);
  await find(page, "combobox", "Device");
  await option.waitFor({ state: "attached" });
  await press(page, "option", name);
  await option.waitFor({ state: "detached" });
  // The panel is as long as the device's controls have it: the next list stands elsewhere.
  await frames(page, 20);
}

const isStart = ({ id, bytes }) => id === 4 && bytes[1] < 3;
const isStop = ({ id, bytes }) => (id === 4 && bytes[1] === 3) || (id === 6 && bytes[0] === 3);
const there = (page, name) => twin(page, "button", name).waitFor({ state: "attached", timeout: 60_000 });

/** A mock in the page, by HID or by serial: what is asked of it there. */
const byHid = (page) => (more) => page.evaluate(`globalThis.fakeHid.${more}`);
const bySerialLine = (page) => (more) => page.evaluate(`globalThis.fakeSerial.${more}`);

/** Arms the force, and has the hand push until an effect is started. */
async function pushed(page, fake, to = "-0.5, 0.3") {
  await find(page, "button", "Arm force...");
  await find(page, "button", "Arm force");
  await there(page, "Stop force");
  await fake(`go(${to}, 1500)`);
  await eventually(() => fake("heard"), (all) => all.some(isStart), { what: "an effect that is started" });
}

/** After the last stop nothing is started. */
async function isStopped(page, fake) {
  await eventually(() => fake("heard"), (all) => all.some(isStop), { what: "the stop" });
  await atRest(page, 300);
  const all = await fake("heard");
  assert.equal(all.slice(all.findLastIndex(isStop)).filter(isStart).length, 0, "and nothing starts after it");
}

/** Pulled out, the device pauses the trial; plugged in again it holds the wire, unarmed. */
async function replugged(page, fake) {
  await fake("plug(false)");
  await says(page, /no longer there/, { what: "that it is gone" });
  await says(page, /^Paused/, { what: "the trial, which waits" });
  const [before, start] = [(await fake("heard")).length, await inserted(page)];
  await fake("plug(true)");
  await there(page, "Arm force...");
  await says(page, /holds the wire again; its force is not armed/, { what: "that it is back" });
  // What it did while it was out is not made up for; from here on it feeds, and is not pushed.
  await fake("go(1, 0, 1000)");
  await fed(page, start, 0.5);
  assert.equal((await fake("heard")).slice(before).filter(isStart).length, 0, "no effect is started before it is armed again");
}

test("a device is paired, feeds the wire, pushes back once armed, and is stopped", { timeout: 300_000 }, async (t) => {
  const { page, wrong } = await openTrial(t);
  const fake = byHid(page);
  await choose(page, "Pair a device...");
  await there(page, "Arm force...");
  assert.equal((await fake("heard")).filter(({ id }) => id === 4).length, 0, "no effect is started before it is armed");

  const start = await inserted(page);
  await fake("go(0.8, 0, 2000)");
  await fed(page, start, 2);
  t.diagnostic(`fed to ${await inserted(page)} cm`);

  await pushed(page, fake);
  // Escape stops it.
  await page.keyboard.press("Escape");
  await there(page, "Arm force...");
  await isStopped(page, fake);
  assert.deepEqual(await fake("wrong"), [], "every report was of its length");
  assert.deepEqual(wrong, []);
});

test("leaving the window ends the force at once, unplugging pauses the trial, plugging in goes on", { timeout: 300_000 }, async (t) => {
  const { page } = await openTrial(t);
  const fake = byHid(page);
  await choose(page, "Pair a device...");
  await there(page, "Arm force...");
  await pushed(page, fake, "0.6, 0");
  const [count, left] = await page.evaluate(() => {
    const count = globalThis.fakeHid.heard.length;
    dispatchEvent(new Event("blur"));
    return [count, globalThis.fakeHid.now()];
  });
  const all = await eventually(async () => (await fake("heard")).slice(count), (all) => all.some(isStop), { what: "the stop" });
  t.diagnostic(`the stop came ${(all.find(isStop).at - left).toFixed(1)} ms after the window was left`);
  await isStopped(page, fake);
  await says(page, /ended as the window was left/, { what: "why" });
  await replugged(page, fake);
});

test("where Workers have no WebHID the page opens the device, and all else is as in the Worker", { timeout: 300_000 }, async (t) => {
  const { page, wrong } = await openTrial(t, [], fakeInPage);
  const fake = byHid(page);
  assert.equal(await page.evaluate(() => typeof navigator.hid), "object", "the page has it");
  await choose(page, "Pair a device...");
  await there(page, "Arm force...");
  assert.equal((await fake("heard")).filter(({ id }) => id === 4).length, 0, "no effect is started before it is armed");
  const start = await inserted(page);
  await fake("go(0.8, 0, 2000)");
  await fed(page, start, 2);

  await pushed(page, fake);
  await page.evaluate(() => dispatchEvent(new Event("blur")));
  await says(page, /ended as the window was left/, { what: "why" });
  await isStopped(page, fake);
  await replugged(page, fake);

  // What the hand did while the page hung is not made up for.
  await atRest(page, 300);
  const held = await inserted(page);
  await fake("hang(1000, [0.8, 0.6, 0.4, 0.2, 0])");
  await atRest(page, 600);
  assert(Math.abs((await inserted(page)) - held) < 0.1, `the wire was at ${held} cm, and is at ${await inserted(page)}`);
  // From there on it is held again.
  await fake("go(0.8, 0, 1000)");
  await fed(page, held, 0.5);

  // Let go and chosen again before it has been closed, it is closed first.
  await fake("closingMs = 3000");
  await choose(page, "None");
  await choose(page, "Lumen feeder");
  await there(page, "Arm force...");
  await new Promise((done) => setTimeout(done, 3500));
  const again = await inserted(page);
  await fake("go(0, 0, 500)");
  await frames(page, 20);
  await fake("go(1, 0, 4000)");
  await fed(page, again, 0.5);

  // Another is chosen: the page lets the device go.
  await choose(page, "Virtual device");
  const isOpen = () => page.evaluate(async () => (await navigator.hid.getDevices())[0].opened);
  await eventually(isOpen, (is) => !is, { what: "the device, which is closed" });
  assert.deepEqual(await fake("wrong"), [], "every report was of its length");
  assert.deepEqual(wrong, []);
});

test("by serial the feeder is paired, feeds, pushes back once armed, is unplugged and plugged in, and let go", { timeout: 300_000 }, async (t) => {
  const { page, wrong } = await openTrial(t, [], await bySerial());
  const serial = bySerialLine(page);
  await says(page, /reaches the open feeder alone, by serial/, { what: "what this browser reaches" });
  await choose(page, "Pair by serial...");
  await there(page, "Arm force...");
  assert.equal((await serial("heard")).filter(isStart).length, 0, "no effect is started before it is armed");
  const start = await inserted(page);
  await serial("go(0.8, 0, 2000)");
  await fed(page, start, 2);

  await pushed(page, serial);
  await page.keyboard.press("Escape");
  await there(page, "Arm force...");
  await isStopped(page, serial);
  await replugged(page, serial);

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

  // A gamepad shakes by the force once it is armed, and is still as the window is left. Browsers tell of it so.
  await page.evaluate(() => dispatchEvent(new Event("gamepadconnected")));
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
