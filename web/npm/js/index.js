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

/** Reads a surface. `bytes` is a Uint8Array, an ArrayBuffer, a Blob or a File. */
export async function open(bytes, name = bytes.name ?? "", { unit, signal, progress } = {}) {
  // A Blob stays as it is, whatever becomes of the bytes: from it the surface is opened again after a Worker has died.
  const file = bytes instanceof Blob ? bytes : new Blob([bytes]);
  const surface = new Surface({ file, name, unit });
  surface.info = await surface.begun({ signal, progress });
  return surface;
}

class Surface {
  #opening;
  #line;
  #optimised;

  constructor(opening) {
    this.#opening = opening;
  }

  /** A living Worker with the file opened; `undefined` where there is one, else what the file is. For `open` alone. */
  async begun(options) {
    if (this.#line && !this.#line.died) return this.#line.opened.then(() => undefined);
    const line = (this.#line = new Line());
    line.opened = line.ask("open", this.#opening, options);
    try {
      return JSON.parse(await line.opened);
    } catch (why) {
      line.end();
      throw why;
    }
  }

  async optimise(settings = {}, { measures = "certificate", signal, progress } = {}) {
    await this.begun({ signal });
    const [asked, line] = [{ settings, measures }, this.#line];
    const { report, certificate } = JSON.parse(await line.ask("optimise", asked, { signal, progress }));
    this.#optimised = { asked, line };
    return { report, verdict: report.verdict, certificate };
  }

  level(reduction) {
    return this.#taken("level", { reduction });
  }

  centrelines() {
    return this.#taken("centrelines", {});
  }

  save(format, reduction) {
    return this.#taken("save", { format, reduction });
  }

  close() {
    this.#line?.end();
  }

  /** Takes something out of what was made, which is made again where its Worker has died. */
  async #taken(job, needed) {
    await this.begun();
    if (this.#optimised && this.#optimised.line !== this.#line) {
      const { settings, measures } = this.#optimised.asked;
      await this.optimise(settings, { measures });
    }
    return this.#line.ask(job, needed);
  }
}

/** A Worker, and what it is asked. */
class Line {
  #calls = new Map();
  #last = 0;
  #worker = this.#start();
  died = false;

  async #start() {
    const died = (why) => this.#die(String(why));
    if (typeof Worker === "undefined") {
      const { Worker: Thread } = await import(/* webpackIgnore: true */ /* @vite-ignore */ "node:worker_threads");
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
    const worker = await this.#worker.catch((why) => this.#die(why.message));
    signal?.throwIfAborted();
    if (this.died) throw stopped(this.died);
    return new Promise((resolve, reject) => {
      const call = ++this.#last;
      const cancel = () => {
        worker.postMessage({ cancel: call });
        this.#end(call)?.reject(signal.reason);
      };
      signal?.addEventListener("abort", cancel);
      this.#calls.set(call, { resolve, reject, progress, over: () => signal?.removeEventListener("abort", cancel) });
      // Node waits for a Worker that works, and for no other.
      worker.ref?.();
      worker.postMessage({ call, job, ...needed });
    });
  }

  #hear({ call, progress, result, refusal, died }) {
    if (died) this.#die(died);
    else if (progress) this.#calls.get(call)?.progress?.(progress);
    else if (refusal) this.#end(call)?.reject(new LumenError(refusal));
    else this.#end(call)?.resolve(result);
  }

  #end(call) {
    const ended = this.#calls.get(call);
    this.#calls.delete(call);
    ended?.over();
    if (this.#calls.size === 0) this.#worker.then((worker) => worker.unref?.(), () => {});
    return ended;
  }

  #die(why) {
    this.died ||= why;
    for (const call of [...this.#calls.keys()]) this.#end(call).reject(stopped(why));
    this.#worker.then((worker) => worker.terminate(), () => {});
  }

  end() {
    this.#die("the surface was closed");
  }
}

function stopped(why) {
  return new LumenError({ id: "npm-stopped", values: { why }, message: `Lumen's Worker has stopped: ${why}.` });
}
