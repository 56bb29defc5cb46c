// The trial that benches/trial.rs has left, replayed by the trial's own Worker of dist/ in headless Chromium: how many
// steps a second it makes while the scripted input runs. `node benches/trial.mjs FOLDER` prints a line of JSON.

import { readFile } from "node:fs/promises";
import { dist, launch } from "../tests/browser/browser.mjs";
import { serve } from "../tests/browser/server.mjs";

/** With these a page may read its clock to 5 microseconds, not to 100. */
const ISOLATED = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };

const folder = process.argv[2];
const binary = async (name) => ({ type: "application/octet-stream", body: await readFile(`${folder}/${name}`) });
const files = {
  "bench.html": { type: "text/html", body: "<!doctype html><title>bench</title>" },
  positions: await binary("positions"),
  triangles: await binary("triangles"),
  "log.csv": await binary("log.csv"),
};
const facts = JSON.parse(await readFile(`${folder}/trial.json`, "utf8"));
const browser = await launch();
const server = await serve(dist, { headers: ISOLATED, files });
const page = await browser.newPage();
page.setDefaultTimeout(600_000);
await page.goto(`${server.address}bench.html`);
const found = await page.evaluate(replay, facts);
console.log(JSON.stringify({ ...found, chromium: browser.version() }));
await browser.close();
await server.close();

/** In the page: starts the Worker as web/src/worker.rs does, replays the log, and takes the speed that the frames tell. */
async function replay({ setup, steps, scripted }) {
  const bytes = async (name) => (await fetch(name)).arrayBuffer();
  const [positions, triangles, csv] = await Promise.all(["positions", "triangles", "log.csv"].map(bytes));
  const module = await WebAssembly.compileStreaming(fetch("lumen-web_bg.wasm"));
  const worker = new Worker("worker.js", { type: "module" });
  worker.postMessage({ module, job: "trial" });
  const speeds = [];
  return new Promise((resolve, reject) => {
    worker.onerror = (event) => reject(new Error(event.message || "the Worker could not be started"));
    worker.onmessage = ({ data: [header] }) => {
      const event = JSON.parse(header);
      const failed = event.Refused ?? event.Failed;
      if (failed) reject(new Error(failed.message));
      if (event.Ready) worker.postMessage([JSON.stringify("Replay"), csv], [csv]);
      const speed = event.Frame?.steps_per_second;
      if (speed && event.Frame.step > steps - scripted && speed !== speeds.at(-1)) speeds.push(speed);
      if (event.Ended) {
        const { step_ms, steps: made } = event.Ended;
        // The time of each stretch counts alike, not its speed.
        const stepsPerSecond = speeds.length / speeds.reduce((sum, speed) => sum + 1 / speed, 0);
        resolve({ stepsPerSecond, stretches: speeds.length, step_ms, steps: made });
      }
    };
    const header = { Start: { id: 1, sample: "coronary", setup } };
    worker.postMessage([JSON.stringify(header), positions, triangles], [positions, triangles]);
  });
}
