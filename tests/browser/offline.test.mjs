// Without a network: the page starts and works from what the first visit has left, a new build takes the place of the old
// one at the next start, and no page ever has files of two.

import assert from "node:assert/strict";
import { mkdtemp, rename, rm, symlink } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { OCTAHEDRON, openFile, settled, shownTriangles } from "./app.mjs";
import { COARSE, dist, eventually, launch, openApp, started } from "./browser.mjs";
import { anotherBuild, versionOf } from "./builds.mjs";

let browser, scratch;
before(async () => {
  browser = await launch();
  scratch = await mkdtemp(join(tmpdir(), "lumen-offline-"));
});
after(async () => {
  await browser.close();
  await rm(scratch, { recursive: true });
});

/** Waits until the page's worker has everything that it keeps. */
const kept = (page) =>
  page.evaluate(() => navigator.serviceWorker.ready.then(({ active }) => new Promise((done) => {
    const look = () => (active.state === "activated" ? done() : active.addEventListener("statechange", look, { once: true }));
    look();
  })));

/** The version of the build that the page is of, and those of all that it has loaded. */
async function versions(page) {
  await started(page);
  const found = await page.evaluate(() => ({
    page: document.querySelector('meta[name="lumen-version"]').content,
    loaded: performance
      .getEntriesByType("resource")
      .map(({ name }) => new URL(name).searchParams.get("v"))
      .filter((version) => version !== null),
  }));
  assert(found.loaded.length >= 4, "the test hears what is loaded");
  assert.deepEqual([...new Set(found.loaded)], [found.page], "one page, one build");
  return found.page;
}

/** Waits until the page has found the new build that is served, and that waits. */
async function findNew(page) {
  await page.evaluate(() => navigator.serviceWorker.getRegistration().then((registration) => registration.update()));
  const waits = () => page.evaluate(() => navigator.serviceWorker.getRegistration().then(({ waiting }) => waiting !== null));
  await eventually(waits, Boolean, { what: "the new build, ready" });
  assert.equal((await caches(page)).length, 2);
}

/** Waits until the page is of a build, whole. */
async function becomes(page, wanted) {
  await eventually(
    () => page.evaluate(() => document.querySelector('meta[name="lumen-version"]')?.content).catch(() => null),
    (version) => version === wanted,
    { what: "the new build" },
  );
  assert.equal(await versions(page), wanted);
}

/** The text of a file as the page gets it. */
const text = (page, address) => page.evaluate((address) => fetch(address).then((response) => response.text()), address);

const caches = (page) => page.evaluate(() => globalThis.caches.keys());

/** A folder to serve that can be another one a moment later. */
async function served(name, folder) {
  const path = join(scratch, name);
  const to = async (folder) => {
    await symlink(folder, `${path}.next`);
    await rename(`${path}.next`, path);
  };
  await to(folder);
  return { path, to };
}

test("after the first visit the page starts and opens files with the network cut", async (t) => {
  const requests = [];
  const listen = (page) => page.context().on("request", (request) => requests.push(request.url()));
  const { page, server, address, wrong } = await openApp(t, browser, { context: COARSE, query: "", before: listen });
  await settled(page);
  await kept(page);
  assert.equal((await caches(page)).length, 1);
  await server.close();
  await assert.rejects(fetch(address), "the server is gone");

  await page.reload();
  await versions(page);
  await settled(page);
  await openFile(page, OCTAHEDRON);
  await eventually(() => settled(page), (all) => shownTriangles(all) < 8, { what: "the octahedron, reduced" });
  assert.deepEqual(wrong, []);
  const elsewhere = requests.filter((url) => !url.startsWith(address) && !url.startsWith("blob:") && !url.startsWith("data:"));
  assert.deepEqual(elsewhere, [], "no request to another origin");
});

test("a new build takes the place of the old one at the next start, whole", async (t) => {
  const [first, second] = [dist, join(scratch, "second")];
  await anotherBuild(first, second, "second");
  const folder = await served("new-build", first);
  const { page, wrong } = await openApp(t, browser, { context: COARSE, folder: folder.path });
  const before = await versions(page);
  assert.equal(before, await versionOf(first));
  await kept(page);

  await folder.to(second);
  await findNew(page);
  // The page that is open goes on with the files of its own build.
  const style = await text(page, `style.css?v=${before}`);
  assert(!style.includes("second"));

  await page.reload();
  const after = await versionOf(second);
  await becomes(page, after);
  assert((await text(page, `style.css?v=${after}`)).includes("second"));
  await eventually(() => caches(page), (names) => names.length === 1 && names[0].endsWith(after), { what: "the old build, gone" });
  // A file of another build is none at all.
  assert.equal(await text(page, `style.css?v=${before}`).catch(() => "refused"), "refused");
  assert.deepEqual(wrong.filter((line) => !line.includes("ERR_FAILED")), []);
});

test("a second tab leaves the first its build, and a link that is opened alone has the new one", async (t) => {
  const next = join(scratch, "next");
  await anotherBuild(dist, next, "next");
  const folder = await served("two-tabs", dist);
  const { page, address, wrong } = await openApp(t, browser, { context: COARSE, folder: folder.path });
  const before = await versions(page);
  await kept(page);
  await folder.to(next);
  await findNew(page);

  const second = await page.context().newPage();
  await second.goto(address);
  assert.equal(await versions(second), before);
  // What the first has not asked for yet, a Worker for the trial, is there for it.
  assert((await text(page, `worker.js?v=${before}`)).includes("worker_main"));
  assert.deepEqual(wrong, []);

  const context = page.context();
  await page.close();
  await second.close();
  const third = await context.newPage();
  await third.goto(`${address}#v=1`);
  await becomes(third, await versionOf(next));
});

test("a server that has files of two builds leaves the old one standing", async (t) => {
  const mixed = join(scratch, "mixed");
  await anotherBuild(dist, mixed, "mixed", { forget: ["style.css"] });
  const folder = await served("mixed-build", dist);
  const { page } = await openApp(t, browser, { context: COARSE, folder: folder.path });
  await kept(page);
  await folder.to(mixed);
  const failed = await page.evaluate(async () => {
    const registration = await navigator.serviceWorker.getRegistration();
    await registration.update().catch(() => {});
    const { installing } = registration;
    if (installing && installing.state !== "redundant") {
      await new Promise((done) => installing.addEventListener("statechange", () => installing.state === "redundant" && done()));
    }
    return registration.waiting === null;
  });
  assert(failed, "it is not taken in");
  await page.reload();
  assert.equal(await versions(page), await versionOf(dist));
  assert.equal((await caches(page)).length, 1);
});
