// How long does a haptic device wait for its answer in the browser? The feeder's mock (tests/browser/fake-hid.js) sends
// 1,000 reports a second to the trial's Worker of dist/ in headless Chromium while a hand pushes and pulls a wire.
// `node benches/haptics.mjs [FILE [SECONDS]]` prints a line of JSON: the surface is FILE, unreduced, else the sample at 90 %.

import { readFile } from "node:fs/promises";
import { atEntry, openFile, settled } from "../tests/browser/app.mjs";
import { dist, dragTo, eventually, frames, launch, openApp, press, texts, twin } from "../tests/browser/browser.mjs";

const [file, seconds = 20] = process.argv.slice(2);
const text = (name) => readFile(new URL(name, import.meta.url), "utf8");
const collections = `const COLLECTIONS = ${await text("../crates/lumen-haptics/fixtures/feeder-collections.json")};`;
const fake = [collections, await text("../tests/browser/fake-feeder.js"), await text("../tests/browser/fake-hid.js")].join("\n");
const browser = await launch();
const ends = [];
const { page } = await openApp({ after: (end) => ends.push(end) }, browser, {
  query: "",
  before: (page) => page.addInitScript(fake),
  files: { "worker.js": { type: "text/javascript", body: `${fake}\n${await readFile(`${dist}/worker.js`, "utf8")}` } },
});
await settled(page);
if (file) {
  await openFile(page, file);
  await settled(page, 600_000);
  await dragTo(page, "Reduction", 0);
  await settled(page, 600_000);
}
await press(page, "button", "Trial");
await atEntry(page);
await reach(["combobox", "Device"]);
await twin(page, "option", "Pair a device...").waitFor({ state: "attached" });
await press(page, "option", "Pair a device...");
await reach(["button", "Arm force..."]);
await reach(["button", "Arm force"]);
for (let i = 0; i < seconds / 2; i++) {
  await page.evaluate((feed) => globalThis.fakeHid.go(feed, feed / 2, 1800), i % 2 ? -0.2 : 0.7);
  await new Promise((later) => setTimeout(later, 2000));
}
const all = await texts(page);
const latency = all[all.indexOf("Latency") + 1];
const sent = await page.evaluate(() => globalThis.fakeHid.heard.length);
const [triangles] = all.filter((text) => /^[\d,]+ triangles$/.test(text));
console.log(JSON.stringify({ triangles, latency, sent, chromium: browser.version() }));
for (const end of ends) await end();
await browser.close();

/** Turns the wheel over the panel until a control is in sight, and presses it. */
async function reach([role, name]) {
  await page.mouse.move(150, 500);
  const inSight = async () => {
    const box = await twin(page, role, name).boundingBox({ timeout: 2000 }).catch(() => null);
    if (box && box.y > 60 && box.y + box.height < 740) return true;
    await page.mouse.wheel(0, 120);
    await frames(page, 10);
    return false;
  };
  await eventually(inSight, (is) => is, { what: name, timeout: 120_000 });
  await press(page, role, name);
}
