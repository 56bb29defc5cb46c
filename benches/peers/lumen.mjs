// Lumen's engine as the browser runs it: dist/'s own Worker with dist/'s own module, in headless Chromium. A line of
// JSON in, a line of JSON out.
//
// {"do": "stages", "file": PATH, "steps": [SETTINGS, ...]} opens the file in a Worker with the first settings, then
// goes through the others, and answers {"reports": [...], "bytes": N}: the engine's own report of each, as soon as its
// level is there, and the size of the Worker's memory after them.
//
// {"do": "app", "file": PATH} opens the file in the app itself, as a user does, waits until everything is measured, and
// answers {"texts": [...], "page": N, "worker": N, "seconds": N}: what the page shows, and the bytes of both memories.

import { readFile } from "node:fs/promises";
import { createInterface } from "node:readline";
import { openFile, settled } from "../../tests/browser/app.mjs";
import { launch, started } from "../../tests/browser/browser.mjs";
import { HOUR, serveBench, startWorker } from "../worker.mjs";

/** Milliseconds of a look. */
const LOOK = 1500;

const browser = await launch();
const files = {};
const server = await serveBench(files);
let stages;

for await (const line of createInterface({ input: process.stdin })) {
  const { do: what, ...question } = JSON.parse(line);
  const answer = what === "app" ? await app(question) : await (await (stages ??= engine()))(question);
  console.log(JSON.stringify({ ...answer, chromium: browser.version() }));
}
await (await stages)?.close();
await browser.close();
await server.close();

/** An empty page with a Worker, which serves one question after another, so that its code is warm. */
async function engine() {
  // What the Worker is asked for, and whoever waits for it.
  let asked;
  const hear = ({ generation, report, failed }) => {
    if (failed) asked?.reject(new Error(failed));
    if (report && generation === asked?.generation) asked.resolve(report);
  };
  const worker = await startWorker(browser, server, files, "pipeline", hear);
  const measured = async (generation, command, arrays) => {
    const report = new Promise((resolve, reject) => (asked = { generation, resolve, reject }));
    await worker.send(command, arrays);
    return report;
  };
  let generation = 0;
  const ask = async ({ file, steps: [first, ...others] }) => {
    files["input"] = { type: "application/octet-stream", body: await readFile(file) };
    generation += 1;
    const opening = { open: generation, name: file.split("/").at(-1), settings: first };
    const reports = [await measured(generation, opening, ["input"])];
    for (const settings of others) {
      // As after a look at the result: what the engine gets ready while nothing is asked of it is there.
      await new Promise((resolve) => setTimeout(resolve, LOOK));
      generation += 1;
      reports.push(await measured(generation, { set: generation, settings }));
    }
    return { reports, bytes: await memory(worker.page.workers()[0]) };
  };
  return Object.assign(ask, { close: worker.close });
}

/** Bytes of the memory of Lumen's instance in a page or a Worker: its glue gives the instance that is there already. */
function memory(realm) {
  return realm.evaluate(async () => {
    const loaded = performance.getEntriesByType("resource").map(({ name }) => name);
    const glue = loaded.find((name) => /lumen-web\.js/.test(name)) ?? new URL(`lumen-web.js${self.location.search}`, self.location).href;
    return (await import(glue)).initSync().memory.buffer.byteLength;
  });
}

async function app({ file }) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  try {
    await page.goto(server.address);
    await started(page);
    await settled(page);
    const begun = performance.now();
    await openFile(page, file);
    const name = file.split("/").at(-1);
    await page.waitForFunction((name) => document.querySelector("#twins").textContent.includes(name), name, { timeout: HOUR });
    const texts = await settled(page, HOUR);
    const seconds = (performance.now() - begun) / 1000;
    return { texts, page: await memory(page), worker: await memory(page.workers()[0]), seconds };
  } finally {
    await context.close();
  }
}
