// Static test server: pages with a strict content security policy, elements for any origin.

import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname, join, normalize } from "node:path";

export const TYPES = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".mjs": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".wasm": "application/wasm",
  ".png": "image/png",
  ".webp": "image/webp",
  ".svg": "image/svg+xml",
  ".json": "application/json",
  ".webmanifest": "application/manifest+json",
};

/** Content security policy of pages with figures. */
export const POLICY =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; " +
  "img-src 'self' data: blob:; connect-src 'self'; font-src 'self'; base-uri 'none'; form-action 'none'";

/** Policy of the book, whose chapters run code in workers made from blobs. */
export const BOOK_POLICY = `${POLICY}; worker-src 'self' blob:; manifest-src 'self'`;

/**
 * Policy of the Lab: also the reader's videos, and the blob URLs that workers poll for
 * cancellation.
 */
export const LAB_POLICY = `${POLICY.replace("connect-src 'self'", "connect-src 'self' blob:")}; media-src blob:`;

/**
 * Serves folders: `mounts` maps the first part of a path to a folder, or to a function that returns
 * HTML for the rest of the address, or responds by itself and returns nothing. `policy: false`
 * serves without a policy, as third-party pages; `more` are further headers; paths that match
 * `missing` give 404.
 */
export async function serve({ mounts, policy = POLICY, more = {}, missing, port = 0 }) {
  const server = createServer(async (request, response) => {
    const url = new URL(request.url, "http://localhost");
    const [, first = "", ...rest] = url.pathname.split("/");
    const mount = mounts[first];
    const headers = { "Access-Control-Allow-Origin": "*", "Cache-Control": "no-store", ...more };
    if (policy) headers["Content-Security-Policy"] = policy;
    try {
      if (typeof mount === "function") {
        const page = await mount(url, response);
        if (page === undefined) return;
        response.writeHead(200, { ...headers, "Content-Type": TYPES[".html"] });
        response.end(page);
        return;
      }
      if (!mount || missing?.test(url.pathname)) throw new Error("no such place");
      const path = normalize(join(mount, decodeURIComponent(rest.join("/"))));
      if (!path.startsWith(normalize(mount))) throw new Error("outside");
      const body = await readFile(path);
      response.writeHead(200, { ...headers, "Content-Type": TYPES[extname(path)] ?? "text/plain" });
      response.end(body);
    } catch {
      response.writeHead(first === "favicon.ico" ? 204 : 404, headers);
      response.end();
    }
  });
  await new Promise((resolve) => server.listen(port, "127.0.0.1", resolve));
  return {
    origin: `http://127.0.0.1:${server.address().port}`,
    close: () => {
      // Some responses never end.
      server.closeAllConnections();
      return new Promise((resolve) => server.close(resolve));
    },
  };
}
