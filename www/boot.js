// Loads the program: says what the browser lacks, downloads the module with its progress shown, starts it, and shows
// the screen with the details when it stops. The program itself only sets data-state on <html> (web/src/page.rs).

const root = document.documentElement;
const query = import.meta.url.includes("?") ? import.meta.url.slice(import.meta.url.indexOf("?")) : "";
const at = (name) => new URL(name + query, import.meta.url).href;

// (module (func (result v128) i32.const 0 i8x16.splat)): valid only where there is WebAssembly SIMD.
const SIMD_MODULE = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 15, 11,
]);

/** What the result is saved as when the program has stopped, as in web/src/worker.rs. */
const RESULT = "lumen-result.stl";
/** How long the engine may take to answer then. */
const PATIENCE_MS = 10_000;
/** After how long what could not be downloaded is asked for again. */
const RETRY_MS = 3_000;

/** What browsers ask for by themselves, as soon as the page says where it is and at a moment of their own. */
const BY_THEMSELVES = [
  ["icon", "icon.svg"],
  ["manifest", "manifest.webmanifest"],
];

/** What the browser lacks, as a sentence, or null. */
async function missing() {
  if (typeof WebAssembly !== "object" || !WebAssembly.validate(SIMD_MODULE)) {
    return "Lumen needs WebAssembly with SIMD, which this browser does not have or has switched off.";
  }
  if (document.createElement("canvas").getContext("webgl2")) return null;
  if (await navigator.gpu?.requestAdapter().catch(() => null)) return null;
  return "Lumen needs WebGL2 or WebGPU to draw, and this browser has neither. Hardware acceleration may be switched off in its settings.";
}

function showUnsupported(sentence) {
  document.getElementById("unsupported-text").textContent = sentence;
  root.dataset.state = "unsupported";
}

/** The first failure is the cause; the ones that follow from it are left out. */
function showFailed(details) {
  if (root.dataset.state === "failed" || root.dataset.state === "unsupported") return;
  document.getElementById("failed-details").textContent = `${details}\n\n${navigator.userAgent}`;
  document.getElementById("failed-save").hidden = !globalThis.lumenEngine;
  root.dataset.state = "failed";
  document.getElementById("failed-reload").focus();
}

/**
 * What the engine's Worker, which outlives the page's program, has as the newest level: an STL file, or null; undefined
 * where it says nothing.
 */
function rescued() {
  const engine = globalThis.lumenEngine;
  return new Promise((resolve) => {
    setTimeout(resolve, PATIENCE_MS);
    engine.onerror = () => resolve(null);
    engine.onmessage = ({ data }) => {
      // The answer alone names the file; where there is one, its bytes stand beside.
      if (new TextDecoder().decode(data[0]).includes(RESULT)) resolve(data[1] ?? null);
    };
    // As web/src/worker.rs has made it.
    engine.postMessage(engine.save);
  });
}

async function saveResult() {
  const said = document.getElementById("failed-copied");
  const bytes = await rescued();
  if (bytes === undefined) {
    said.textContent = "The computation is still at work and has not answered: try again in a moment.";
    return;
  }
  if (bytes === null) {
    said.textContent = "There is no result to be had: the computation has ended too, or had none yet.";
    return;
  }
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([bytes], { type: "application/octet-stream" }));
  link.download = RESULT;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  said.textContent = `The newest result was saved as ${RESULT}.`;
}

function showProgress(bytes, total) {
  const bar = document.getElementById("loading-bar");
  const mb = (n) => (n / 1e6).toFixed(1);
  let text = `${mb(bytes)} MB`;
  if (total > 0) {
    const fraction = Math.min(bytes / total, 1);
    bar.value = fraction;
    text = `${mb(bytes)} of ${mb(total)} MB, ${Math.floor(fraction * 100)} %`;
  }
  document.getElementById("loading-text").textContent = text;
}

