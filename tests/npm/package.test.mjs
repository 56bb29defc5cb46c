// The npm package in Node, as a program of somebody else has it: from its folder, by its names alone.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { cp, mkdir, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { promisify } from "node:util";
import { Worker } from "node:worker_threads";
import { built, program } from "./built.mjs";
import { tube } from "./tube.mjs";

const run = promisify(execFile);

/** What the paper does, by the names that the command line has. */
const PAPER = { "pass-band": 0.01, iterations: 100, reduction: 90, adapt: false, guard: false, "hold-caps": false };
const TRIANGLES = 2 * 48 * 120;

let open, LumenError, outside;
before(async () => {
  outside = await mkdtemp(join(tmpdir(), "lumen-"));
  await mkdir(join(outside, "node_modules"));
  await cp(built, join(outside, "node_modules/lumen-vessel"), { recursive: true });
  const text = 'export * from "lumen-vessel";';
  await writeFile(join(outside, "program.mjs"), text);
  ({ open, LumenError } = await import(pathToFileURL(join(outside, "program.mjs")).href));
});
after(() => rm(outside, { recursive: true }));

/** A surface that is closed when the test ends. */
async function opened(t, bytes = tube(), name = "tube.stl", options) {
  const surface = await open(bytes, name, options);
  t.after(() => surface.close());
  return surface;
}

/** Whether two levels are alike to the last bit; told in a word, not in all their numbers. */
const same = (one, other) => ["positions", "indices", "normals"].every((name) => Buffer.from(one[name].buffer).equals(Buffer.from(other[name].buffer)));

test("a surface is optimised, and every rate has its count", async (t) => {
  const stages = new Set();
  const surface = await opened(t);
  assert.equal(surface.info.triangles, TRIANGLES);
  const { report, verdict, certificate } = await surface.optimise(PAPER, { progress: ({ stage }) => stages.add(stage) });
  assert(stages.has("Smoothing") && stages.has("Measuring calibre"), [...stages].join());
  assert.equal(report.disclaimer, "Not for clinical decisions.");
  assert.equal(report.settings.smoothing.pass_band, 0.01);
  assert(verdict.head.length > 0 && verdict.findings.every((finding) => finding.text.length > 0));
  assert.equal(certificate.branches.length, 1);

  for (const [reduction, wanted] of [[undefined, TRIANGLES / 10], [0, TRIANGLES], [50, TRIANGLES / 2], [99, TRIANGLES / 100]]) {
    const { positions, indices, normals } = await surface.level(reduction);
    assert(positions instanceof Float32Array && indices instanceof Uint32Array && normals instanceof Float32Array);
    assert(Math.abs(indices.length / 3 - wanted) <= 1, `${reduction} %: ${indices.length / 3} triangles`);
    assert.equal(normals.length, positions.length);
    assert(indices.every((corner) => corner < positions.length / 3));
    assert(Math.abs(Math.hypot(...normals.subarray(0, 3)) - 1) < 1e-5);
  }

  const { positions, radii, sectionRadii, starts, parents } = await surface.centrelines();
  assert.deepEqual([[...starts], [...parents]], [[0, radii.length], [-1]]);
  assert.equal(positions.length, 3 * sectionRadii.length);
  const middle = Math.floor(radii.length / 2);
  assert(radii[middle] > 3 && radii[middle] < 6, `${radii[middle]} mm`);
  assert(Math.abs(Math.hypot(positions[3 * middle], positions[3 * middle + 1]) - 30) < 1);
});

test("the same settings give the bytes of the command line, in the form of a settings file, too", async (t) => {
  const file = join(outside, "tube.stl");
  await writeFile(file, tube());
  const surface = await opened(t);
  for (const format of ["stl", "glb"]) {
    const out = join(outside, `out.${format}`);
    await run(program, ["optimise", file, "-o", out, "--smoothing", "paper", "--reduction", "90", "--save-settings", join(outside, "settings.json")]);
    await surface.optimise(PAPER, { measures: false });
    const bytes = await readFile(out);
    assert(bytes.equals(await surface.save(format)), format);
    const { settings } = JSON.parse(await readFile(join(outside, "settings.json"), "utf8"));
    await surface.optimise(settings, { measures: false });
    assert(bytes.equals(await surface.save(format)), `${format}, by the file of settings`);
    assert(bytes.equals(await surface.save(format, 90)), `${format}, by its rate`);
  }
});

