/** What a reader gave, kept over one reload after the Lab has stopped, and forgotten as soon as it is there again. */

const NAME = "epipole-lab";
const PLACE = "files";

function open(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const asked = indexedDB.open(NAME, 1);
    asked.onupgradeneeded = () => asked.result.createObjectStore(PLACE);
    asked.onsuccess = () => resolve(asked.result);
    asked.onerror = () => reject(asked.error ?? new Error("the browser keeps nothing"));
  });
}

function done(transaction: IDBTransaction): Promise<void> {
  return new Promise((resolve, reject) => {
    transaction.oncomplete = () => resolve();
    transaction.onabort = transaction.onerror = () => reject(transaction.error ?? new Error("the browser keeps nothing"));
  });
}

/** Puts files aside. Throws where the browser keeps nothing. */
export async function putAside(files: readonly File[]): Promise<void> {
  const database = await open();
  const transaction = database.transaction(PLACE, "readwrite");
  transaction.objectStore(PLACE).put([...files], PLACE);
  await done(transaction);
  database.close();
}

/** Takes what was put aside, and leaves nothing behind. */
export async function takeBack(): Promise<File[]> {
  try {
    // Nobody is asked to keep anything who has nothing kept.
    const kept = await indexedDB.databases?.();
    if (kept && !kept.some(({ name }) => name === NAME)) return [];
    const database = await open();
    const transaction = database.transaction(PLACE, "readonly");
    const asked = transaction.objectStore(PLACE).get(PLACE);
    await done(transaction);
    database.close();
    indexedDB.deleteDatabase(NAME);
    return Array.isArray(asked.result) ? asked.result : [];
  } catch {
    return [];
  }
}
