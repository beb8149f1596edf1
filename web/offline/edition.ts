// Files of one edition of the book in the browser's cache.

import { inVariant, type Variant } from "./pictures";
import type { CacheRequest } from "./protocol";

/** Path of the list of files. Its hash identifies the edition. */
declare const EPIPOLE_LIST: string;

/** List of the files of the edition. */
interface List {
  /** Files that every page needs. */
  core: string[];
  /** Further files of each page; those of a group show the same in several widths and themes. */
  pages: Record<string, string[][]>;
  /** All other files. */
  rest: string[];
  /** Hashes of the files whose names contain none. */
  integrity: Record<string, string>;
}

const { scope } = (self as unknown as ServiceWorkerGlobalScope).registration;
/** Prefix of this book's caches; other books may share the origin. */
const OURS = `epipole-book ${scope} `;
const NAME = OURS + EPIPOLE_LIST;
/** Cache entry that marks a complete edition, with the variant of its pictures. */
const WHOLE = "offline-complete";
/** Number of simultaneous downloads. */
const LANES = 4;

/** Whether the name of a file contains a hash of its content. */
export const isHashed = (path: string) => /^(lab\/)?assets\//.test(path);

const open = () => caches.open(NAME);

export const addressOf = (path: string) => new URL(path, scope).href;

/** Returns the response from the cache; undefined if the path is not cached. */
export async function cached(path: string): Promise<Response | undefined> {
  return (await open()).match(addressOf(path));
}

/** Returns the same picture in the cached width and theme. */
export async function cachedAlternative(path: string): Promise<Response | undefined> {
  const groups = Object.values((await list()).pages).flat();
  const like = groups.find((paths) => paths.includes(path)) ?? [];
  const held = await Promise.all(like.map(cached));
  return held.find(Boolean);
}

export async function store(path: string, response: Response): Promise<void> {
  await (await open()).put(addressOf(path), response);
}

/** Returns the list, which is always cached first. */
async function list(): Promise<List> {
  return (await cached(EPIPOLE_LIST))!.json();
}

export async function isComplete(): Promise<boolean> {
  return (await cached(WHOLE)) !== undefined;
}

/** Returns the names of the caches with other editions. */
async function others(): Promise<string[]> {
  return (await caches.keys()).filter((name) => name.startsWith(OURS) && name !== NAME);
}

export async function forgetOthers(): Promise<void> {
  await Promise.all((await others()).map((name) => caches.delete(name)));
}

/** Returns the variant of another edition's pictures, if that edition is complete. */
export async function variantBefore(): Promise<Variant | undefined> {
  const held = await Promise.all((await others()).map((cacheName) => caches.match(addressOf(WHOLE), { cacheName })));
  return held.find(Boolean)?.json();
}

/** Downloads a file of this edition. Throws if the server has a different one. */
async function download(path: string, integrity: string | undefined): Promise<Response> {
  const response = await fetch(addressOf(path), {
    ...(integrity ? { integrity, cache: "no-cache" } : {}),
    priority: "low",
  } as RequestInit);
  if (!response.ok) throw new Error(`${response.status} for ${path}`);
  // Navigations reject a redirected response, such as from hosts that hide `.html`.
  const { status, headers } = response;
  return response.redirected ? new Response(response.body, { status, headers }) : response;
}

/** Caches one file: from an older edition if its name is the same, else from the server. */
async function add(cache: Cache, path: string, integrity: string | undefined): Promise<void> {
  const address = addressOf(path);
  if (await cache.match(address)) return;
  const old = integrity ? undefined : await caches.match(address);
  await cache.put(address, old ?? (await download(path, integrity)));
}

/**
 * Caches a page with its files, then, with `all`, every other file, with pictures of one variant. Continues where an
 * earlier attempt ended. Throws if the server or the storage fails.
 */
export async function fill({ page, all, variant }: CacheRequest): Promise<void> {
  if (await isComplete()) return;
  const cache = await open();
  await add(cache, EPIPOLE_LIST, undefined);
  const { core, pages, rest, integrity } = await list();
  const ofPage = (name: string) => [name, ...core, ...inVariant(pages[name] ?? [], variant)];
  const wanted = page !== undefined && page in pages ? ofPage(page) : [];
  if (all) wanted.push(...Object.keys(pages).flatMap(ofPage), ...rest);
  const queue = new Set(wanted).values();
  const lane = async () => {
    for (const path of queue) await add(cache, path, integrity[path]);
  };
  await Promise.all(Array.from({ length: LANES }, lane));
  if (all) await cache.put(addressOf(WHOLE), Response.json(variant));
}
