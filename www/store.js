// The one surface that the user has asked to keep, in this browser's IndexedDB (web/src/store.rs calls these). Nothing is
// kept here by itself.

// Another Lumen may be served under another path of this origin.
const NAME = `lumen ${new URL("./", import.meta.url).pathname}`;
const SURFACE = "surface";

const done = (request) =>
  new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });

/** Does something in a transaction of its own, and waits until the disk has it. */
async function within(mode, work) {
  const opening = indexedDB.open(NAME, 1);
  opening.onupgradeneeded = () => opening.result.createObjectStore(SURFACE);
  const database = await done(opening);
  try {
    const transaction = database.transaction(SURFACE, mode);
    const whole = new Promise((resolve, reject) => {
      transaction.oncomplete = resolve;
      transaction.onabort = () => reject(transaction.error);
    });
    // Where the work itself fails, nobody waits for the rest.
    whole.catch(() => {});
    const result = await done(work(transaction.objectStore(SURFACE)));
    await whole;
    return result;
  } finally {
    database.close();
  }
}

const forget = () => within("readwrite", (store) => store.delete(SURFACE));

/** The one before goes first: it must not come back where there is no room for this one. */
async function keep(name, bytes) {
  await forget();
  return within("readwrite", (store) => store.put([name, bytes], SURFACE));
}

let last = Promise.resolve();
/** Does one after another, in the order in which they are asked for. */
const inTurn = (work) => (last = last.then(work, work));

globalThis.lumenStore = {
  /** Keeps a surface (a name and a Uint8Array) in place of the one before; where that fails, none is kept. */
  keep: (name, bytes) => inTurn(() => keep(name, bytes)),
  /** The name and the bytes of the surface that is kept, or undefined. */
  restore: () => inTurn(() => within("readonly", (store) => store.get(SURFACE))),
  /** Forgets it. */
  forget: () => inTurn(forget),
};
