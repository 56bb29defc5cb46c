// A real vessel from the file dialog to the saved file: the way every user goes.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync } from "node:fs";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import {
  REDUCTION,
  edgePixels,
  grouped,
  lookFrom,
  openFile,
  save,
  settled,
  shownTriangles,
  silhouette,
  stlTriangles,
  views,
} from "./app.mjs";
import { data, dragTo, launch, openApp, press, program } from "./browser.mjs";

const AORTA = join(data, "real/vmtk_aorta_mra_iso800.stl");
/** Facts of data/INDEX.md. */
const TRIANGLES = 90_504;
const LARGEST = 66_982;
const COMPONENTS = 301;

const sha256 = (bytes) => createHash("sha256").update(bytes).digest("hex");

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

test("a real vessel is opened, reduced and saved", { skip: existsSync(AORTA) ? false : `${AORTA} is not there` }, async (t) => {
  const { page, wrong } = await openApp(t, browser);
  await settled(page);

  await press(page, "button", "Surface");
  await openFile(page, AORTA);
  // The sample's own numbers are still there until the file has been read.
  await page.locator("#twins").getByText(grouped(TRIANGLES), { exact: true }).waitFor({ state: "attached" });
  const told = await settled(page);
  assert(told.includes(`${grouped(LARGEST)} triangles`), told.join("\n"));
  assert(told.includes(`${grouped(TRIANGLES - LARGEST)} in ${COMPONENTS - 1} pieces`), told.join("\n"));

  assert.equal(await dragTo(page, REDUCTION, 0), 0);
  assert.equal(shownTriangles(await settled(page)), LARGEST);
  // The long axis of this scan is y: from above it is seen in full.
  await lookFrom(page, "Top");
  const look = async () => ({
    silhouette: await silhouette(page, views.shaded(page)),
    edges: await edgePixels(page, views.wireframe(page)),
  });
  const whole = await look();

  const rate = await dragTo(page, REDUCTION, 90);
  assert(Math.abs(rate - 90) <= 0.3, `${rate} % is as near to 90 % as a pixel allows`);
  const shown = shownTriangles(await settled(page));
  const target = Math.floor((LARGEST * (1000 - Math.round(rate * 10))) / 1000);
  assert(target - 2 < shown && shown <= target, `${shown} triangles, ${target} were asked for`);
  const light = await look();
  t.diagnostic(`drawn pixels, whole and reduced: ${JSON.stringify({ whole, light })}`);
  assert(whole.silhouette > 10_000, "there is something to see");
  assert(Math.abs(light.silhouette - whole.silhouette) <= 0.03 * whole.silhouette, "the silhouette stays");
  assert(light.edges <= 0.5 * whole.edges, "the wireframe thins out");

  const saved = await save(page, "STL");
  assert.match(saved.name, /\.stl$/);
  assert.equal(stlTriangles(saved.bytes), shown);

  const folder = await mkdtemp(join(tmpdir(), "lumen-"));
  t.after(() => rm(folder, { recursive: true }));
  const native = join(folder, "native.stl");
  await promisify(execFile)(program, ["optimise", AORTA, "-o", native, "--reduction", `${rate}`]);
  assert.equal(sha256(saved.bytes), sha256(await readFile(native)), "the browser and the command line make the same file");
  assert.deepEqual(wrong, []);
});