test("what cannot be done is refused by an identifier, with its values", async (t) => {
  const refused = (id) => (why) => {
    assert(why instanceof LumenError && why instanceof Error && why.name === "LumenError");
    assert.equal(why.id, id, why.message);
    return true;
  };
  await assert.rejects(open(new Uint8Array(), "empty.stl"), refused("errors-file-empty"));
  await assert.rejects(open(tube().subarray(0, 1000), "short.stl"), (why) => why.id.startsWith("errors-") && why.values.found < TRIANGLES);
  await assert.rejects(open(new TextEncoder().encode("no surface"), "note.txt"), refused("errors-file-unknown"));
  const surface = await opened(t);
  await assert.rejects(surface.level(), refused("npm-not-optimised"));
  await assert.rejects(surface.centrelines(), refused("npm-no-vessels"));
  await assert.rejects(surface.optimise({ "pass-band": 3 }), (why) => refused("errors-pass-band")(why) && why.values.value === 3);
  await assert.rejects(surface.optimise({ colour: {} }), (why) => refused("app-settings-field")(why) && why.values.why.includes("colour"));
  await assert.rejects(surface.optimise({ reduction: "much" }), refused("app-settings-field"));
  await surface.optimise({ ...PAPER, iterations: 0 }, { measures: false });
  await assert.rejects(surface.save("jpg"), refused("errors-format-unknown"));
  await assert.rejects(surface.optimise({ reduction: 100 }), refused("errors-reduction"));
});

test("arguments are checked before anything is asked of the Worker", async (t) => {
  await assert.rejects(open(tube(), 7), TypeError);
  const surface = await opened(t);
  await assert.rejects(surface.optimise(PAPER, { measures: "all" }), TypeError);
  for (const reduction of ["90", null]) await assert.rejects(surface.level(reduction), TypeError);
  for (const reduction of [NaN, -1, 100]) await assert.rejects(surface.save("stl", reduction), RangeError);
  await assert.rejects(surface.save(), TypeError);
  const circle = {};
  circle.keep = circle;
  for (const settings of [{ iterations: () => 1 }, circle]) await assert.rejects(surface.optimise(settings), (why) => !(why instanceof LumenError));
  const stop = new Error("enough");
  const throwing = [() => { throw stop; }, async () => { throw stop; }];
  for (const progress of throwing) await assert.rejects(surface.optimise(PAPER, { progress }), stop);
  await surface.optimise({ ...PAPER, iterations: 0 }, { measures: false });
});

test("settings have the values of the command line, and the target is said once", async (t) => {
  const surface = await opened(t);
  for (const [keep, read] of [["all", "All"], ["All", "All"], ["largest", "Largest"], [0, { Component: 0 }], [{ Component: 0 }, { Component: 0 }]]) {
    const { report } = await surface.optimise({ ...PAPER, iterations: 0, keep }, { measures: false });
    assert.deepEqual(report.settings.keep, read);
  }
  const twice = (why) => why instanceof LumenError && why.message.includes("both say the target");
  await assert.rejects(surface.optimise({ reduction: 90, triangles: 500 }), twice);
  await assert.rejects(surface.optimise({ "max-deviation": 0.1, target: "Auto" }), twice);
});

test("a signal cancels, and what was made before stays", async (t) => {
  await assert.rejects(open(tube(), "tube.stl", { signal: AbortSignal.abort() }), { name: "AbortError" });
  const surface = await opened(t);
  await surface.optimise(PAPER, { measures: false });
  const before = await surface.level();
  const stop = new AbortController();
  const begun = surface.optimise({ ...PAPER, iterations: 50 }, { signal: stop.signal, progress: () => stop.abort() });
  await assert.rejects(begun, { name: "AbortError" });
  assert(same(await surface.level(), before));
  await surface.optimise({ ...PAPER, reduction: 95 }, { measures: false });
  assert((await surface.level()).indices.length < before.indices.length);
});

