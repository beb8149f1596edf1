/** Storage of one value per database in IndexedDB. A database exists only once a value has been stored. */

const PLACE = "files";

function open(name: string): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const asked = indexedDB.open(name, 1);
    asked.onupgradeneeded = () => asked.result.createObjectStore(PLACE);
    asked.onsuccess = () => resolve(asked.result);
    asked.onerror = () => reject(asked.error ?? new Error("the browser keeps nothing"));
  });
}

/** Runs a transaction and closes the database, as an open one could not be erased. */
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

/** Stores a value, replacing the previous one unless that fails. Throws if storage fails. */
export async function put(name: string, value: unknown): Promise<void> {
  await within(name, "readwrite", (place) => place.put(value, PLACE));
}

/** Returns the stored value, or undefined. Throws if storage is blocked. */
export async function get(name: string): Promise<unknown> {
  // Checks first, since opening a database would create it.
  const there = await indexedDB.databases?.();
  if (there && !there.some((database) => database.name === name)) return undefined;
  const value: unknown = await within(name, "readonly", (place) => place.get(PLACE) as IDBRequest<unknown>);
  if (value === undefined) await erase(name);
  return value;
}

/** Deletes the database. Throws if that fails. */
export function erase(name: string): Promise<void> {
  return new Promise((resolve, reject) => {
    const asked = indexedDB.deleteDatabase(name);
    asked.onsuccess = () => resolve();
    asked.onerror = () => reject(asked.error ?? new Error("the browser erases nothing"));
  });
}
