// A dedicated Worker with its own instance of the module the page has compiled: no second download, no shared memory.
// The first message brings the module and the Worker's job; every later one goes to the program (web/src/job.rs).

const waiting = [];
const hold = (event) => waiting.push(event.data);

async function begin({ data }) {
  self.addEventListener("message", hold);
  const { initSync, worker_main } = await import("./lumen-web.js" + self.location.search);
  initSync({ module: data.module });
  worker_main(data.job);
  self.removeEventListener("message", hold);
  for (const data of waiting.splice(0)) self.dispatchEvent(new MessageEvent("message", { data }));
}

// What goes wrong here has to reach the page as an error event, which a rejected promise does not.
self.addEventListener("message", (event) => begin(event).catch(self.reportError), { once: true });
