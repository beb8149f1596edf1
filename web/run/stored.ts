/** Code of the reader: stored in this browser, and packed into links. */

import { packed, unpacked } from "./packing.js";

const PREFIX = "epipole-code:";

/** Returns the storage key of a block's code on this page. */
export function keyOf(name: string): string {
  const page = location.pathname.replace(/.*\//, "").replace(/\.html$/, "") || "index";
  return `${PREFIX}${page}#${name}`;
}

/** Returns the reader's code, if it differs from the book's. */
export function load(key: string): string | undefined {
  try {
    return localStorage.getItem(key) ?? undefined;
  } catch {
    return undefined;
  }
}

/** Stores code, or erases it. Returns false if storage is blocked or full. */
export function save(key: string, code: string | undefined): boolean {
  try {
    if (code === undefined) localStorage.removeItem(key);
    else localStorage.setItem(key, code);
    return true;
  } catch {
    return false;
  }
}

/** Returns the address of this page with code for a block, as `#run=name&code=…`. */
export async function linkTo(name: string, code: string): Promise<string> {
  const address = new URL(location.href);
  address.hash = new URLSearchParams({ run: name, code: await packed(code) }).toString();
  return address.href;
}

/** Returns block and code of an address. */
export async function linked(hash: string): Promise<{ name: string; code: string } | undefined> {
  const parameters = new URLSearchParams(hash.replace(/^#/, ""));
  const [name, code] = [parameters.get("run"), parameters.get("code")];
  if (name === null || code === null) return undefined;
  return { name, code: await unpacked(code) };
}
