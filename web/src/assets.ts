/** Where the files are that a figure loads: beside the script, or where a page has put them. */

/** Addresses, each absolute or relative to the page. */
export interface AssetAddresses {
  /** `epipole-figures.wasm`, which draws. */
  figures?: string | URL;
  /** `epipole-jobs.wasm`, for long computations. */
  jobs?: string | URL;
  /** `worker.js`, in which they run. */
  worker?: string | URL;
}

const moved: AssetAddresses = {};

/**
 * Tells where the files of the figures are, for bundlers that do not find `new URL(…, import.meta.url)` by
 * themselves. Call it before the first figure comes into sight.
 */
export function setAssets(addresses: AssetAddresses): void {
  Object.assign(moved, addresses);
}

/** Where a file has been put, if a page has said so. */
export function movedTo(file: keyof AssetAddresses): URL | undefined {
  const address = moved[file];
  return address === undefined ? undefined : new URL(address, document.baseURI);
}
