// Scans in the browser: read by a program of its own, which is there before anybody asks for it, from files that the page
// never holds, and cut into the same triangles as on the command line.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdir, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { grouped, openFile, says, settled, shownTriangles, stlTriangles, workersOn } from "./app.mjs";
import { COARSE, dist, eventually, frames, inSight, launch, openApp, press, program, started, texts, twin } from "./browser.mjs";
import { SIZE, THRESHOLD, dicom, metaimage, nifti } from "./scans.mjs";

const skip = existsSync(program) ? false : `${program} is not built`;
const run = promisify(execFile);

let browser, scratch;
before(async () => {
  browser = await launch();
  scratch = await mkdtemp(join(tmpdir(), "lumen-scans-"));
});
after(async () => {
  await browser.close();
  await rm(scratch, { recursive: true });
});

/** Writes files into a folder of their own. */
async function folderOf(name, files) {
  const folder = join(scratch, name);
  await mkdir(folder, { recursive: true });
  await Promise.all(files.map(({ name, buffer }) => writeFile(join(folder, name), buffer)));
  return folder;
}

/** How many triangles the command line makes of a scan. */
async function trianglesOf(path) {
  const surface = join(scratch, "surface.stl");
  await run(program, ["surface", path, "--threshold", String(THRESHOLD), "-o", surface]);
  return stlTriangles(await readFile(surface));
}

/** Waits until a scan is open. */
const scanIsOpen = (page) => says(page, new RegExp(`^${SIZE.join(" x ")}$`));

/** Presses a button at the foot of the panel, which moves until the preview is there. */
async function atFoot(page, name) {
  await eventually(() => texts(page), (all) => all.includes("Preview"), { what: "the preview" });
  await frames(page, 3);
  await inSight(page, twin(page, "button", name));
  await press(page, "button", name);
}

/** Makes the surface of the scan that is open; how many triangles it has. */
async function make(page) {
  await atFoot(page, "Make the surface");
  await twin(page, "button", "Make the surface").waitFor({ state: "detached" });
  return opened(await settled(page));
}

/** The number of triangles that was opened. */
const opened = (all) => Number(all[all.findIndex((text, i) => text === "Triangles" && / of /.test(all[i + 1])) + 1].split(" of ")[1].replaceAll(",", ""));

/** Waits until the program for scans is there; its Worker. */
async function reader(page) {
  const [worker] = await eventually(() => workersOn(page, "scan"), (workers) => workers.length === 1, { what: "the Worker" }).catch(
    () => assert.fail("no Worker for scans is started"),
  );
  const isThere = () => performance.getEntriesByType("resource").some(({ name, responseEnd }) => /lumen-scan_bg\.wasm/.test(name) && responseEnd > 0);
  await eventually(() => worker.evaluate(isThere), Boolean, { what: "the program for scans" });
  return worker;
}

/** Waits until the service worker has the whole build and answers for it. */
const kept = (page) =>
  eventually(() => page.evaluate(() => navigator.serviceWorker?.controller !== null), Boolean, { what: "the service worker" });

/** Drags files or folders over the window and drops them. */
async function drop(page, paths) {
  const session = await page.context().newCDPSession(page);
  const data = { items: [], files: paths, dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver", "drop"]) {
    await session.send("Input.dispatchDragEvent", { type, x: 640, y: 400, data });
    await frames(page, 2);
  }
}

test("a scan in any format gives the triangles that the command line makes of it", { skip, timeout: 300_000 }, async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE });
  await settled(page);
  for (const [what, files] of [["NIfTI", nifti()], ["MetaImage", metaimage()], ["DICOM", dicom()]]) {
    const folder = await folderOf(what, files);
    const expected = await trianglesOf(files.length === 1 ? join(folder, files[0].name) : what === "DICOM" ? folder : join(folder, "vessel.mhd"));
    assert(expected > 5000, `${expected} triangles of ${what}`);
    await openFile(page, files);
    assert((await scanIsOpen(page)).includes(what), `it is known as ${what}`);
    assert.equal(await make(page), expected, what);
    t.diagnostic(`${what}: ${grouped(expected)} triangles`);
  }
  assert.deepEqual(wrong, []);
});

test("files that are dropped together, and a folder, are a scan", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE });
  await settled(page);
  const pair = await folderOf("pair", metaimage());
  await drop(page, [join(pair, "vessel.raw"), join(pair, "vessel.mhd")]);
  assert((await scanIsOpen(page)).includes("MetaImage"));
  await drop(page, [await folderOf("series", dicom())]);
  await says(page, /^DICOM$/);
  await scanIsOpen(page);
  await drop(page, [await folderOf("empty", [])]);
  await says(page, /^There are no files in the folder\.$/);
  assert.deepEqual(wrong, []);
});

