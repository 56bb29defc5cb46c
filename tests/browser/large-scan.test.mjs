// A scan of 512 x 512 x 800 voxels at 16 bits, 420 MB, opens in the browser within its memory, as it is and packed. It is
// made here and takes minutes, so only `cargo xtask test --long` has it.

import assert from "node:assert/strict";
import { createReadStream, createWriteStream } from "node:fs";
import { mkdtemp, rm, stat } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { finished, pipeline } from "node:stream/promises";
import { after, before, test } from "node:test";
import { createGzip } from "node:zlib";
import { openFile, settled, shownTriangles, workersOn } from "./app.mjs";
import { COARSE, eventually, inSight, launch, openApp, press, texts, twin } from "./browser.mjs";
import { niftiHeader } from "./scans.mjs";

const skip = process.env.LUMEN_LONG ? false : "only with --long";
const SIZE = [512, 512, 800];
/** Bytes that the numbers take. */
const NUMBERS = 2 * SIZE[0] * SIZE[1] * SIZE[2];
/** What the Worker may have beside the numbers: its program, the copy for the preview, a piece of the file. */
const BESIDE = 100e6;
/** What the page may have, with the sample. */
const PAGE = 300e6;

let browser, scratch;
before(async () => {
  browser = await launch();
  scratch = await mkdtemp(join(tmpdir(), "lumen-large-"));
});
after(async () => {
  await browser.close();
  await rm(scratch, { recursive: true });
});

/** Slice k: a vessel that winds through tissue with noise. */
function slice(k, noise) {
  const [columns, rows] = SIZE;
  const all = new Int16Array(columns * rows);
  const shift = (k * 7919) % noise.length;
  for (let at = 0; at < all.length; at++) all[at] = noise[(at + shift) % noise.length];
  const [x, y] = [256 + 80 * Math.sin(k / 60), 256 + 60 * Math.cos(k / 45)];
  for (let j = Math.floor(y) - 20; j <= y + 20; j++) {
    for (let i = Math.floor(x) - 20; i <= x + 20; i++) {
      const away = Math.hypot(i - x, j - y) - 14;
      all[j * columns + i] = Math.round(Math.min(400, Math.max(all[j * columns + i], 180 - 40 * away)));
    }
  }
  return Buffer.from(all.buffer);
}

async function write(path) {
  const noise = Int16Array.from({ length: 65_537 }, (_, n) => ((n * 48_271) % 65_537) % 100 - 50);
  noise[0] = -1000;
  const out = createWriteStream(path);
  out.write(niftiHeader(SIZE, [0.7, 0.7, 0.8], [0, 0, 0]));
  for (let k = 0; k < SIZE[2]; k++) {
    if (!out.write(slice(k, noise))) await new Promise((drained) => out.once("drain", drained));
  }
  out.end();
  await finished(out);
}

/** Bytes of the memory of a program's instance in the page or a Worker: its glue gives the one that is there already. */
const memory = (realm, program) =>
  realm.evaluate(async (program) => {
    const loaded = performance.getEntriesByType("resource").map(({ name }) => name);
    const glue = loaded.find((name) => name.includes(`${program}.js`)) ?? new URL(`${program}.js${self.location.search}`, self.location).href;
    return (await import(glue)).initSync().memory.buffer.byteLength;
  }, program);

test("512 x 512 x 800 voxels at 16 bits open within memory, with progress and cancel", { skip, timeout: 1_800_000 }, async (t) => {
  const plain = join(scratch, "large.nii");
  await write(plain);
  const packed = `${plain}.gz`;
  await pipeline(createReadStream(plain), createGzip({ level: 1 }), createWriteStream(packed));
  const { page, wrong } = await openApp(t, browser, { context: COARSE });
  const shown = shownTriangles(await settled(page));

  await openFile(page, packed);
  await eventually(() => texts(page), (all) => all.some((text) => /^Reading the scan [1-9]\d? %$/.test(text)), { what: "the progress", timeout: 120_000 });
  await press(page, "button", "Cancel");
  await eventually(() => texts(page), (all) => all.includes("Cancelled; the scan was not opened."), { what: "the cancel" });
  assert.equal(shownTriangles(await settled(page)), shown, "what was open stands");

  for (const [what, path] of [["as it is", plain], ["packed", packed]]) {
    const bytes = (await stat(path)).size;
    const begun = performance.now();
    await openFile(page, path);
    await twin(page, "button", "Make the surface").waitFor({ state: "attached", timeout: 600_000 });
    const opened = (performance.now() - begun) / 1000;
    await eventually(() => texts(page), (all) => all.includes("Preview"), { timeout: 600_000, what: "the preview" });
    const seen = (performance.now() - begun) / 1000;
    const [worker] = workersOn(page, "scan");
    const [inWorker, inPage] = [await memory(worker, "lumen-scan"), await memory(page, "lumen-web")];
    const mb = (bytes) => `${(bytes / 1e6).toFixed(0)} MB`;
    t.diagnostic(
      `${what}: ${mb(bytes)}, open after ${opened.toFixed(1)} s, its preview after ${seen.toFixed(1)} s; ` +
        `memory of the Worker ${mb(inWorker)}, of the page ${mb(inPage)}`,
    );
    assert(inPage < PAGE, `${mb(inPage)} in the page`);
    // Packed numbers come without a length that could be believed: their room grows, and is copied as it does.
    assert(inWorker < (what === "packed" ? 2.2 : 1) * NUMBERS + BESIDE, `${mb(inWorker)} in the Worker`);
    await inSight(page, twin(page, "button", "Close the scan"));
    await press(page, "button", "Close the scan");
    await settled(page);
  }
  assert.deepEqual(wrong, []);
});
