// What the benches share that run a Worker of dist/ with dist/'s own module on an empty page, in headless Chromium.

import { dist } from "../tests/browser/browser.mjs";
import { serve } from "../tests/browser/server.mjs";

/** With these a page may read its clock to 5 microseconds, not to 100. */
const ISOLATED = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };
/** Longer than anything takes here. */
export const HOUR = 3_600_000;

/** Serves dist/ and `files`, which may get more later. */
export const serveBench = (files) => serve(dist, { headers: ISOLATED, files });

/** An empty page whose `window.worker` has this job. */
export async function workerPage(browser, server, files, job) {
  files["bench.html"] = { type: "text/html", body: "<!doctype html><title>bench</title>" };
  const page = await browser.newPage();
  page.setDefaultTimeout(HOUR);
  await page.goto(`${server.address}bench.html`);
  await page.evaluate(startWorker, job);
  return page;
}

/** In the page: starts the Worker as web/src/worker.rs does. */
async function startWorker(job) {
  const module = await WebAssembly.compileStreaming(fetch("lumen-web_bg.wasm"));
  window.worker = new Worker("worker.js", { type: "module" });
  window.worker.postMessage({ module, job });
}
