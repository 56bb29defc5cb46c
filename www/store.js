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
    const result = await done(work(transaction.objectStore(SURFACE)));
    await whole;
    return result;
  } finally {
    database.close();
  }
}

globalThis.lumenStore = {
  /** Keeps a surface (a name and a Uint8Array) in place of the one before. */
  keep: (name, bytes) => within("readwrite", (store) => store.put([name, bytes], SURFACE)),
  /** The name and the bytes of the surface that is kept, or undefined. */
  restore: () => within("readonly", (store) => store.get(SURFACE)),
  /** Forgets it. */
  forget: () => within("readwrite", (store) => store.delete(SURFACE)),
};
