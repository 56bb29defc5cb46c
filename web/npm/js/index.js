// Lumen for programs: a surface is opened, smoothed and reduced in a Worker of its own. What the functions take and give is in
// index.d.ts. Not for clinical decisions.

/** An error of Lumen's own: its `id` and `values` say what a program has to know, its `message` is plain English. */
export class LumenError extends Error {
  constructor({ id, values, message }) {
    super(message);
    this.name = "LumenError";
    this.id = id;
    this.values = values;
  }
}

/** What `measures` can be. */
const MEASURES = [true, false, "certificate"];
/** The largest reduction, in percent. */
const MOST = 99.9;

/** Reads a surface. `bytes` is a Uint8Array, an ArrayBuffer, a Blob or a File. */
export async function open(bytes, name = bytes.name ?? "", { unit, signal, progress } = {}) {
  if (typeof name !== "string") throw new TypeError("`name` is not a string.");
  if (unit !== undefined && typeof unit !== "string") throw new TypeError("`unit` is not a string.");
  // A Blob stays as it is, whatever becomes of the bytes: from it the surface is opened again after a Worker has died.
  const file = bytes instanceof Blob ? bytes : new Blob([bytes]);
  const surface = new Surface({ file, name, unit });
  surface.info = JSON.parse(await surface.begin({ signal, progress }));
  return surface;
}

class Surface {
  #opening;
  #line;
  #optimised;
  #isClosed = false;

  constructor(opening) {
    this.#opening = opening;
  }

  /** Opens the file in a new Worker. For `open` alone. */
  begin(options) {
    const line = (this.#line = new Line());
    line.opened = line.ask("open", this.#opening, options);
    line.opened.catch(() => line.end());
    return line.opened;
  }

  async optimise(settings = {}, { measures = "certificate", signal, progress } = {}) {
    if (!MEASURES.includes(measures)) throw new TypeError('`measures` is not true, false or "certificate".');
    signal?.throwIfAborted();
    // JSON alone would leave out what is no data, such as a function.
    const asked = { settings: JSON.stringify(structuredClone(settings)), measures };
    const line = await unlessAborted(this.#ready(), signal);
    return this.#make(line, asked, { signal, progress });
  }

  async level(reduction) {
    check(reduction);
    return this.#take("level", { reduction });
  }

  async centrelines() {
    return this.#take("centrelines", {});
  }

  async save(format, reduction) {
    if (typeof format !== "string") throw new TypeError("`format` is not a string.");
    check(reduction);
    return this.#take("save", { format, reduction });
  }

  close() {
    this.#isClosed = true;
    this.#line.end();
  }

  /** A Worker that has the file open: after one has died, all calls share the next. */
  async #ready() {
    if (this.#isClosed) throw closed();
    if (this.#line.died) this.begin();
    const line = this.#line;
    await line.opened;
    return line;
  }

  async #make(line, asked, options) {
    const making = line.ask("optimise", asked, options);
    line.making.add(making);
    try {
      const { report, certificate } = JSON.parse(await making);
      this.#optimised = { asked, line };
      return { report, verdict: report.verdict, certificate };
    } finally {
      line.making.delete(making);
    }
  }

  async #take(job, needed) {
    const line = await this.#ready();
    await this.#restore(line);
    return line.ask(job, needed);
  }

  /** Makes again what a Worker that has died had made, once for all calls; what newer settings make takes its place. */
  async #restore(line) {
    while (this.#optimised && this.#optimised.line !== line && !line.died) {
      const newest = [...line.making].at(-1);
      if (newest) await newest.catch(() => {});
      else
        await this.#make(line, this.#optimised.asked).catch((why) => {
          if (why.id !== "npm-superseded") throw why;
        });
    }
  }
}

function check(reduction) {
  if (reduction === undefined) return;
  if (typeof reduction !== "number") throw new TypeError("`reduction` is not a number.");
  if (!(reduction >= 0 && reduction <= MOST)) throw new RangeError(`\`reduction\` must lie between 0 and ${MOST} %, not ${reduction}.`);
}

/** Waits for what others wait for, too: the signal ends this waiting alone. */
function unlessAborted(promise, signal) {
  if (!signal) return promise;
  return new Promise((resolve, reject) => {
    const abort = () => reject(signal.reason);
    signal.addEventListener("abort", abort);
    promise.then(resolve, reject).finally(() => signal.removeEventListener("abort", abort));
  });
}

/** Not a literal: a bundler for browsers would look for it. */
const NODE = "node:worker_threads";

/** A Worker, and what it is asked. */
class Line {
  #calls = new Map();
  #last = 0;
  #worker = this.#start();
  /** The settings that are worked on, or wait for that. */
  making = new Set();
  /** Why nothing can be asked any more. */
  died = null;

  async #start() {
    const died = (why) => this.#die(stopped(String(why)));
    if (typeof Worker === "undefined") {
      const { Worker: Thread } = await import(/* webpackIgnore: true */ /* @vite-ignore */ NODE);
      const thread = new Thread(new URL("./worker.js", import.meta.url));
      thread.on("message", (data) => this.#hear(data));
      thread.on("error", (why) => died(why.message));
      thread.on("exit", () => died("it was ended"));
      return thread;
    }
    const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    worker.onmessage = (event) => this.#hear(event.data);
    worker.onerror = (event) => (event.preventDefault(), died(event.message ?? "it could not be loaded"));
    return worker;
  }

  async ask(job, needed, { signal, progress } = {}) {
    signal?.throwIfAborted();
    const worker = await this.#worker.catch((why) => this.#die(stopped(why.message)));
    signal?.throwIfAborted();
    if (this.died) throw this.died;
    const call = ++this.#last;
    // First: what cannot be posted throws, and is no call.
    worker.postMessage({ call, job, ...needed });
    return new Promise((resolve, reject) => {
      const cancel = () => this.#cancel(call, signal.reason);
      signal?.addEventListener("abort", cancel);
      this.#calls.set(call, { resolve, reject, progress, over: () => signal?.removeEventListener("abort", cancel) });
      // Node waits for a Worker that works, and for no other.
      worker.ref?.();
    });
  }

  #hear({ call, progress, result, refusal, died }) {
    if (died) this.#die(stopped(died));
    else if (progress) this.#tell(call, progress);
    else if (refusal) this.#end(call)?.reject(new LumenError(refusal));
    else this.#end(call)?.resolve(result);
  }

  /** Calls the caller's function: what that throws cancels the call. */
  #tell(call, progress) {
    try {
      this.#calls.get(call)?.progress?.(progress)?.catch?.((why) => this.#cancel(call, why));
    } catch (why) {
      this.#cancel(call, why);
    }
  }

  #cancel(call, why) {
    this.#worker.then((worker) => worker.postMessage({ cancel: call }), () => {});
    this.#end(call)?.reject(why);
  }

  #end(call) {
    const ended = this.#calls.get(call);
    this.#calls.delete(call);
    ended?.over();
    if (this.#calls.size === 0) this.#worker.then((worker) => worker.unref?.(), () => {});
    return ended;
  }

  #die(why) {
    this.died ??= why;
    for (const call of [...this.#calls.keys()]) this.#end(call).reject(this.died);
    this.#worker.then((worker) => worker.terminate(), () => {});
  }

  end() {
    this.#die(closed());
  }
}

function closed() {
  return new LumenError({ id: "npm-closed", values: {}, message: "The surface is closed." });
}

function stopped(why) {
  return new LumenError({ id: "npm-stopped", values: { why }, message: `Lumen's Worker has stopped: ${why}.` });
}
