// The late half of the program (xtask/src/split.rs), which its first picture does without. A build that is not split, as
// Trunk's, has none.

const address = new URL(`lumen-web_late.wasm${new URL(import.meta.url).search}`, import.meta.url);

let arrive;
const arrival = new Promise((resolve) => (arrive = resolve));

/** Lets the program wait for it. */
globalThis.lumenLateArrives = () => arrival;

/** Fetches it for this program, and for the Workers that begin from now on (web/src/worker.rs). */
export async function bring(program) {
  const isSplit = WebAssembly.Module.exports(program).some(({ name }) => name === "lateIsThere");
  if (isSplit) globalThis.lumenLateModule ??= await WebAssembly.compileStreaming(fetch(address));
  arrive();
}

/** It, by a request that is waited for. */
function broughtAtOnce() {
  const request = new XMLHttpRequest();
  request.open("GET", address, false);
  // A page may wait for text alone; here each letter is a byte.
  request.overrideMimeType("text/plain; charset=x-user-defined");
  try {
    request.send();
  } catch {
    // There is no network: status 0.
  }
  if (request.status !== 200) {
    const error = new Error(`A part of Lumen could not be downloaded: ${request.status} ${request.statusText} (${address})`);
    // The program ends here, in the midst of its work (boot.js).
    error.name = "Panic";
    throw error;
  }
  return new WebAssembly.Module(Uint8Array.from(request.responseText, (letter) => letter.charCodeAt(0) & 255));
}

/** Called by the program, whose exports are `early`, in the middle of a call that comes to the late half first. */
globalThis.lumenLate = (early) => {
  globalThis.lumenLateModule ??= broughtAtOnce();
  new WebAssembly.Instance(globalThis.lumenLateModule, { early });
};
