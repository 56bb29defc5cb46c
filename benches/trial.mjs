// The trial that benches/trial.rs has left, replayed by the trial's own Worker of dist/ in headless Chromium: how many
// steps a second it makes while the scripted input runs. `node benches/trial.mjs FOLDER` prints a line of JSON.

import { readFile } from "node:fs/promises";
import { launch } from "../tests/browser/browser.mjs";
import { serveBench, startWorker } from "./worker.mjs";

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
const found = await replay(facts);
console.log(JSON.stringify({ ...found, chromium: browser.version() }));
await browser.close();
await server.close();

/** Replays the log, and takes the speed that the frames tell. */
async function replay({ setup, steps, scripted }) {
  const speeds = [];
  let worker;
  const summary = await new Promise((resolve, reject) => {
    const hear = ({ failed, ready, summary, step, steps_per_second: speed }) => {
      if (failed) reject(new Error(failed));
      if (ready) worker.send({ replay: 2 }, ["log.csv"]).catch(reject);
      if (speed && step > steps - scripted && speed !== speeds.at(-1)) speeds.push(speed);
      if (summary) resolve(summary);
    };
    const start = async () => {
      worker = await startWorker(browser, server, files, "trial", hear);
      await worker.send({ start: 1, setup }, ["positions", "triangles"]);
    };
    start().catch(reject);
  });
  await worker.close();
  // The time of each stretch counts alike, not its speed.
  const stepsPerSecond = speeds.length / speeds.reduce((sum, speed) => sum + 1 / speed, 0);
  return { stepsPerSecond, stretches: speeds.length, step_ms: summary.step_ms, steps: summary.steps };
}