test("what cannot be read is refused in one sentence, and what is open stays", async (t) => {
  const { page, wrong } = await openApp(t, browser, { context: COARSE });
  const shown = shownTriangles(await settled(page));
  const [header, whole] = [metaimage()[1], nifti()[0].buffer];
  const bad = [
    ["a header without its data", [header], /^The MetaImage header keeps its numbers in the file "vessel\.raw": open both together\.$/],
    ["half a file", [{ name: "half.nii.gz", buffer: whole.subarray(0, whole.length / 2) }], /^\S.+\.$/],
    ["a packed letter", [{ name: "letter.gz", buffer: Buffer.from("1f8b0800000000000003", "hex") }], /is not a volume that Lumen knows/],
    ["a series without a slice", [{ name: "IM1", buffer: Buffer.concat([Buffer.alloc(128), Buffer.from("DICM")]) }], /^\S.+\.$/],
  ];
  for (const [what, files, pattern] of bad) {
    const before = await texts(page);
    await openFile(page, files);
    const isNew = (text) => !before.includes(text) && text.length > 20 && pattern.test(text);
    const all = await eventually(() => texts(page), (all) => all.some(isNew), { what: `the sentence for ${what}` });
    t.diagnostic(`${what}: ${all.find(isNew)}`);
    assert.equal(shownTriangles(await settled(page)), shown, `after ${what} the sample is still shown`);
  }
  // Beside a scan that is open, too.
  await openFile(page, nifti());
  await scanIsOpen(page);
  await openFile(page, [header]);
  await says(page, /open both together\.$/);
  await scanIsOpen(page);
  assert.deepEqual(wrong, []);
});

test("the Worker of scans dies alone", async (t) => {
  const { page } = await openApp(t, browser, { context: COARSE });
  const shown = shownTriangles(await settled(page));
  await openFile(page, nifti());
  await scanIsOpen(page);
  const [worker] = workersOn(page, "scan");
  await worker.evaluate(() => {
    setTimeout(() => {
      throw new Error("injected");
    });
  });
  await says(page, /^The scan's engine has stopped \(.+\): open the scan again\.$/);
  assert.equal(shownTriangles(await settled(page)), shown, "the sample is still shown");
  assert.equal(workersOn(page, "pipeline").length, 1);
  await openFile(page, nifti());
  await scanIsOpen(page);
});

for (const serviceWorkers of ["allow", "block"]) {
  test(`no request depends on what is opened (service workers: ${serviceWorkers})`, { timeout: 300_000 }, async (t) => {
    const { page, address, server, wrong } = await openApp(t, browser, { context: { ...COARSE, serviceWorkers } });
    await settled(page);
    await reader(page);
    if (serviceWorkers === "allow") await kept(page);
    const loaded = server.asked.length;
    assert(server.asked.some((path) => path.startsWith("lumen-scan_bg.wasm")), "it is fetched before anything is opened");
    const elsewhere = [];
    page.context().on("request", (request) => request.url().startsWith(address) || elsewhere.push(request.url()));
    await openFile(page, nifti());
    await scanIsOpen(page);
    await make(page);
    await openFile(page, { name: "letter.gz", buffer: Buffer.from("1f8b0800000000000003", "hex") });
    await says(page, /is not a volume/);
    await openFile(page, dicom());
    await scanIsOpen(page);
    await atFoot(page, "Close the scan");
    await settled(page);
    // Whenever a Worker begins, the browser itself looks for a newer service worker (Service Workers, "Soft Update").
    const asked = server.asked.slice(loaded).filter((path) => path !== "service-worker.js");
    assert.deepEqual(asked, [], "the server is asked for nothing");
    assert.deepEqual(elsewhere.filter((url) => !/^(blob|data):/.test(url)), [], "and nobody else");
    assert.deepEqual(wrong.filter((line) => !/service ?worker/i.test(line)), []);
  });
}

test("a scan that is opened before its program is there waits for it", async (t) => {
  const name = "lumen-scan_bg.wasm";
  let arrive;
  const arrival = new Promise((resolve) => (arrive = resolve));
  const body = arrival.then(() => readFile(join(dist, name)));
  const { page, wrong } = await openApp(t, browser, { context: COARSE, files: { [name]: { type: "application/wasm", body } } });
  await settled(page);
  await openFile(page, nifti());
  await says(page, /^The part of Lumen that reads scans is still being fetched$/);
  arrive();
  await scanIsOpen(page);
  assert.deepEqual(wrong, []);
});

test("without a network scans are opened too", async (t) => {
  const { page, server, wrong } = await openApp(t, browser, { context: COARSE });
  await settled(page);
  await kept(page);
  await server.close();
  await page.reload();
  await started(page);
  await settled(page);
  await openFile(page, nifti());
  await scanIsOpen(page);
  assert.deepEqual(wrong, []);
});
