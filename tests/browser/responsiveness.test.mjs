// The page stays responsive while the engine works on a million triangles: no task of the page's thread is long, frames
// among them, and none of the Worker's, between two of which it hears a cancel. The worst of each counts.
//
// Tasks are read from a trace of the browser. Their length is the processor time of their own thread: where there is no
// graphics card the drawing is done by other threads, on the same cores, and the clock on the wall would measure how many
// of these there are. What the wall says is told beside it.
//
// A surface that arrives is taken over in one task: its bytes are copied out of the message and into graphics memory. That
// is told apart (the page's messages are marked in the trace) and has a bound of its own, that of an answer that seems
// immediate: 100 ms (Miller 1968).

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { openFile, settled, workersOn } from "./app.mjs";
import { eventually, launch, openApp, press, program, texts, twin } from "./browser.mjs";

const TRIANGLES = 1_000_000;
/** Bounds, in milliseconds. */
const LONGEST_TASK = 16;
const LONGEST_ARRIVAL = 100;
/** Of the Worker, at a million triangles: some sums of the measures are one piece each (src/pipeline/shape.rs says so). */
const LONGEST_SLICE = 500;
/** From pressing it to the answer, by the wall, at worst. */
const LONGEST_CANCEL = 50;
/** What the status bar says while the engine works. */
const WORKING = "^(Finding pieces|Smoothing|Reducing|Taking the level|Measuring deviation) \\d+ %$";

let browser;
let folder;
before(async () => {
  browser = await launch();
  folder = await mkdtemp(join(tmpdir(), "lumen-"));
});
after(async () => {
  await browser.close();
  await rm(folder, { recursive: true });
});

const worst = (numbers) => numbers.reduce((most, it) => Math.max(most, it), 0);
const median = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];

/**
 * Moves the pointer over the views, so that each frame is drawn anew, for `count` frames at most and while `pattern`, if
 * there is one, matches some text. Returns the times between frames by the clock on the wall, in ms.
 */
function moveAround(page, count, pattern = "") {
  return page.evaluate(
    async ({ count, pattern }) => {
      const canvas = document.getElementById("lumen");
      const matches = new RegExp(pattern);
      const goesOn = () => [...document.querySelectorAll("#twins *")].some((twin) => !twin.firstElementChild && matches.test(twin.textContent));
      const times = [];
      let last = performance.now();
      for (let frame = 0; frame < count && goesOn(); frame++) {
        const place = { clientX: 640 + (frame % 40), clientY: 400, bubbles: true, pointerType: "mouse", isPrimary: true };
        canvas.dispatchEvent(new PointerEvent("pointermove", place));
        canvas.dispatchEvent(new MouseEvent("mousemove", place));
        // What follows is the test's own work, and a task of its own.
        const now = await new Promise((next) => requestAnimationFrame((now) => setTimeout(next, 0, now)));
        times.push(now - last);
        last = now;
      }
      return times;
    },
    { count, pattern },
  );
}

/**
 * Turns the view at the left with the pointer for `count` frames. Returns the times between frames by the clock on the wall, in
 * ms, but for the first ten, in which what is drawn becomes light.
 */
function turn(page, count) {
  return page.evaluate(async (count) => {
    const canvas = document.getElementById("lumen");
    const send = (type, x) => {
      const all = { clientX: x, clientY: 400, bubbles: true, pointerType: "mouse", isPrimary: true, pointerId: 1, buttons: 1, button: type === "move" ? -1 : 0 };
      canvas.dispatchEvent(new PointerEvent(`pointer${type}`, all));
      canvas.dispatchEvent(new MouseEvent(`mouse${type}`, all));
    };
    const times = [];
    send("down", 600);
    for (let frame = 0, last = 0; frame < count; frame++) {
      send("move", 600 + 3 * frame);
      const now = await new Promise((next) => requestAnimationFrame((now) => setTimeout(next, 0, now)));
      if (frame >= 10) times.push(now - last);
      last = now;
    }
    send("up", 600 + 3 * count);
    return times;
  }, count);
}

