/** Addresses of the files that a figure loads: next to the script, or set by the page. */

/** Addresses, each absolute or relative to the page. */
export interface AssetAddresses {
  /** `epipole-figures.wasm`, which draws. */
  figures?: string | URL;
  /** `epipole-jobs.wasm`, for long computations. */
  jobs?: string | URL;
  /** `worker.js`, the worker that runs them. */
  worker?: string | URL;
}

const moved: AssetAddresses = {};

/**
 * Sets the addresses of the figures' files, for bundlers that do not resolve
 * `new URL(…, import.meta.url)`. Call it before the first figure scrolls into view.
 */
export function setAssets(addresses: AssetAddresses): void {
  Object.assign(moved, addresses);
}

/** Returns the address of a file, if the page has set one. */
export function movedTo(file: keyof AssetAddresses): URL | undefined {
  const address = moved[file];
  return address === undefined ? undefined : new URL(address, document.baseURI);
}
