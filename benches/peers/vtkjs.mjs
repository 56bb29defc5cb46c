// vtk.js, which is VTK rewritten in JavaScript for the browser: its windowed-sinc filter and its normals, run on request
// as benches/peers/native does: a line of JSON in, a line of JSON out. It has no decimation. Node has Chromium's engine.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

const [folder] = process.argv.slice(2);
const require = createRequire(`${folder}/`);
const filter = async (path) => (await import(pathToFileURL(require.resolve(`@kitware/vtk.js/${path}.js`)))).default;
const [PolyData, WindowedSinc, Normals] = await Promise.all(
  ["Common/DataModel/PolyData", "Filters/General/WindowedSincPolyDataFilter", "Filters/Core/PolyDataNormals"].map(filter),
);

for await (const line of createInterface({ input: process.stdin })) {
  const { positions, indices, iterations } = JSON.parse(line);
  const surface = polyData(new Float32Array(words(positions)), new Uint32Array(words(indices)));
  const smoothing = iterations.map((numberOfIterations) =>
    timed(WindowedSinc.newInstance({ passBand: 0.1, numberOfIterations }), surface),
  );
  console.log(JSON.stringify({ smoothing, normals: timed(Normals.newInstance(), surface) }));
}

/** Milliseconds of a filter's update. */
function timed(step, surface) {
  step.setInputData(surface);
  const begun = performance.now();
  step.update();
  return performance.now() - begun;
}

function polyData(points, corners) {
  const cells = new Uint32Array((corners.length / 3) * 4);
  for (let from = 0, to = 0; from < corners.length; from += 3, to += 4) {
    cells.set([3, corners[from], corners[from + 1], corners[from + 2]], to);
  }
  const surface = PolyData.newInstance();
  surface.getPoints().setData(points, 3);
  surface.getPolys().setData(cells);
  return surface;
}

/** A file's bytes as a buffer of its own, so that any view fits. */
function words(path) {
  const bytes = readFileSync(path);
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
}
