// The examples of the package's readme with the libraries that they are for, and its types in TypeScript's compiler. With `--long`
// alone: the libraries are 100 MB.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { cp, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { promisify } from "node:util";
import { built } from "./built.mjs";
import { tube } from "./tube.mjs";

const libraries = process.env.LUMEN_EXAMPLES;
const skip = libraries ? false : "cargo xtask test --long has the libraries";
const run = promisify(execFile);

let folder, readme;
before(async () => {
  if (skip) return;
  folder = await mkdtemp(join(tmpdir(), "lumen-"));
  await cp(join(libraries, "node_modules"), join(folder, "node_modules"), { recursive: true });
  await cp(built, join(folder, "node_modules/lumen-vessel"), { recursive: true });
  await writeFile(join(folder, "package.json"), '{ "type": "module" }');
  readme = await readFile(join(built, "README.md"), "utf8");
});
after(() => folder && rm(folder, { recursive: true }));

/** The code below a heading of the readme. */
const example = (heading) => readme.split(`## ${heading}\n`)[1].split("```js\n")[1].split("```")[0];

async function imported(name, text) {
  await writeFile(join(folder, name), text);
  return import(pathToFileURL(join(folder, name)).href);
}

async function level(t) {
  const { open } = await imported("lumen.js", 'export * from "lumen-vessel";');
  const surface = await open(tube(), "tube.stl");
  t.after(() => surface.close());
  await surface.optimise({ reduction: 90 }, { measures: false });
  return surface.level();
}

test("three.js has the surface", { skip }, async (t) => {
  const { mesh } = await imported("three.js", example("three.js"));
  const made = await level(t);
  const { geometry } = mesh(made);
  geometry.computeBoundingBox();
  assert.equal(geometry.index.count, made.indices.length);
  assert(geometry.boundingBox.max.x > 30 && geometry.boundingBox.max.x < 36, `${geometry.boundingBox.max.x} mm`);
});

test("vtk.js has the surface", { skip }, async (t) => {
  const { polyData } = await imported("vtk.js", example("vtk.js"));
  const made = await level(t);
  const surface = polyData(made);
  assert.equal(surface.getPolys().getNumberOfCells(), made.indices.length / 3);
  assert.equal(surface.getNumberOfPoints(), made.positions.length / 3);
  const [, right] = surface.getBounds();
  assert(right > 30 && right < 36, `${right} mm`);
});

test("TypeScript knows the types, and refuses what is none", { skip }, async () => {
  const text = `import { open, LumenError, type Result } from "lumen-vessel";
    import "lumen-vessel/element";
    const surface = await open(new Uint8Array(), "a.stl", { unit: "mm", signal: AbortSignal.timeout(1) });
    const made: Result = await surface.optimise({ "pass-band": 0.01, smoothing: { iterations: 100 }, target: { Reduction: 900 }, keep: "All" }, { measures: true });
    const head: string = made.verdict.head;
    const radius: number | undefined = made.certificate?.branches[0].reduced.radius_mm?.mean;
    const corners: Uint32Array = (await surface.level(90)).indices;
    const vessel = document.querySelector("lumen-vessel")!.result?.report.output.triangles;
    await surface.optimise({ keep: "all", reduction: "auto" });
    await surface.optimise({ keep: 0, triangles: 500 });
    // @ts-expect-error
    await surface.optimise({ keep: "most" });
    // @ts-expect-error
    await surface.optimise({ "pas-band": 0.01 });
    // @ts-expect-error
    await surface.optimise({ target: "Most" });
    console.log(head, radius, corners, vessel, LumenError);`;
  await writeFile(join(folder, "typed.ts"), text);
  const options = ["--noEmit", "--strict", "--target", "es2022", "--module", "nodenext", "--lib", "es2022,dom", "typed.ts"];
  await run(process.execPath, [join(folder, "node_modules/typescript/bin/tsc"), ...options], { cwd: folder }).catch((why) => assert.fail(why.stdout));
});
