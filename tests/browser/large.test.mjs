// A binary STL of 500 MB, made here, is opened, shown and reduced in a page. It takes minutes and 5 GB: with --long alone.

import assert from "node:assert/strict";
import { mkdtemp, open, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { openFile, save, settled, shownTriangles, stlTriangles } from "./app.mjs";
import { COARSE, eventually, launch, openApp, texts } from "./browser.mjs";

const [AROUND, ALONG] = [1582, 3164];
const TRIANGLES = 2 * AROUND * ALONG;
/** What 90 % leave of them at most; a collapse inside takes two triangles, so that it may be one less. */
const LEFT = Math.floor(TRIANGLES / 10);
const isLeft = (triangles) => triangles === LEFT || triangles === LEFT - 1;

/** A vessel of 20 mm with the steps of a scan on its wall, 300 mm long, open at both ends. */
async function writeTube(path) {
  const corner = (i, j) => {
    const angle = (2 * Math.PI * (i % AROUND)) / AROUND;
    const radius = 10 + 0.1 * Math.round(4 * Math.sin(12 * angle)) * Math.round(2 * Math.sin(j / 9));
    return [radius * Math.cos(angle), radius * Math.sin(angle), (300 * j) / ALONG];
  };
  const file = await open(path, "w");
  const head = Buffer.alloc(84);
  head.writeUInt32LE(TRIANGLES, 80);
  await file.write(head);
  const ring = Buffer.alloc(2 * AROUND * 50);
  for (let j = 0; j < ALONG; j++) {
    for (let i = 0; i < AROUND; i++) {
      const [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
      [[a, b, c], [a, c, d]].forEach((triangle, t) => {
        triangle.flat().forEach((x, n) => ring.writeFloatLE(x, (2 * i + t) * 50 + 12 + 4 * n));
      });
    }
    await file.write(ring);
  }
  await file.close();
}

if (process.env.LUMEN_LONG) {
  let browser;
  before(async () => (browser = await launch()));
  after(() => browser.close());

  test("ten million triangles are opened, shown and reduced", { timeout: 1_800_000 }, async (t) => {
    const folder = await mkdtemp(join(tmpdir(), "lumen-large-"));
    t.after(() => rm(folder, { recursive: true }));
    const path = join(folder, "large.stl");
    await writeTube(path);
    const { page, wrong } = await openApp(t, browser, { context: COARSE });
    await settled(page);
    const begun = Date.now();
    await openFile(page, path);
    // How far the reading is moves on before it is done.
    const told = new Set();
    await eventually(
      () => texts(page),
      (all) => {
        all.filter((text) => /^Reading \d+ %$/.test(text)).forEach((text) => told.add(text));
        return all.some((text) => /^Finding pieces|^Smoothing/.test(text));
      },
      { timeout: 600_000, what: "the end of the reading" },
    );
    assert(told.size >= 3, `only ${[...told]} was told of the reading`);
    await eventually(() => texts(page), (all) => isLeft(shownTriangles(all)), { timeout: 900_000, what: "the level" });
    await settled(page, 900_000);
    console.log(`ten million triangles: ${((Date.now() - begun) / 1000).toFixed(0)} s until all is measured`);
    // Ten million triangles stand beside the level, and a frame of theirs takes seconds without a graphics card.
    const { bytes } = await save(page, "STL", 300_000);
    assert(isLeft(stlTriangles(bytes)));
    assert.deepEqual(wrong, []);
  });
}
