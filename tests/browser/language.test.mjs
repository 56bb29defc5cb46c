// The app speaks the browser's language, and so do its Workers; no request is made for a language that is chosen later.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { loaded } from "./app.mjs";
import { COARSE, eventually, launch, openApp, press, texts, twin } from "./browser.mjs";

const GERMAN = { ...COARSE, locale: "de-AT" };

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

const lang = (page) => page.evaluate(() => document.documentElement.lang);

/** Waits until a button of this name is there. */
const shows = (page, name) => twin(page, "button", name).waitFor({ state: "attached", timeout: 60_000 });

test("a German browser has a German app, whose Worker answers in German", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: GERMAN });
  await shows(page, "Öffnen...");
  assert.equal(await lang(page), "de");
  const chooser = page.waitForEvent("filechooser");
  await press(page, "button", "Öffnen...");
  await (await chooser).setFiles({ name: "leer.stl", mimeType: "application/octet-stream", buffer: Buffer.alloc(0) });
  const isRefused = (all) => all.some((text) => text.includes("leer.stl") && text.includes("Die Datei ist leer."));
  await eventually(() => texts(page), isRefused, { what: "the sentence of the Worker" });
  // The figures stand there once the sample of a first visit does.
  const all = await eventually(() => texts(page), (all) => all.includes("Dreiecke"), { what: "the figures", timeout: 60_000 });
  assert(!all.includes("Triangles"), all.join("\n"));
  assert.deepEqual(wrong, []);
});

test("another language is chosen without a request, and a reload keeps it", async (t) => {
  const requests = [];
  const listen = (page) => page.context().on("request", (request) => requests.push(request.url()));
  const { page, wrong } = await openApp(t, browser, { context: COARSE, before: listen });
  await shows(page, "Open...");
  const fetched = (tag) => requests.filter((url) => url.includes(`lumen-${tag}.ftl`)).length;
  await loaded(page);
  assert(fetched("de") > 0 && fetched("fr") > 0, requests.join("\n"));
  const before = requests.length;

  await press(page, "button", "View");
  await press(page, "menuitem", /^Language/);
  await press(page, "menuitemradio", "Français");
  await shows(page, "Ouvrir...");
  assert.equal(await lang(page), "fr");
  assert.equal(await page.locator("#typed").getAttribute("aria-label"), "Saisie", "the field for what is typed");
  assert.deepEqual(requests.slice(before), [], "the language was there");

  // It is written a second after the choice.
  const isKept = () => page.evaluate(() => Object.values(localStorage).some((text) => text.includes('"language":"fr"')));
  await eventually(isKept, (kept) => kept, { what: "the choice" });
  await page.reload();
  await shows(page, "Ouvrir...");
  assert.deepEqual(wrong, []);
});
