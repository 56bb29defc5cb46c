// The page stays responsive while the engine works: the bounds on main-thread tasks, frame times and cancel.
//
// Tasks are read from a trace of the browser, so that the time a frame takes to draw, which without a graphics card is
// most of it, can be told from everything else the page does.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { grouped, openFile, settled } from "./app.mjs";
import { eventually, launch, openApp, press, program, texts, twin } from "./browser.mjs";

const TRIANGLES = 1_000_000;
/** Bounds of the issue, in milliseconds. */
const LONGEST_TASK = 16;
const LONGEST_CANCEL = 50;
const SLOWER_FRAMES = 1.1;

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

/** Moves the pointer over the views, so that each frame is drawn anew, and returns the times between frames in ms. */
function frameTimes(page, count) {
  return page.evaluate(async (count) => {
    const canvas = document.getElementById("lumen");
    const times = [];
    let last = await new Promise(requestAnimationFrame);
    for (let i = 0; i < count; i++) {
      const place = { clientX: 640 + (i % 40), clientY: 400, bubbles: true, pointerType: "mouse", isPrimary: true };
      canvas.dispatchEvent(new PointerEvent("pointermove", place));
      canvas.dispatchEvent(new MouseEvent("mousemove", place));
      const now = await new Promise(requestAnimationFrame);
      times.push(now - last);
      last = now;
    }
    return times;
  }, count);
}

/** The tasks of the page's main thread in a trace that draw no frame: { ms, what }, longest first. */
function tasksOutsideDraw(trace) {
  const events = JSON.parse(trace.toString()).traceEvents;
  const main = events.find((event) => event.name === "thread_name" && event.args?.name === "CrRendererMain" && hasFrames(events, event));
  assert(main, "the trace has the page's main thread");
  const own = events.filter((event) => event.pid === main.pid && event.tid === main.tid && event.dur !== undefined);
  const draws = own.filter((event) => event.name === "FireAnimationFrame");
  const within = (task) => (event) => event.ts >= task.ts && event.ts + event.dur <= task.ts + task.dur;
  return own
    .filter((event) => event.name === "RunTask" || event.name === "ThreadControllerImpl::RunTask")
    .filter((task) => task.dur > 4000 && !draws.some(within(task)))
    .map((task) => {
      const parts = own.filter(within(task)).filter((event) => event !== task && event.dur > task.dur / 3);
      return { ms: task.dur / 1000, what: [...new Set(parts.map((event) => event.name))].join(", ") };
    })
    .sort((a, b) => b.ms - a.ms);
}

function hasFrames(events, thread) {
  return events.some((event) => event.name === "FireAnimationFrame" && event.pid === thread.pid && event.tid === thread.tid);
}

test("a million triangles are worked on beside a page that stays responsive", { skip: existsSync(program) ? false : `${program} is not built` }, async (t) => {
  const file = join(folder, "million.stl");
  await promisify(execFile)(program, ["phantom", "aorta", "--triangles", String(TRIANGLES), "-o", file]);
  const { page } = await openApp(t, browser);
  await settled(page);
  const idle = median(await frameTimes(page, 120));

  await browser.startTracing(page, { categories: ["devtools.timeline", "disabled-by-default-devtools.timeline", "toplevel"] });
  await openFile(page, file);
  await eventually(() => texts(page), (all) => all.some((text) => /^Reducing \d+ %$/.test(text)), {
    what: "the decimation",
    timeout: 120_000,
  });
  const busy = median(await frameTimes(page, 120));
  const heard = await cancelTime(page);
  const tasks = tasksOutsideDraw(await browser.stopTracing());

  t.diagnostic(`median frame: idle ${idle.toFixed(1)} ms, busy ${busy.toFixed(1)} ms; cancel heard after ${heard.toFixed(0)} ms`);
  t.diagnostic(`longest tasks outside the draw: ${tasks.slice(0, 5).map(({ ms, what }) => `${ms.toFixed(1)} ms (${what})`).join("; ")}`);
  assert((tasks[0]?.ms ?? 0) <= LONGEST_TASK, `a task of ${tasks[0]?.ms} ms: ${tasks[0]?.what}`);
  assert(busy <= idle * SLOWER_FRAMES, `${busy} ms a frame, ${idle} ms when idle`);
  assert(heard <= LONGEST_CANCEL, `${heard} ms until cancel is heard`);
  assert((await settled(page)).length > 0, `${grouped(TRIANGLES)} triangles given up, something is still shown`);
});

/** Presses "Cancel" and returns how many milliseconds pass until the button is gone, seen from within the page. */
async function cancelTime(page) {
  const cancel = await twin(page, "button", "Cancel").elementHandle();
  const gone = page.evaluate(
    (cancel) =>
      new Promise((resolve) => {
        let pressed;
        addEventListener("pointerup", () => (pressed = performance.now()), { capture: true, once: true });
        const watch = new MutationObserver(() => !cancel.isConnected && pressed && resolve(performance.now() - pressed));
        watch.observe(document.getElementById("twins"), { childList: true, subtree: true });
      }),
    cancel,
  );
  await press(page, "button", "Cancel");
  return gone;
}
