// A dedicated Worker. Of the page's own program it gets the compiled module: no second download, no shared memory. Another
// program it fetches itself. The first message says which, and the Worker's job; every later one goes to the program
// (web/worker/src/serve.rs).

const waiting = [];
const hold = (event) => waiting.push(event.data);

// An allocation that fails ends the program in a trap, which says nothing; a panic tells of itself before.
function sayWhereMemoryEnds(memory) {
  let has_panicked = false;
  self.addEventListener("error", (event) => {
    has_panicked ||= event.error?.name === "Panic";
    if (has_panicked || !(event.error instanceof WebAssembly.RuntimeError)) return;
    event.preventDefault();
    const held = (memory.buffer.byteLength / 1e9).toFixed(1);
    setTimeout(() => self.reportError(new RangeError(`there is no memory left beyond its ${held} GB`)));
  });
}

// The page hands on the late half of its program as soon as it has it (boot.js). The program hears nothing of that.
self.addEventListener("message", (event) => {
  if (!(event.data instanceof WebAssembly.Module)) return;
  event.stopImmediatePropagation();
  self.lumenLateModule = event.data;
});

async function begin({ data: { module, lumenLateModule, program = "lumen-web", job } }) {
  self.addEventListener("message", hold);
  // Every file of a build bears its version.
  const at = (name) => new URL(name + self.location.search, import.meta.url);
  self.lumenLateModule ??= lumenLateModule;
  const [glue] = await Promise.all([import(at(`${program}.js`)), module && import(at("late.js"))]);
  const { memory } = module ? glue.initSync({ module }) : await glue.default({ module_or_path: at(`${program}_bg.wasm`) });
  sayWhereMemoryEnds(memory);
  glue.worker_main(job);
  // Whoever waits for the program, which the page has not fetched, hears that it is there.
  if (!module) self.postMessage(null);
  self.removeEventListener("message", hold);
  for (const data of waiting.splice(0)) self.dispatchEvent(new MessageEvent("message", { data }));
}

// What goes wrong here has to reach the page as an error event, which a rejected promise does not.
self.addEventListener("message", (event) => begin(event).catch(self.reportError), { once: true });