/** Runs in the page before the app: marks the large messages to and from the Workers, for the trace. */
function markMessages() {
  const kind = (message) => new Uint8Array(message[0])[0];
  const large = (message) => Array.isArray(message) && message.slice(1).some((buffer) => buffer.byteLength > 1e6);
  const Plain = Worker;
  window.Worker = class extends Plain {
    constructor(...all) {
      super(...all);
      this.addEventListener("message", ({ data }) => large(data) && performance.mark(`arrival: ${kind(data)}`));
    }
    postMessage(message, ...rest) {
      // The place of `Cancel`, which has no fields, as src/engine/message.rs tests it.
      if (message?.[0]?.byteLength === 1 && kind(message) === 7) window.cancelSent = performance.timeOrigin + performance.now();
      if (large(message)) performance.mark(`departure: ${kind(message)}`);
      return super.postMessage(message, ...rest);
    }
  };
}

/**
 * Runs `work` and returns the tasks of the page's thread and of the Worker's meanwhile, the longest first, as
 * { ms, wall, isFrame, what, takes }: `ms` of the thread's own processor time, and what the task takes over or hands out.
 */
async function traced(page, work) {
  const categories = ["devtools.timeline", "toplevel", "blink.user_timing", "disabled-by-default-devtools.timeline"];
  await browser.startTracing(page, { categories });
  await work();
  const events = JSON.parse((await browser.stopTracing()).toString()).traceEvents;
  const frames = events.filter((event) => event.name === "FireAnimationFrame");
  const threads = events.filter((event) => event.name === "thread_name");
  const main = threads.find(({ args, pid, tid }) => args?.name === "CrRendererMain" && frames.some((it) => it.pid === pid && it.tid === tid));
  assert(main, "the trace has the page's main thread");
  // One for each job; those that wait have no long tasks.
  const workers = threads.filter(({ args, pid }) => /DedicatedWorker/.test(args?.name) && pid === main.pid);
  const marks = events.filter(({ name, pid }) => pid === main.pid && /^(arrival|departure): /.test(name)).sort((a, b) => a.ts - b.ts);
  return { page: tasks(events, main, marks), worker: workers.flatMap((worker) => tasks(events, worker, [])).sort((a, b) => b.ms - a.ms) };
}

function tasks(events, { pid, tid }, marks) {
  const own = events.filter((event) => event.pid === pid && event.tid === tid && event.dur !== undefined);
  const within = (task) => (event) => event.ts >= task.ts && event.ts + event.dur <= task.ts + task.dur;
  const ms = (event) => (event.tdur ?? event.dur) / 1000;
  const run = own.filter((event) => /(^|::)RunTask$/.test(event.name) && event.dur > 4000);
  // A task is told by each layer that hands it on: the outermost is it.
  const isInner = (task) => run.some((other) => other !== task && within(other)(task) && (other.dur > task.dur || other.ts < task.ts || run.indexOf(other) < run.indexOf(task)));
  const long = run.filter((task) => !isInner(task)).sort((a, b) => a.ts - b.ts);
  const all = long.map((task) => {
    const parts = own.filter(within(task)).filter((event) => event !== task);
    const isFrame = parts.some((event) => event.name === "FireAnimationFrame");
    const what = [...new Set(parts.filter((event) => event.dur > task.dur / 3).map((event) => event.name))].join(", ");
    return { ts: task.ts, end: task.ts + task.dur, ms: ms(task), wall: task.dur / 1000, isFrame, what, takes: [] };
  });
  for (const { name, ts } of marks) {
    // What departs does so within its task; what has arrived is taken over in the next frame.
    const task = all.find((task) => (name.startsWith("departure") ? task.end >= ts : task.isFrame && task.ts >= ts));
    task?.takes.push(name);
  }
  return all.sort((a, b) => b.ms - a.ms);
}

const told = (tasks) =>
  tasks.map(({ ms, wall, isFrame, what, takes }) => `${ms.toFixed(1)} ms (${wall.toFixed(0)} by the wall; ${isFrame ? "frame" : what}${takes.length ? `; ${takes.join(", ")}` : ""})`).join("; ");

