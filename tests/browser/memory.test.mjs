// The browser has no memory left for a copy: one sentence, and what was open goes on. The constructor that the program
// copies with is made to fail, as it does where nothing is left.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { REDUCTION, openFile, says, settled, shownTriangles, workersOn } from "./app.mjs";
import { COARSE, dragTo, eventually, launch, openApp, press, texts, twin } from "./browser.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

/** Runs before the program: arrays of more than `self.mostBytes` bytes cannot be made. */
function limitArrays() {
  self.mostBytes = Infinity;
  const Plain = self.Uint8Array;
  self.Uint8Array = class Uint8Array extends Plain {
    constructor(...all) {
      const [first] = all;
      const bytes = typeof first === "number" ? first : ArrayBuffer.isView(first) ? first.byteLength : 0;
      if (bytes > self.mostBytes) throw new RangeError("Array buffer allocation failed");
      super(...all);
    }
    static get [Symbol.species]() {
      return Plain;
    }
  };
}

/** Runs before the program: the next file cannot be read into memory. */
function failFiles() {
  Blob.prototype.arrayBuffer = () => Promise.reject(new RangeError("Array buffer allocation failed"));
}

/** The app reacts to a slider and shows another level. */
async function works(page, percent) {
  const before = shownTriangles(await settled(page));
  await dragTo(page, REDUCTION, percent);
  const now = shownTriangles(await settled(page));
  assert.notEqual(now, before, "the slider still acts");
  assert.equal(await page.evaluate(() => document.documentElement.dataset.state), "ready");
}

test("a surface that cannot be copied to its Worker is told, and the app goes on", async (t) => {
  const { page } = await openApp(t, browser, { context: COARSE, before: (page) => page.addInitScript(limitArrays) });
  await settled(page);
  await page.evaluate(() => (window.mostBytes = 10_000));
  await press(page, "button", "Save");
  await press(page, "menuitem", "STL...");
  await says(page, /no memory left for [\d.]+ MB/);
  await page.evaluate(() => (window.mostBytes = Infinity));
  await works(page, 60);
});

test("a download that cannot be made is told, and the app goes on", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE, before: (page) => page.addInitScript(limitArrays) });
  await settled(page);
  // What goes to the Worker is smaller than the text of an OBJ that comes back.
  await dragTo(page, REDUCTION, 50);
  const triangles = shownTriangles(await settled(page));
  await page.evaluate((most) => (window.mostBytes = most), 30 * triangles);
  await press(page, "button", "Save");
  await press(page, "menuitem", "OBJ...");
  await says(page, /^.+\.obj was not saved: the browser has no memory left for [\d.]+ MB\.$/);
  await page.evaluate(() => (window.mostBytes = Infinity));
  await works(page, 70);
  assert.deepEqual(wrong, []);
});

test("a file that does not fit into memory is told, and what was open stays", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE, before: (page) => page.addInitScript(failFiles) });
  const shown = shownTriangles(await settled(page));
  await openFile(page, { name: "large.stl", buffer: Buffer.alloc(2_000_000) });
  await says(page, /^large\.stl has 2 MB, for which this browser has no memory left\.$/);
  assert.equal(shownTriangles(await texts(page)), shown);
  await works(page, 60);
  assert.deepEqual(wrong, []);
});

test("an answer that its Worker cannot copy ends that Worker, and another takes its place", async (t) => {
  const { page } = await openApp(t, browser, { context: COARSE });
  await settled(page);
  const [worker] = workersOn(page, "pipeline");
  await worker.evaluate(limitArrays);
  await worker.evaluate(() => (self.mostBytes = 10_000));
  const iterations = twin(page, "slider", "Iterations");
  await iterations.evaluate((twin) => twin.focus());
  await eventually(() => page.locator("#lumen").getAttribute("aria-activedescendant"), (id) => id !== null);
  await page.keyboard.press("ArrowRight");
  await says(page, /^The computation stopped \(.*no memory left for [\d.]+ MB.*\) and was started again\. Nothing was lost\.$/);
  await works(page, 60);
});

test("a computation that has no memory left is not begun again by itself, and what is shown stays", async (t) => {
  const { page } = await openApp(t, browser, { context: COARSE });
  const shown = shownTriangles(await settled(page));
  const [worker] = workersOn(page, "pipeline");
  // A program whose allocation fails ends in this trap.
  await worker.evaluate(() => {
    // (module (func (export "f") unreachable))
    const bytes = [0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 7, 5, 1, 1, 102, 0, 0, 10, 5, 1, 3, 0, 0, 11];
    const { f } = new WebAssembly.Instance(new WebAssembly.Module(Uint8Array.from(bytes))).exports;
    setTimeout(f);
  });
  await says(page, /^The computation stopped \(there is no memory left beyond its [\d.]+ GB\)\. What is shown is still there/);
  assert.equal(shownTriangles(await texts(page)), shown);
  // A setting that the levels do not hold asks for another, which does as before.
  await works(page, 60);
});
