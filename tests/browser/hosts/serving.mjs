// Folders as a course's own server sends them, and servers that hosts bring along.

import { createServer } from "node:http";
import { readFile, stat } from "node:fs/promises";
import { extname, join, normalize } from "node:path";

const TYPES = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".mjs": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".json": "application/json",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
};

/** Serves a folder under some path; a folder in it answers with its index.html. */
export async function fileServer(folder, under = "/") {
  const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url, "http://localhost");
    const inside = decodeURIComponent(pathname).slice(under.length - 1);
    let path = normalize(join(folder, inside));
    try {
      if (!pathname.startsWith(under) || !path.startsWith(normalize(folder))) throw new Error("outside");
      if ((await stat(path)).isDirectory()) path = join(path, "index.html");
      const body = await readFile(path);
      response.writeHead(200, { "Content-Type": TYPES[extname(path)] ?? "application/octet-stream" });
      response.end(body);
    } catch {
      response.writeHead(pathname === "/favicon.ico" ? 204 : 404);
      response.end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return {
    origin: `http://127.0.0.1:${server.address().port}`,
    close: () => {
      // The browser may have opened a connection that it has not used yet, which would never end.
      server.closeAllConnections();
      return new Promise((resolve) => server.close(resolve));
    },
  };
}

/** Some servers tell their address before they listen there. */
async function answering(origin) {
  for (;;) {
    const answer = await fetch(origin).catch(() => undefined);
    if (answer) return;
    await new Promise((resolve) => setTimeout(resolve, 200));
  }
}

const running = new Set();

/** Ends the servers that a test has left behind. */
export function endServers() {
  for (const child of running) child.kill();
}

/** Waits until a server says its address, which `pattern` captures. */
export function started(child, pattern, patience = 90_000) {
  let said = "";
  running.add(child);
  child.once("exit", () => running.delete(child));
  return new Promise((resolve, reject) => {
    const fail = (why) => {
      child.kill();
      reject(new Error(`${why}:\n${said}`));
    };
    const late = setTimeout(() => fail("the server does not start"), patience);
    const listen = (text) => {
      said += text;
      const found = pattern.exec(said);
      if (!found) return;
      child.stdout.off("data", listen).resume();
      child.stderr.off("data", listen).resume();
      const { origin } = new URL(found[1]);
      const close = () => new Promise((done) => (child.exitCode === null ? (child.once("exit", done), child.kill()) : done()));
      void answering(origin).then(() => {
        clearTimeout(late);
        resolve({ origin, close });
      });
    };
    child.stdout.on("data", listen);
    child.stderr.on("data", listen);
    child.once("exit", () => fail("the server has ended"));
  });
}
