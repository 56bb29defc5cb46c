// Lumen without a network: keeps the files of one build and answers with them alone.
//
// The build writes its version and the hash of each file into the next line (xtask/src/page.rs), so that every build has
// another of these. A browser that finds a new one fills a cache for it beside that of the old build. A page gets all of
// its files from one build: the old one answers as long as a page of it is open. A page that starts asks the new one to
// begin (www/boot.js), before it has loaded anything; it does where there is no other page.
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
  // Then a page may live on it.
  const wasThere = await caches.has(CACHE);
  const cache = await caches.open(CACHE);
  try {
    const one = async (name) => cache.put(place(name), await download(name));
    await Promise.all(Object.keys(BUILD.files).map(one));
  } catch (error) {
    if (!wasThere) await caches.delete(CACHE);
    throw error;
  }
}

async function forgetOthers() {
  const others = (await caches.keys()).filter((name) => name.startsWith(CACHES) && name !== CACHE);
  await Promise.all(others.map((name) => caches.delete(name)));
  // The page of the first visit was there before this was.
  await self.clients.claim();
}

/** Begins where the page that asks, which has loaded nothing yet, is the only one; says to it whether it is. */
async function begin(asking) {
  // A page that was loaded past every worker would become this one's too.
  const pages = await self.clients.matchAll({ type: "window", includeUncontrolled: true });
  const isAlone = pages.filter(({ url }) => url.startsWith(scope)).length === 1;
  asking?.postMessage(isAlone);
  if (isAlone) await self.skipWaiting();
}

async function file(name, version, request) {
  if (version && version !== BUILD.version) return Response.error();
  return (await caches.match(place(name), { cacheName: CACHE })) ?? fetch(request);
}

self.addEventListener("install", (event) => event.waitUntil(fill()));
self.addEventListener("activate", (event) => event.waitUntil(forgetOthers()));
self.addEventListener("message", (event) => event.data === "begin" && event.waitUntil(begin(event.ports[0])));
self.addEventListener("fetch", (event) => {
  const { request } = event;
  const url = new URL(request.url);
  if (request.method !== "GET" || !url.href.startsWith(scope)) return;
  const name = decodeURIComponent(url.pathname.slice(new URL(scope).pathname.length)) || "index.html";
  if (!Object.hasOwn(BUILD.files, name)) return;
  // What stands behind the page's own name is not for this.
  const version = name === "index.html" ? null : url.searchParams.get("v");
  event.respondWith(file(name, version, request));
});
