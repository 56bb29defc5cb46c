// The trial that benches/trial.rs has left, replayed by the trial's own Worker of dist/ in headless Chromium: how many
// steps a second it makes while the scripted input runs. `node benches/trial.mjs FOLDER` prints a line of JSON.

import { readFile } from "node:fs/promises";
import { launch } from "../tests/browser/browser.mjs";
import { serveBench, workerPage } from "./worker.mjs";

const folder = process.argv[2];
const binary = async (name) => ({ type: "application/octet-stream", body: await readFile(`${folder}/${name}`) });
const files = {
  positions: await binary("positions"),
  triangles: await binary("triangles"),
  "log.csv": await binary("log.csv"),
};
const facts = JSON.parse(await readFile(`${folder}/trial.json`, "utf8"));
const browser = await launch();
const server = await serveBench(files);
const page = await workerPage(browser, server, files, "trial");
const found = await page.evaluate(replay, facts);
console.log(JSON.stringify({ ...found, chromium: browser.version() }));
await browser.close();
await server.close();

/** In the page: replays the log, and takes the speed that the frames tell. */
async function replay({ setup, steps, scripted }) {
  const bytes = async (name) => (await fetch(name)).arrayBuffer();
  const [positions, triangles, csv] = await Promise.all(["positions", "triangles", "log.csv"].map(bytes));
  const { worker } = window;
  const speeds = [];
  return new Promise((resolve, reject) => {
    worker.onerror = (event) => reject(new Error(event.message || "the Worker could not be started"));
    worker.onmessage = ({ data: [header] }) => {
      const event = JSON.parse(header);
      const failed = event.Refused ?? event.Failed;
      if (failed) reject(new Error(failed.message));
      if (event.Ready) worker.postMessage([JSON.stringify({ Replay: { id: 2, csv: 0 } }), csv], [csv]);
      const frame = event.Frame?.frame;
      const speed = frame?.steps_per_second;
      if (speed && frame.step > steps - scripted && speed !== speeds.at(-1)) speeds.push(speed);
      if (event.Ended) {
        const { step_ms, steps: made } = event.Ended.summary;
        // The time of each stretch counts alike, not its speed.
        const stepsPerSecond = speeds.length / speeds.reduce((sum, speed) => sum + 1 / speed, 0);
        resolve({ stepsPerSecond, stretches: speeds.length, step_ms, steps: made });
      }
    };
    const header = { Start: { id: 1, mesh: { positions: 0, triangles: 1 }, sample: "coronary", setup } };
    worker.postMessage([JSON.stringify(header), positions, triangles], [positions, triangles]);
  });
}
