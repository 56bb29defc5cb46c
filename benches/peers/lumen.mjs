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
import { HOUR, serveBench, workerPage } from "../worker.mjs";

const browser = await launch();
const files = {};
const server = await serveBench(files);
let stages;

for await (const line of createInterface({ input: process.stdin })) {
  const { do: what, ...question } = JSON.parse(line);
  const answer = what === "app" ? await app(question) : await (await (stages ??= engine()))(question);
  console.log(JSON.stringify({ ...answer, chromium: browser.version() }));
}
await browser.close();
await server.close();

/** An empty page with a Worker, which serves one question after another, so that its code is warm. */
async function engine() {
  const page = await workerPage(browser, server, files, "pipeline");
  let opened = 0;
  return async ({ file, steps }) => {
    files["input"] = { type: "application/octet-stream", body: await readFile(file) };
    const reports = await page.evaluate(runSteps, { name: file.split("/").at(-1), steps, first: opened });
    opened += steps.length;
    return { reports, bytes: await memory(page.workers()[0]) };
  };
}

/** In the page: opens the file with the first settings and goes through the others; the report of each. */
async function runSteps({ name, steps, first }) {
  const { worker } = window;
  const answer = (generation) =>
    new Promise((resolve, reject) => {
      worker.onerror = (event) => reject(new Error(event.message || "the Worker could not be started"));
      worker.onmessage = ({ data: [header] }) => {
        const event = JSON.parse(header);
        const [failed] = [event.Failed, event.OpenFailed].filter(Boolean);
        if (failed) reject(new Error(failed.message));
        if (event.Measured?.generation === generation) resolve(event.Measured.report);
      };
    });
  const LOOK = 1500;
  const bytes = await (await fetch("input", { cache: "no-store" })).arrayBuffer();
  const reports = [];
  for (const [step, settings] of steps.entries()) {
    const generation = first + step + 1;
    const heard = answer(generation);
    if (step === 0) {
      const source = { File: { name, bytes: 0, options: { unit: null } } };
      const header = { Open: { id: generation, source, settings } };
      worker.postMessage([JSON.stringify(header), bytes], [bytes]);
    } else {
      // As after a look at the result: what the engine gets ready while nothing is asked of it is there.
      await new Promise((resolve) => setTimeout(resolve, LOOK));
      worker.postMessage([JSON.stringify({ Set: { generation, settings } })]);
    }
    reports.push(await heard);
  }
  return reports;
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
