// A Worker dies: the page says so, another takes its place,
// and what was open is opened again from the bytes that the page has kept.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { REDUCTION, atEntry, openFile, save, says, settled, shownTriangles, stlTriangles, workersOn } from "./app.mjs";
import { COARSE, dragTo, eventually, launch, openApp, press, texts, twin } from "./browser.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

/** Ends a Worker by an exception that nobody in it catches: the page hears of it as of a panic. */
const kill = (worker) =>
  worker.evaluate(() => {
    setTimeout(() => {
      throw new Error("injected");
    });
  });

/** A square of 2 n^2 triangles, as OBJ. */
function sheet(n) {
  const lines = [];
  for (let i = 0; i <= n; i++) for (let j = 0; j <= n; j++) lines.push(`v ${i * 3} ${j * 3} ${Math.sin(i / 2) * Math.cos(j / 2)}`);
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < n; j++) {
      const at = i * (n + 1) + j + 1;
      lines.push(`f ${at} ${at + n + 1} ${at + 1}`, `f ${at + 1} ${at + n + 1} ${at + n + 2}`);
    }
  }
  return Buffer.from(lines.join("\n"));
}

test("the engine dies twice, and what was open is never lost", { timeout: 300_000 }, async (t) => {
  const { page } = await openApp(t, browser, { context: COARSE });
  await settled(page);
  await openFile(page, { name: "sheet.obj", buffer: sheet(40) });
  await eventually(() => texts(page), (all) => all.some((text) => / of 3,200$/.test(text)), { what: "the sheet" });
  await settled(page);
  await dragTo(page, REDUCTION, 50);
  const shown = shownTriangles(await settled(page));
  for (let death = 1; death <= 2; death++) {
    await kill(workersOn(page, "pipeline")[0]);
    const times = death === 1 ? "" : ` \\(${death} times\\)`;
    await says(page, new RegExp(`^The computation stopped \\(.+\\) and was started again\\. Nothing was lost\\.${times}$`));
    const all = await settled(page);
    assert.equal(shownTriangles(all), shown, `after death ${death}`);
    assert(all.some((text) => /sheet\.obj/.test(text)) || (await twin(page, "img", /shaded/i).count()) > 0);
    assert.equal(workersOn(page, "pipeline").length, 1, "one Worker, no more");
  }
  const { bytes } = await save(page, "STL");
  assert.equal(stlTriangles(bytes), shown, "the new engine saves what is shown");
});

test("an engine that dies at every start is left alone, and what is shown can still be saved", { timeout: 300_000 }, async (t) => {
  const { page } = await openApp(t, browser, { context: COARSE });
  const shown = shownTriangles(await settled(page));
  await page.evaluate(() => {
    window.SoundWorker = Worker;
    window.started = 0;
    window.Worker = class extends SoundWorker {
      constructor(...all) {
        super(...all);
        window.started += 1;
        setTimeout(() => this.dispatchEvent(new ErrorEvent("error", { message: "injected" })), 100);
      }
    };
  });
  await kill(workersOn(page, "pipeline")[0]);
  await says(page, /^The computation keeps stopping \(.+\)\. What is shown is still there and can be saved/);
  const started = await page.evaluate(() => window.started);
  await new Promise((later) => setTimeout(later, 2000));
  assert.equal(await page.evaluate(() => window.started), started, "no further one is started by itself");
  assert.equal(started, 2);
  await page.evaluate(() => (window.Worker = window.SoundWorker));
  const { bytes } = await save(page, "STL");
  assert.equal(stlTriangles(bytes), shown);
});

test("the trial's engine dies: the surface stays, and a new trial starts", { timeout: 300_000 }, async (t) => {
  const { page } = await openApp(t, browser, { context: COARSE });
  const shown = shownTriangles(await settled(page));
  await press(page, "button", "Trial");
  await atEntry(page);
  const [trial] = workersOn(page, "trial");
  await kill(trial);
  await says(page, /^The trial stopped \(.+\)\. The surface is still open; start again\.$/);
  await press(page, "button", "Prepare");
  assert.equal(shownTriangles(await settled(page)), shown);
  await press(page, "button", "Trial");
  await atEntry(page);
});
