// Lumen's Worker: one surface and what is made of it. Work goes on in slices, between which it hears what else is asked of it.
//
// In come { call, job, ...what it needs } and { cancel: call }; out go { call, progress }, then { call, result } or
// { call, refusal }, and { died } where the program has ended and the Worker is of no use.

import initialise, { Reading, Wanted } from "./lumen-npm.js";

/** Between two slices a level can be asked for: a page that asks for one in each frame gets it. */
const SLICE_MS = 12;

const isNode = typeof WorkerGlobalScope === "undefined";
/** Not literals where they are imported: a bundler for browsers would look for them. */
const NODE = { files: "node:fs/promises", threads: "node:worker_threads" };
let post;
let lastWords = "";
// The program calls it when it panics, and ends in a trap.
globalThis.lumenLastWords = (words) => (lastWords = words);

const cancelled = new Set();
let surface;
let optimising;

/** By what a program says: `true`, `false` or "certificate". */
const WANTED = { false: Wanted.Levels, true: Wanted.Measures, certificate: Wanted.Certificate };

const jobs = {
  async open(call, { file, name, unit }) {
    const reading = new Reading(new Uint8Array(await file.arrayBuffer()), name, unit);
    while (!(surface = reading.advance(SLICE_MS))) await rest(call);
    reading.free();
    return surface.import();
  },

  async optimise(call, { settings, measures }) {
    surface.set(settings, WANTED[measures]);
    optimising = call;
    for (let told; (told = surface.advance(SLICE_MS)) !== undefined; ) {
      post({ call, progress: JSON.parse(told) });
      await rest(call);
      if (optimising !== call) throw { id: "npm-superseded", values: {}, message: "Newer settings have taken the place of these." };
    }
    return surface.result();
  },

  level: (_, { reduction }) => taken(surface.level(reduction)),
  centrelines: () => taken(surface.centrelines()),
  save: (_, { format, reduction }) => surface.save(format, reduction),
};

/** The arrays of an object of the program's. */
function taken(held) {
  const names = Object.getOwnPropertyNames(Object.getPrototypeOf(held)).filter((name) => ArrayBuffer.isView(held[name]));
  const arrays = Object.fromEntries(names.map((name) => [name, held[name]]));
  held.free();
  return arrays;
}

// A task of its own, and not a microtask: only then messages come in. A timer would make each slice 4 ms longer. Node hands out
// what comes through a channel before anything else comes.
const channel = isNode ? null : new MessageChannel();
const resting = [];
if (channel) channel.port1.onmessage = () => resting.shift()();
async function rest(call) {
  await new Promise((rested) => {
    if (isNode) return setImmediate(rested);
    resting.push(rested);
    channel.port2.postMessage(null);
  });
  if (cancelled.has(call)) throw { id: "npm-cancelled", values: {}, message: "Cancelled." };
}

async function hear({ call, job, cancel, ...needed }) {
  if (cancel) {
    cancelled.add(cancel);
    // At once: what is asked next is asked of what was there before.
    if (cancel === optimising) surface.cancel();
    return;
  }
  try {
    await ready;
    const result = await jobs[job](call, needed);
    const arrays = ArrayBuffer.isView(result) ? [result] : typeof result === "object" ? Object.values(result) : [];
    post({ call, result }, arrays.map((array) => array.buffer));
  } catch (why) {
    const refusal = typeof why === "string" ? JSON.parse(why) : why.id ? why : null;
    // What is no refusal is the end of the program: a panic, or no memory.
    post(refusal ? { call, refusal } : { died: lastWords || String(why?.message ?? why) });
  }
  cancelled.delete(call);
  if (call === optimising) optimising = undefined;
}

async function begin() {
  const address = new URL("./lumen-npm_bg.wasm", import.meta.url);
  if (!isNode) return initialise({ module_or_path: address });
  const { readFile } = await import(/* webpackIgnore: true */ /* @vite-ignore */ NODE.files);
  return initialise({ module_or_path: await readFile(address) });
}

const ready = begin();
// Whoever asks hears of it.
ready.catch(() => {});
if (isNode) {
  const { parentPort } = await import(/* webpackIgnore: true */ /* @vite-ignore */ NODE.threads);
  post = (message, transfer) => parentPort.postMessage(message, transfer);
  parentPort.on("message", hear);
} else {
  post = (message, transfer) => self.postMessage(message, transfer ?? []);
  self.onmessage = (event) => hear(event.data);
}
