// meshoptimizer's simplification as WebAssembly, run on request as benches/peers/native does: a line of JSON in, a line
// of JSON out. What is timed is the package's own call, from typed arrays to a typed array.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

const [folder] = process.argv.slice(2);
const require = createRequire(`${folder}/`);
const { MeshoptSimplifier } = await import(pathToFileURL(require.resolve("meshoptimizer/simplifier")));
await MeshoptSimplifier.ready;
/** No limit: the error is told as a part of the surface's extent. */
const ANY_ERROR = 1;

for await (const line of createInterface({ input: process.stdin })) {
  const { positions, indices, rates } = JSON.parse(line);
  const [points, corners] = [new Float32Array(words(positions)), new Uint32Array(words(indices))];
  const ms = rates.map((rate) => {
    const target = Math.floor((corners.length / 3) * (1 - rate / 100)) * 3;
    const begun = performance.now();
    MeshoptSimplifier.simplify(corners, points, 3, target, ANY_ERROR);
    return performance.now() - begun;
  });
  console.log(JSON.stringify({ ms }));
}

/** A file's bytes as a buffer of its own, so that any view fits. */
function words(path) {
  const bytes = readFileSync(path);
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
}
