// The late half of the program (xtask/src/split.rs): fetched after the first picture, or when it is first called. A build that is
// not split, as Trunk's, has none.

const address = new URL(`lumen-web_late.wasm${new URL(import.meta.url).search}`, import.meta.url);

/** Puts it into its place in the program whose exports are `early`. */
export function join(early, late) {
  if (!early.lateIsThere.value) new WebAssembly.Instance(late, { early });
}

/** The compiled half; null where the program is whole. */
export async function fetched(early) {
  return "lateIsThere" in early ? WebAssembly.compileStreaming(fetch(address, { priority: "low" })) : null;
}

/** Called by the program in the middle of a call, which cannot wait. */
globalThis.lumenLate = (early) => {
  const request = new XMLHttpRequest();
  request.open("GET", address, false);
  // A page may wait for text alone; here each letter is a byte.
  request.overrideMimeType("text/plain; charset=x-user-defined");
  request.send();
  if (request.status !== 200) throw new Error(`${request.status} ${request.statusText} (${address})`);
  join(early, new WebAssembly.Module(Uint8Array.from(request.responseText, (letter) => letter.charCodeAt(0) & 255)));
};
