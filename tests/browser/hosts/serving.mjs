// Static servers of a course, and servers that hosts bring along.

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

/** Serves a folder under a path, with index.html for folders. */
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
      // Connections opened in advance by the browser would never end.
      server.closeAllConnections();
      return new Promise((resolve) => server.close(resolve));
    },
  };
}

/** Time for a server to end by itself when asked, milliseconds. */
const GRACE_MS = 10_000;

/**
 * Waits until a server answers, as some print their address before they listen; gives up if it has
 * ended.
 */
async function answering(origin, isOver) {
  while (!isOver()) {
    const answer = await fetch(origin, { signal: AbortSignal.timeout(GRACE_MS) }).catch(() => undefined);
    if (answer) return;
    await new Promise((resolve) => setTimeout(resolve, 200));
  }
}

/** A free port, for servers that do not choose one themselves. */
export async function freePort() {
  const server = createServer();
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const { port } = server.address();
  await new Promise((resolve) => server.close(resolve));
  return port;
}

const running = new Set();

/** Ends a server; kills it after `GRACE_MS`. */
function end(child) {
  // A process ended by a signal has no exit code.
  if (child.exitCode !== null || child.signalCode !== null) return Promise.resolve();
  return new Promise((resolve) => {
    const late = setTimeout(() => child.kill("SIGKILL"), GRACE_MS);
    child.once("exit", () => {
      clearTimeout(late);
      resolve();
    });
    child.kill();
  });
}

/** Ends the servers that a test has left running. */
export async function endServers() {
  await Promise.all([...running].map(end));
}

/** Waits until a server prints its address, captured by `pattern`. */
export function started(child, pattern, patience = 90_000) {
  let said = "";
  running.add(child);
  child.once("exit", () => running.delete(child));
  return new Promise((resolve, reject) => {
    let isOver = false;
    const fail = (why) => {
      isOver = true;
      clearTimeout(late);
      void end(child);
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
      void answering(origin, () => isOver).then(() => {
        clearTimeout(late);
        resolve({ origin, close: () => end(child) });
      });
    };
    child.stdout.on("data", listen);
    child.stderr.on("data", listen);
    child.once("error", (problem) => fail(`the server cannot be started: ${problem.message}`));
    child.once("exit", () => fail("the server has ended"));
  });
}
