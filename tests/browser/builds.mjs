// A build beside the one that is tested, as different as the next version would be: another style, stamped as
// `xtask/src/page.rs` stamps.

import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { cp, readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";

const LINE = /^const BUILD = (\{.*\});$/m;

const sha256 = (bytes) => createHash("sha256").update(bytes).digest("hex");

/** The version that a build's page bears. */
export async function versionOf(folder) {
  const page = await readFile(join(folder, "index.html"), "utf8");
  const version = page.match(/name="lumen-version" content="([0-9a-f]{16})"/)?.[1];
  assert(version, `${folder} is no finished build`);
  return version;
}

/** Makes `to` a build like `from` with a `word` in its style. The files to `forget` are left as they were. */
export async function anotherBuild(from, to, word, { forget = [] } = {}) {
  await cp(from, to, { recursive: true });
  const old = await versionOf(from);
  const version = sha256(old + word).slice(0, 16);
  const style = `${await readFile(join(from, "style.css"), "utf8")}\n/* ${word} */\n`;
  const page = (await readFile(join(from, "index.html"), "utf8")).replaceAll(old, version);
  const worker = await readFile(join(from, "service-worker.js"), "utf8");
  const build = JSON.parse(worker.match(LINE)?.[1] ?? "null");
  assert.equal(build?.version, old, "the service worker is of the page's build");
  build.version = version;
  for (const [name, text] of [["style.css", style], ["index.html", page]]) {
    build.files[name] = sha256(text);
    if (!forget.includes(name)) await writeFile(join(to, name), text);
  }
  await writeFile(join(to, "service-worker.js"), worker.replace(LINE, () => `const BUILD = ${JSON.stringify(build)};`));
}
