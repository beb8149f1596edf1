/** One value each under a name, in the storage of the browser: there is nothing under a name that nobody has put there. */

const PLACE = "files";

function open(name: string): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const asked = indexedDB.open(name, 1);
    asked.onupgradeneeded = () => asked.result.createObjectStore(PLACE);
    asked.onsuccess = () => resolve(asked.result);
    asked.onerror = () => reject(asked.error ?? new Error("the browser keeps nothing"));
  });
}

/** Carries out something in a database, which is closed in any case: one that is open cannot be erased. */
async function within<T>(name: string, mode: IDBTransactionMode, ask: (place: IDBObjectStore) => IDBRequest<T>): Promise<T> {
  const database = await open(name);
  try {
    const transaction = database.transaction(PLACE, mode);
    const asked = ask(transaction.objectStore(PLACE));
    await new Promise<void>((resolve, reject) => {
      transaction.oncomplete = () => resolve();
      transaction.onabort = transaction.onerror = () =>
        reject(transaction.error ?? asked.error ?? new Error("the browser keeps nothing"));
    });
    return asked.result;
  } finally {
    database.close();
  }
}

/** Puts a value there in place of the one before, which stays where that fails. Throws where the browser keeps nothing. */
export async function put(name: string, value: unknown): Promise<void> {
  await within(name, "readwrite", (place) => place.put(value, PLACE));
}

/** What is there, or nothing. Throws where the browser lets nobody look. */
export async function get(name: string): Promise<unknown> {
  // Nobody is asked to keep anything who has nothing kept.
  const there = await indexedDB.databases?.();
  if (there && !there.some((database) => database.name === name)) return undefined;
  const value: unknown = await within(name, "readonly", (place) => place.get(PLACE) as IDBRequest<unknown>);
  if (value === undefined) await erase(name);
  return value;
}

/** Leaves nothing behind. Throws where that is not granted. */
export function erase(name: string): Promise<void> {
  return new Promise((resolve, reject) => {
    const asked = indexedDB.deleteDatabase(name);
    asked.onsuccess = () => resolve();
    asked.onerror = () => reject(asked.error ?? new Error("the browser erases nothing"));
  });
}