test("newer settings take the place of older ones", async (t) => {
  const surface = await opened(t);
  const older = assert.rejects(surface.optimise(PAPER), { id: "npm-superseded" });
  await Promise.all([older, surface.optimise({ ...PAPER, reduction: 50 }, { measures: false })]);
  assert(Math.abs((await surface.level()).indices.length / 3 - TRIANGLES / 2) <= 1);
});

/** What Workers are asked from now on, and the last of them. */
function watched(t) {
  const { postMessage } = Worker.prototype;
  const seen = { jobs: [] };
  t.after(() => (Worker.prototype.postMessage = postMessage));
  Worker.prototype.postMessage = function (...data) {
    seen.worker = this;
    if (data[0].job) seen.jobs.push(data[0].job);
    return postMessage.apply(this, data);
  };
  return seen;
}

test("a Worker that is killed rejects what waits, and the next call begins anew", async (t) => {
  const seen = watched(t);
  const surface = await opened(t);
  await surface.optimise(PAPER, { measures: false });
  const before = await surface.save("stl");
  const waiting = surface.optimise({ ...PAPER, iterations: 50 }, { progress: () => void seen.worker.terminate() });
  await assert.rejects(waiting, (why) => why.id === "npm-stopped" && /^Lumen's Worker has stopped: [^.]+\.$/.test(why.message));
  assert(Buffer.from(before).equals(await surface.save("stl")), "made again from the file and the last settings");
});

test("calls after a Worker's death share the next one", async (t) => {
  const seen = watched(t);
  const surface = await opened(t);
  await surface.optimise(PAPER, { measures: false });
  const [before, half] = [await surface.level(), await surface.level(50)];
  const die = async () => {
    await seen.worker.terminate();
    seen.jobs.length = 0;
  };

  await die();
  const [level, other] = await Promise.all([surface.level(), surface.level(50)]);
  assert(same(level, before) && same(other, half));
  assert.deepEqual(seen.jobs, ["open", "optimise", "level", "level"]);

  // Who no longer wants it stops nobody else; newer settings take the place of the last.
  await die();
  const stop = new AbortController();
  const aborted = assert.rejects(surface.optimise(PAPER, { signal: stop.signal }), { name: "AbortError" });
  const newer = surface.optimise({ ...PAPER, reduction: 50 }, { measures: false });
  const waiting = surface.level();
  stop.abort();
  await Promise.all([aborted, newer]);
  assert(same(await waiting, half));
  assert.deepEqual(seen.jobs, ["open", "optimise", "level"]);

  await die();
  surface.close();
  const closed = { name: "LumenError", id: "npm-closed" };
  await assert.rejects(surface.level(), closed);
  await assert.rejects(surface.optimise(PAPER), closed);
  assert.deepEqual(seen.jobs, []);
});

test("a bundler for browsers finds no module of Node", async () => {
  for (const name of ["index.js", "worker.js"]) {
    assert.doesNotMatch(await readFile(join(built, name), "utf8"), /import\([^)]*["'`]node:/, name);
  }
});

test("a program that is done ends, though its surfaces are open", async () => {
  const text = `import { open } from "lumen-vessel"; import { readFileSync } from "node:fs";
    const surface = await open(readFileSync("tube.stl"), "tube.stl");
    await surface.optimise({ iterations: () => 0 }).catch(() => {});
    await surface.optimise({ iterations: 0, reduction: 90 }, { measures: false });
    console.log((await surface.level()).indices.length / 3);`;
  await writeFile(join(outside, "once.mjs"), text);
  await writeFile(join(outside, "tube.stl"), tube());
  const { stdout } = await run(process.execPath, ["once.mjs"], { cwd: outside, timeout: 60_000 });
  assert(Math.abs(Number(stdout) - TRIANGLES / 10) <= 1, stdout);
});