/** Downloads and compiles at the same time; `total` is the module's size before any compression on the way. */
async function fetchModule(url, total) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${response.status} ${response.statusText} (${url})`);
  let bytes = 0;
  showProgress(0, total);
  const counted = response.body.pipeThrough(
    new TransformStream({
      transform(chunk, controller) {
        bytes += chunk.byteLength;
        showProgress(bytes, total);
        controller.enqueue(chunk);
      },
    }),
  );
  const headers = { "Content-Type": "application/wasm" };
  return WebAssembly.compileStreaming(new Response(counted, { headers }));
}

/**
 * A browser that emulates another screen can report the device pixels of the real one. What draws would then be too
 * large for its canvas; without the report it computes the size itself.
 */
async function checkPixels(canvas) {
  if (!("devicePixelContentBoxSize" in ResizeObserverEntry.prototype)) return;
  const entry = await new Promise((resolve) => {
    const observer = new ResizeObserver(([entry]) => {
      observer.disconnect();
      resolve(entry);
    });
    observer.observe(canvas, { box: "device-pixel-content-box" });
  });
  const expected = entry.contentBoxSize[0].inlineSize * devicePixelRatio;
  if (Math.abs(entry.devicePixelContentBoxSize[0].inlineSize - expected) > 1) {
    delete ResizeObserverEntry.prototype.devicePixelContentBoxSize;
  }
}

/**
 * egui's shader asks at each pixel whether it is to filter textures by hand, which it never is here. Where the processor draws
 * (SwiftShader, llvmpipe) both ways are taken at each pixel, and a frame takes more than twice as long: so the question is
 * answered beforehand. What is not found stays as it is. (egui-wgpu 0.37 gives no way to another shader.)
 */
function lightenShaders() {
  const FILTERED = /(uint (\w+) = \w+\.predictable_texture_filtering;\s*if \()\(\2 == 0u\)\)/;
  const { prototype } = globalThis.WebGL2RenderingContext ?? {};
  const plain = prototype?.shaderSource;
  if (!plain) return;
  prototype.shaderSource = function (shader, source) {
    plain.call(this, shader, source.replace(FILTERED, "$1true)"));
  };
}

/** Lets a newer build begin where one waits and this page is the only one; says whether the page starts again with it. */
async function givesWay() {
  // Where the browser keeps nothing, nothing waits.
  const registration = await navigator.serviceWorker?.getRegistration().catch(() => null);
  if (!query || !registration?.waiting) return false;
  // The old worker is given up at once only where nothing more is asked of it.
  if (document.readyState !== "complete") await new Promise((resolve) => addEventListener("load", resolve, { once: true }));
  const changed = new Promise((resolve) => {
    navigator.serviceWorker.addEventListener("controllerchange", () => resolve(true), { once: true });
  });
  const { port1, port2 } = new MessageChannel();
  const answer = new Promise((resolve) => {
    port1.onmessage = ({ data }) => resolve(data);
  });
  registration.waiting.postMessage("begin", [port2]);
  if (!(await Promise.race([answer, changed]))) return false;
  await changed;
  location.reload();
  return true;
}

/** Fetches the late half of the program, for the page and its Workers. */
async function bring(late, module) {
  try {
    await late.bring(module);
  } catch (error) {
    console.warn(`The rest of Lumen could not be downloaded yet: ${error.message}`);
    setTimeout(bring, RETRY_MS, late, module);
  }
  if (globalThis.lumenLateModule) globalThis.lumenEngine?.postMessage(lumenLateModule);
}

function firstPicture() {
  return new Promise((resolve) => {
    const observer = new MutationObserver(() => {
      if (root.dataset.state !== "ready") return;
      observer.disconnect();
      resolve();
    });
    observer.observe(root, { attributeFilter: ["data-state"] });
  });
}

async function start() {
  if (await givesWay()) return;
  for (const [what, name] of BY_THEMSELVES) document.querySelector(`link[rel="${what}"]`).href = name;
  const sentence = await missing();
  if (sentence) return showUnsupported(sentence);

  const total = Number(document.querySelector('meta[name="lumen-module-bytes"]')?.content ?? 0);
  let glue, module, late;
  try {
    [glue, module, late] = await Promise.all([
      import(at("lumen-web.js")),
      fetchModule(at("lumen-web_bg.wasm"), total),
      import(at("late.js")),
      import(at("store.js")),
      import(at("drop.js")),
      import(at("video.js")),
    ]);
  } catch (error) {
    return showFailed(`The program could not be downloaded: ${error.message}`);
  }
  document.getElementById("loading-text").textContent = "Starting";
  await checkPixels(document.getElementById("lumen"));
  lightenShaders();
  // What is kept here costs no download, and asking a server for it in the middle of a call would fail without a network.
  const isKept = navigator.serviceWorker?.controller;
  if (isKept) await bring(late, module);
  const first = firstPicture();
  await glue.default({ module_or_path: module });
  keepBuild();
  if (isKept) return;
  await first;
  await bring(late, module);
}

/**
 * From the next start on there need be no network. A build that bears no version (Trunk's) is not kept, nor is one that is
 * a part of another page.
 */
async function keepBuild() {
  if (!query || !navigator.serviceWorker || new URLSearchParams(location.search).has("embed")) return;
  try {
    await navigator.serviceWorker.register(new URL("service-worker.js", import.meta.url), { updateViaCache: "none" });
  } catch (error) {
    console.warn(`Lumen will need a network at the next start: ${error.message}`);
  }
}

async function copyDetails() {
  const details = document.getElementById("failed-details");
  let said = "Copied.";
  try {
    await navigator.clipboard.writeText(details.textContent);
  } catch {
    getSelection().selectAllChildren(details);
    said = "The browser does not allow it here: the text is selected, copy it with Ctrl+C.";
  }
  document.getElementById("failed-copied").textContent = said;
}

document.getElementById("failed-reload").addEventListener("click", () => location.reload());
document.getElementById("failed-copy").addEventListener("click", copyDetails);
document.getElementById("failed-save").addEventListener("click", saveResult);

// The program reports a panic as an error of that name, and ends in a trap. Any other exception that has passed through
// it leaves it standing still: what it had in hand is never put down. Errors beside it do not end it.
const ends = (error) =>
  error?.name === "Panic" || error instanceof WebAssembly.RuntimeError || /\.wasm\b|wasm-function/.test(error?.stack ?? "");
addEventListener("error", ({ error, message }) => {
  if (ends(error)) showFailed(error.stack ?? message);
});
addEventListener("unhandledrejection", ({ reason }) => {
  if (ends(reason)) showFailed(reason.stack ?? String(reason));
});

// A drop beside the canvas must not make the browser leave the page for the file.
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => event.preventDefault());

start().catch((error) => showFailed(error?.stack ?? String(error)));