test("a million triangles are worked on beside a page that stays responsive", { skip: existsSync(program) ? false : `${program} is not built` }, async (t) => {
  const file = join(folder, "million.stl");
  await promisify(execFile)(program, ["phantom", "aorta", "--triangles", String(TRIANGLES), "-o", file]);
  const { page } = await openApp(t, browser, { before: (page) => page.addInitScript(markMessages) });
  await settled(page);
  const [worker] = workersOn(page, "pipeline");
  await worker.evaluate(watchCancelHeard);
  const is = new RegExp(WORKING);
  const working = () => eventually(() => texts(page), (all) => all.some((text) => is.test(text)), { what: "the work", timeout: 120_000 });

  let calm, moved;
  const idle = await traced(page, async () => (calm = await moveAround(page, 40)));
  const turned = await turn(page, 40);
  const opening = await traced(page, async () => {
    await openFile(page, file);
    await working();
    moved = await moveAround(page, 400, WORKING);
    await settled(page);
  });
  const again = await traced(page, async () => {
    await step(page);
    await working();
    await moveAround(page, 400, WORKING);
    await settled(page);
  });

  const answers = [];
  for (let tries = 0; answers.length < 5; tries++) {
    assert(tries < 15, `the work was over before it could be cancelled, ${tries - answers.length} times of ${tries}`);
    await step(page);
    await working();
    await press(page, "button", "Cancel");
    const { heard } = await eventually(
      async () => ({ isBusy: await twin(page, "button", "Cancel").count(), heard: await worker.evaluate(() => self.cancelHeard) }),
      ({ isBusy, heard }) => heard > 0 || !isBusy,
      { what: "the answer to cancel" },
    );
    // The work was over before the button was hit.
    if (!(heard > 0)) continue;
    answers.push(heard - (await page.evaluate(() => window.cancelSent)));
    await worker.evaluate(() => (self.cancelHeard = 0));
    await settled(page);
  }

  const busy = [...opening.page, ...again.page].sort((a, b) => b.ms - a.ms);
  const [arrivals, others] = [busy.filter(({ takes }) => takes.length > 0), busy.filter(({ takes }) => takes.length === 0)];
  const slices = again.worker;
  t.diagnostic(`idle: longest tasks ${told(idle.page.slice(0, 3))}`);
  t.diagnostic(`at work: longest tasks ${told(others.slice(0, 5))}`);
  t.diagnostic(`surfaces that come and go: ${told(arrivals)}`);
  t.diagnostic(`the Worker's longest tasks: ${told(slices.slice(0, 3))}`);
  t.diagnostic(`between frames by the wall: ${median(calm).toFixed(0)} ms idle (${worst(calm).toFixed(0)} at worst), ${median(moved).toFixed(0)} at work (${worst(moved).toFixed(0)} at worst)`);
  const mean = turned.reduce((sum, ms) => sum + ms, 0) / turned.length;
  t.diagnostic(`the sample turned: ${mean.toFixed(0)} ms a frame by the wall in the mean, ${median(turned).toFixed(0)} at the median`);
  t.diagnostic(`cancel answered after ${answers.map((ms) => ms.toFixed(0)).join(", ")} ms by the wall`);
  assert(moved.length > 5, `${moved.length} frames of work`);
  assert(arrivals.length > 0, "the surface arrived");
  assert(slices.length > 0, "the Worker's tasks were seen");
  assert(worst(others.map(({ ms }) => ms)) <= LONGEST_TASK, `a task of ${told(others.slice(0, 1))}`);
  assert(worst(arrivals.map(({ ms }) => ms)) <= LONGEST_ARRIVAL, `a task of ${told(arrivals.slice(0, 1))}`);
  assert(worst(answers) <= LONGEST_CANCEL, `cancel answered after ${worst(answers)} ms`);
  assert(worst(slices.map(({ ms }) => ms)) <= LONGEST_SLICE, `the Worker hears nothing for ${told(slices.slice(0, 1))}`);
});

/** One step of a slider by the keyboard: all stages begin anew. */
async function step(page) {
  const iterations = twin(page, "slider", "Iterations");
  await iterations.evaluate((twin) => twin.focus());
  await eventually(() => page.locator("#lumen").getAttribute("aria-activedescendant"), (id) => id !== null);
  await page.keyboard.press("ArrowRight");
}

/** Runs in the Worker: when was "Cancel" answered? The page may be drawing when the answer arrives. */
function watchCancelHeard() {
  const post = self.postMessage;
  self.postMessage = (message, ...rest) => {
    // The place of `Cancelled`, as src/engine/message.rs tests it.
    if (message?.[0]?.byteLength > 0 && new Uint8Array(message[0])[0] === 11) self.cancelHeard = performance.timeOrigin + performance.now();
    return post.call(self, message, ...rest);
  };
}
