// A scan never leaves the machine: once the app is loaded, no request leaves the page.

import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { REDUCTION, loaded, openFile, save, settled } from "./app.mjs";
import { COARSE, data, dragTo, launch, openApp } from "./browser.mjs";

const AORTA = join(data, "real/aorta-surface-segment-2.stl");

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

test("no request leaves the page after it is loaded", { skip: existsSync(AORTA) ? false : `${AORTA} is not there` }, async (t) => {
  let isLoaded = false;
  const requests = { loading: [], later: [] };
  const listen = (page) =>
    // The context hears its Workers too.
    page.context().on("request", (request) => (isLoaded ? requests.later : requests.loading).push(request.url()));
  const { page, address } = await openApp(t, browser, { context: COARSE, before: listen });
  await loaded(page);
  isLoaded = true;

  await openFile(page, AORTA);
  await settled(page);
  await dragTo(page, REDUCTION, 75);
  await dragTo(page, "Iterations", 20);
  await settled(page);
  for (const format of ["STL", "PLY", "OBJ", "GLB"]) await save(page, format);
  await openFile(page, { name: "broken.stl", buffer: Buffer.from("solid nothing") });
  await settled(page);

  // A download is handed over within the browser, under an address of the page itself.
  const left = requests.later.filter((url) => !url.startsWith("blob:") && !url.startsWith("data:"));
  assert.deepEqual(left, []);
  assert(requests.loading.length >= 5, "the test hears requests");
  assert(requests.loading.every((url) => url.startsWith(address)), requests.loading.join("\n"));
});
