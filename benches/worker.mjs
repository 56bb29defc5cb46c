// What the benches share that run a Worker of dist/ with dist/'s own module on an empty page, in headless Chromium.

import { spawn } from "node:child_process";
import { once } from "node:events";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { dist } from "../tests/browser/browser.mjs";
import { serve } from "../tests/browser/server.mjs";

/** With these a page may read its clock to 5 microseconds, not to 100. */
const ISOLATED = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };
/** Longer than anything takes here. */
export const HOUR = 3_600_000;

/** Serves dist/ and `files`, which may get more later. */
export const serveBench = (files) => serve(dist, { headers: ISOLATED, files });

/**
 * A Worker with this job on an empty page. `send(command, arrays)` sends what benches/messages.rs makes of a command, with
 * files of the server as its arrays; `hear(event)` gets what that tells of each message of the Worker.
 */
export async function startWorker(browser, server, files, job, hear) {
  files["bench.html"] = { type: "text/html", body: "<!doctype html><title>bench</title>" };
  const page = await browser.newPage();
  page.setDefaultTimeout(HOUR);
  const interpreter = await interpret();
  await page.exposeFunction("hear", async (head, lengths) => hear(await interpreter.ask({ job, head, lengths })));
  await page.exposeFunction("died", (failed) => hear({ failed }));
  await page.goto(`${server.address}bench.html`);
  await page.evaluate(start, job);
  const send = async (command, arrays = []) => {
    const { head } = await interpreter.ask(command);
    await page.evaluate(post, { head, arrays });
  };
  return { page, send, close: () => interpreter.close() };
}

/** benches/messages.rs, which reads and writes the Worker's messages. */
async function interpret() {
  const bench = ["bench", "--quiet", "--bench=messages", "--no-default-features"];
  const cwd = fileURLToPath(new URL("..", import.meta.url));
  const child = spawn("cargo", bench, { cwd, stdio: ["pipe", "pipe", "inherit"] });
  const waiting = [];
  createInterface({ input: child.stdout }).on("line", (line) => waiting.shift().resolve(JSON.parse(line)));
  const ended = once(child, "exit");
  ended.then(() => waiting.forEach(({ reject }) => reject(new Error("benches/messages.rs has ended"))));
  const ask = (question) =>
    new Promise((resolve, reject) => {
      waiting.push({ resolve, reject });
      child.stdin.write(`${JSON.stringify(question)}\n`);
    });
  const close = () => (child.stdin.end(), ended);
  return { ask, close };
}

/** In the page: starts the Worker as web/src/worker.rs does. */
async function start(job) {
  const module = await WebAssembly.compileStreaming(fetch("lumen-web_bg.wasm"));
  const worker = new Worker("worker.js", { type: "module" });
  worker.onerror = (event) => window.died(event.message || "the Worker could not be started");
  // What is no list is between the Worker and the page's devices.
  worker.onmessage = ({ data }) => {
    if (!Array.isArray(data)) return;
    const [head, ...arrays] = data;
    window.hear([...new Uint8Array(head)], arrays.map(({ byteLength }) => byteLength));
  };
  worker.postMessage({ module, job });
  window.worker = worker;
}

/** In the page: sends a message. */
async function post({ head, arrays }) {
  const bytes = async (name) => (await fetch(name, { cache: "no-store" })).arrayBuffer();
  const message = [new Uint8Array(head).buffer, ...(await Promise.all(arrays.map(bytes)))];
  window.worker.postMessage(message, message.slice(1));
}
