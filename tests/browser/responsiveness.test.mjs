// The page stays responsive while the engine works: the bounds on main-thread tasks, frame times and cancel.
//
// Tasks are read from a trace of the browser, so that the frames can be told from everything else the page does. Where
// there is no graphics card the drawing itself takes every core there is, and the clock on the wall would measure how
// many there are; so tasks and frames are measured in the main thread's own processor time.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { openFile, settled } from "./app.mjs";
import { eventually, launch, openApp, press, program, texts, twin } from "./browser.mjs";

const TRIANGLES = 1_000_000;
/** Bounds of the issue, in milliseconds. */
const LONGEST_TASK = 16;
const LONGEST_CANCEL = 50;
/** A tenth of a frame at 60 frames a second. */
const SLOWER_FRAME = 1.67;
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

const median = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];

/**
 * Moves the pointer over the views, so that each frame is drawn anew, for `count` frames, or as long as some text
 * matches `pattern`.
 */
function moveAround(page, count, pattern = "") {
  return page.evaluate(
    async ({ count, pattern }) => {
      const canvas = document.getElementById("lumen");
      const matches = new RegExp(pattern);
      const goesOn = () => [...document.querySelectorAll("#twins *")].some((twin) => matches.test(twin.textContent));
      let frames = 0;
      for (; frames < count && goesOn(); frames++) {
        const place = { clientX: 640 + (frames % 40), clientY: 400, bubbles: true, pointerType: "mouse", isPrimary: true };
        canvas.dispatchEvent(new PointerEvent("pointermove", place));
        canvas.dispatchEvent(new MouseEvent("mousemove", place));
        await new Promise(requestAnimationFrame);
      }
      return frames;
    },
    { count, pattern },
  );
}

/** Runs `work` and returns what the page's main thread did meanwhile, in ms: its frames, and its other tasks. */
async function traced(page, work) {
  await browser.startTracing(page, { categories: ["devtools.timeline", "disabled-by-default-devtools.timeline", "toplevel"] });
  await work();
  const events = JSON.parse((await browser.stopTracing()).toString()).traceEvents;
  const main = events.find((event) => event.name === "thread_name" && event.args?.name === "CrRendererMain" && hasFrames(events, event));
  assert(main, "the trace has the page's main thread");
  const own = events.filter((event) => event.pid === main.pid && event.tid === main.tid && event.dur !== undefined);
  const ms = (event) => (event.tdur ?? event.dur) / 1000;
  const draws = own.filter((event) => event.name === "FireAnimationFrame");
  const within = (task) => (event) => event.ts >= task.ts && event.ts + event.dur <= task.ts + task.dur;
  const tasks = own
    .filter((event) => /(^|::)RunTask$/.test(event.name) && ms(event) > 4 && !draws.some(within(event)))
    .map((task) => {
      const parts = own.filter(within(task)).filter((event) => event !== task && event.dur > task.dur / 3);
      return { ms: ms(task), what: [...new Set(parts.map((event) => event.name))].join(", ") };
    });
  return { frames: draws.map(ms), tasks: tasks.sort((a, b) => b.ms - a.ms) };
}

function hasFrames(events, thread) {
  return events.some((event) => event.name === "FireAnimationFrame" && event.pid === thread.pid && event.tid === thread.tid);
}

test("a million triangles are worked on beside a page that stays responsive", { skip: existsSync(program) ? false : `${program} is not built` }, async (t) => {
  const file = join(folder, "million.stl");
  await promisify(execFile)(program, ["phantom", "aorta", "--triangles", String(TRIANGLES), "-o", file]);
  const { page } = await openApp(t, browser, { before: (page) => page.addInitScript(watchCancelSent) });
  await settled(page);
  const [worker] = page.workers();
  await worker.evaluate(watchCancelHeard);
  const is = new RegExp(WORKING);
  const working = () => eventually(() => texts(page), (all) => all.some((text) => is.test(text)), { what: "the work", timeout: 120_000 });

  const idle = await traced(page, () => moveAround(page, 40));
  let moved;
  const busy = await traced(page, async () => {
    await openFile(page, file);
    await working();
    moved = await moveAround(page, 40, WORKING);
  });
  await settled(page);
  const answers = [];
  const iterations = twin(page, "slider", "Iterations");
  for (let i = 0; i < 5; i++) {
    // One step by the keyboard: all stages begin anew.
    await iterations.evaluate((twin) => twin.focus());
    await eventually(() => page.locator("#lumen").getAttribute("aria-activedescendant"), (id) => id !== null);
    await page.keyboard.press("ArrowRight");
    await working();
    await press(page, "button", "Cancel");
    const heard = await eventually(() => worker.evaluate(() => self.cancelHeard), (at) => at > 0, { what: "the answer to cancel" });
    answers.push(heard - (await page.evaluate(() => window.cancelSent)));
    await worker.evaluate(() => (self.cancelHeard = 0));
    await settled(page);
  }
  const heard = median(answers);

  const [calm, loaded] = [median(idle.frames), median(busy.frames)];
  t.diagnostic(`median frame: ${calm.toFixed(1)} ms idle, ${loaded.toFixed(1)} ms busy (${moved} frames of work)`);
  t.diagnostic(`longest tasks beside frames: ${busy.tasks.slice(0, 5).map(({ ms, what }) => `${ms.toFixed(1)} ms (${what})`).join("; ")}`);
  t.diagnostic(`cancel answered after ${answers.map((ms) => ms.toFixed(0)).join(", ")} ms`);
  assert((busy.tasks[0]?.ms ?? 0) <= LONGEST_TASK, `a task of ${busy.tasks[0]?.ms} ms: ${busy.tasks[0]?.what}`);
  assert(loaded <= calm + SLOWER_FRAME, `${loaded} ms a frame, ${calm} ms when idle`);
  assert(heard <= LONGEST_CANCEL, `${heard} ms until cancel is answered`);
  await settled(page);
});

/** Runs in the page before the app: when was "Cancel" sent, in ms since 1970? */
function watchCancelSent() {
  const post = Worker.prototype.postMessage;
  Worker.prototype.postMessage = function (message, ...rest) {
    if (message?.[0] === '"Cancel"') window.cancelSent = performance.timeOrigin + performance.now();
    return post.call(this, message, ...rest);
  };
}

/** Runs in the Worker: when was "Cancel" answered? The page may be drawing when the answer arrives. */
function watchCancelHeard() {
  const post = self.postMessage;
  self.postMessage = (message, ...rest) => {
    if (message?.[0]?.startsWith?.('{"Cancelled"')) self.cancelHeard = performance.timeOrigin + performance.now();
    return post.call(self, message, ...rest);
  };
}
