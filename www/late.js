// The late half of the program (xtask/src/split.rs), which its first picture does without. A build that is not split, as
// Trunk's, has none.

const address = new URL(`lumen-web_late.wasm${new URL(import.meta.url).search}`, import.meta.url);

let arrival;
let answer;
const awaitIt = () => {
  arrival = new Promise((there, failed) => (answer = { there, failed }));
  // Nobody may wait for it.
  arrival.catch(() => {});
};
awaitIt();

/** Lets the program wait for it, or for the failure of this attempt. */
globalThis.lumenLateArrives = () => arrival;

async function compiled() {
  const response = await fetch(address);
  if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
  // Whatever a server takes it for.
  return WebAssembly.compileStreaming(new Response(response.body, { headers: { "Content-Type": "application/wasm" } }));
}

/** Fetches it for this program, and for the Workers that begin from now on (web/src/worker.rs). */
export async function bring(program) {
  const isSplit = WebAssembly.Module.exports(program).some(({ name }) => name.startsWith("lateIsThere"));
  try {
    if (isSplit) globalThis.lumenLateModule ??= await compiled();
    answer.there();
  } catch (error) {
    answer.failed(error);
    awaitIt();
    throw error;
  }
}

/** The program ends here, in the midst of its work (boot.js). */
function ends(sentence) {
  const error = new Error(sentence);
  error.name = "Panic";
  return error;
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
    throw ends(`A part of Lumen could not be downloaded: ${request.status} ${request.statusText} (${address})`);
  }
  return new WebAssembly.Module(Uint8Array.from(request.responseText, (letter) => letter.charCodeAt(0) & 255));
}

/** Called by the program, whose exports are `early`, in the middle of a call that comes to the late half first. */
globalThis.lumenLate = (early) => {
  globalThis.lumenLateModule ??= broughtAtOnce();
  try {
    new WebAssembly.Instance(globalThis.lumenLateModule, { early });
  } catch (error) {
    throw error instanceof WebAssembly.LinkError ? ends("The server has another build of Lumen by now: load the page again.") : error;
  }
};
