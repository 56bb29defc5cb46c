// Bad input gets one plain sentence, and nothing that was open is lost.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { REDUCTION, grouped, openFile, settled, shownTriangles } from "./app.mjs";
import { COARSE, dragTo, eventually, launch, openApp, texts } from "./browser.mjs";

/** A binary STL file of `claimed` triangles that has only `bytes` bytes. */
function truncatedStl(claimed, bytes) {
  const buffer = Buffer.alloc(bytes, 1);
  buffer.writeUInt32LE(claimed, 80);
  return buffer;
}

const FILES = [
  ["an empty file", "empty.stl", Buffer.alloc(0)],
  ["a text that is no mesh", "letter.obj", Buffer.from("Dear colleague,\nthe mesh is not in here.\n")],
  ["a truncated binary", "half.stl", truncatedStl(1000, 84 + 50 * 500)],
  ["a claim of 3 GB in 100 bytes", "claim.stl", truncatedStl(60_000_000, 100)],
  ["an index out of range", "index.obj", Buffer.from("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")],
  ["a coordinate that is no number", "nan.obj", Buffer.from("v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")],
  ["a file with no triangles", "points.obj", Buffer.from("v 0 0 0\nv 1 0 0\nv 0 1 0\n")],
];

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

test("what cannot be opened is refused in one sentence, and the sample stays", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE });
  const shown = shownTriangles(await settled(page));
  assert(shown > 0);
  for (const [what, name, buffer] of FILES) {
    const before = await texts(page);
    await openFile(page, { name, buffer });
    const isSentence = (text) => !before.includes(text) && /^\S.{20,}\.$/.test(text);
    const all = await eventually(() => texts(page), (all) => all.some(isSentence), { what: `the sentence for ${what}` });
    t.diagnostic(`${what}: ${all.find(isSentence)}`);
    assert.equal(shownTriangles(await settled(page)), shown, `after ${what} the sample is still shown`);
  }
  await dragTo(page, REDUCTION, 50);
  assert.notEqual(shownTriangles(await settled(page)), shown, `the sample still reacts, ${grouped(shown)} before`);
  assert.deepEqual(wrong, []);
});
