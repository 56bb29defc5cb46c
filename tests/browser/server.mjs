// A static server for the built dist/, under a path of its own: whatever works here works below any path of any host.

import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname, join, normalize, sep } from "node:path";

/**
 * The page's own policy, as a header: hosts are told to send it (xtask/src/package/headers.rs), and Workers have no other. It
 * forbids them more than the plainest host does, and nothing else differs.
 */
async function policy(folder) {
  const page = await readFile(join(folder, "index.html"), "utf8");
  return page.match(/http-equiv="Content-Security-Policy" content="([^"]+)"/)[1];
}

/** The path dist/ is served under. */
export const PREFIX = "/some/where/lumen/";

const MEDIA_TYPES = {
  ".css": "text/css",
  ".html": "text/html",
  ".js": "text/javascript",
  ".png": "image/png",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
  ".webmanifest": "application/manifest+json",
};

/**
 * Serves `folder` on a free port of this machine. `slow` is the number of bytes per millisecond a module is sent with
 * (0: as fast as it goes), so that a download lasts long enough to be looked at. `headers` go with every answer, and
 * `files` has what is served beside the folder: { name: { type, body } }, where the body may be a promise. The result has the
 * addresses that were asked for, without the prefix, in their order.
 */
export async function serve(folder, { slow = 0, headers = {}, files = {} } = {}) {
  const asked = [];
  const told = { "Content-Security-Policy": await policy(folder), "Cache-Control": "no-store", ...headers };
  const server = createServer(async (request, response) => {
    const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
    const name = normalize(path.slice(PREFIX.length) || "index.html");
    if (!path.startsWith(PREFIX) || name.startsWith("..") || name.startsWith(sep)) {
      response.writeHead(404).end();
      return;
    }
    asked.push(request.url.slice(PREFIX.length));
    try {
      const body = (await files[name]?.body) ?? (await readFile(join(folder, name)));
      const type = files[name]?.type ?? MEDIA_TYPES[extname(name)] ?? "application/octet-stream";
      // No length, no caching, no compression.
      response.writeHead(200, { "Content-Type": type, ...told });
      if (slow > 0 && type === "application/wasm") await trickle(response, body, slow);
      else response.end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
  return {
    asked,
    address: `http://127.0.0.1:${server.address().port}${PREFIX}`,
    close: () => new Promise((closed) => (server.closeAllConnections(), server.close(closed))),
  };
}

async function trickle(response, body, bytesPerMillisecond) {
  const slice = bytesPerMillisecond * 20;
  for (let at = 0; at < body.length && !response.destroyed; at += slice) {
    response.write(body.subarray(at, at + slice));
    await new Promise((later) => setTimeout(later, 20));
  }
  response.end();
}
