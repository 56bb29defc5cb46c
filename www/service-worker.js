// Lumen without a network: keeps the files of one build and answers with them alone.
//
// The build writes its version and the hash of each file into the next line (xtask/src/page.rs), so that every build has
// another of these. A browser that finds a new one fills a cache for it beside that of the old build. A page gets all of
// its files from one build: the old one answers as long as a page of it is open, and the next start is the new one's.
const BUILD = { version: "", files: {} };

const { scope } = self.registration;
// Another Lumen may be served under another path of this origin.
const CACHES = `lumen ${scope} `;
const CACHE = CACHES + BUILD.version;

/** Where a file of the build is kept, whatever is asked for behind its name. */
const place = (name) => new URL(name, scope).href;

async function sha256(bytes) {
  const hash = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
  return Array.from(hash, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** A file of this build, and of no other: a server that is just being changed may have either. */
async function download(name) {
  // Some hosts have no index.html, only the folder.
  const address = new URL(name === "index.html" ? "./" : name, scope);
  address.searchParams.set("v", BUILD.version);
  // What the page has downloaded a moment ago may be at hand.
  for (const cache of ["default", "reload"]) {
    const response = await fetch(address, { cache });
    if (!response.ok) throw new Error(`${response.status} ${response.statusText} (${address})`);
    const bytes = await response.arrayBuffer();
    if ((await sha256(bytes)) !== BUILD.files[name]) continue;
    const headers = new Headers(response.headers);
    for (const length of ["Content-Encoding", "Content-Length"]) headers.delete(length);
    return new Response(bytes, { headers });
  }
  throw new Error(`${name} is that of another build`);
}

async function fill() {
  const cache = await caches.open(CACHE);
  try {
    const one = async (name) => cache.put(place(name), await download(name));
    await Promise.all(Object.keys(BUILD.files).map(one));
  } catch (error) {
    await caches.delete(CACHE);
    throw error;
  }
}

async function forgetOthers() {
  const others = (await caches.keys()).filter((name) => name.startsWith(CACHES) && name !== CACHE);
  await Promise.all(others.map((name) => caches.delete(name)));
  // The page of the first visit was there before this was.
  await self.clients.claim();
}

/** The page: of the build that waits, where this start is the first that can have it. */
async function page(request) {
  const { waiting } = self.registration;
  // One page is the one that is about to be replaced by this.
  if (waiting && (await self.clients.matchAll({ type: "window" })).length < 2) {
    waiting.postMessage("begin");
    // With an icon of its own, which the browser would ask the server for.
    const empty = '<!doctype html><link rel="icon" href="data:,">';
    return new Response(empty, { headers: { Refresh: "0", "Content-Type": "text/html" } });
  }
  return (await caches.match(place("index.html"), { cacheName: CACHE })) ?? fetch(request);
}

async function file(name, version, request) {
  if (version && version !== BUILD.version) return Response.error();
  return (await caches.match(place(name), { cacheName: CACHE })) ?? fetch(request);
}

self.addEventListener("install", (event) => event.waitUntil(fill()));
self.addEventListener("activate", (event) => event.waitUntil(forgetOthers()));
self.addEventListener("message", ({ data }) => data === "begin" && self.skipWaiting());
self.addEventListener("fetch", (event) => {
  const { request } = event;
  const url = new URL(request.url);
  if (request.method !== "GET" || !url.href.startsWith(scope)) return;
  const name = decodeURIComponent(url.pathname.slice(new URL(scope).pathname.length)) || "index.html";
  if (!Object.hasOwn(BUILD.files, name)) return;
  const isPage = request.mode === "navigate" && name === "index.html";
  event.respondWith(isPage ? page(request) : file(name, url.searchParams.get("v"), request));
});
