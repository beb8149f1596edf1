/** A WebAssembly module, from the answer of a server; and in words why there is none. */

/** The smallest module that there is. */
const EMPTY = Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0);

/** The module came, and is not the one that its page was made for. */
class Misfit extends Error {}

/**
 * Compiles a module while it arrives. `wanted` are functions that it must have: a file that some cache has kept from
 * another version is refused here, before the generated script takes it for its own and keeps it for good.
 */
export async function compile(answer: Promise<Response>, wanted: readonly string[]): Promise<WebAssembly.Module> {
  const response = await answer;
  if (!response.ok) throw new Error(`${response.status} for ${response.url}`);
  const typed = response.headers.get("Content-Type")?.startsWith("application/wasm");
  // Servers that know no WebAssembly send it as any file; that compiles in one piece.
  const module =
    typed && "compileStreaming" in WebAssembly
      ? await WebAssembly.compileStreaming(response)
      : await WebAssembly.compile(await response.arrayBuffer());
  const has = new Set(WebAssembly.Module.exports(module).map(({ name }) => name));
  const missing = wanted.filter((name) => !has.has(name));
  if (missing.length > 0) throw new Misfit(`${response.url} has no ${missing.join(", ")}`);
  return module;
}

/** Whether browser and page allow WebAssembly at all. */
function isAllowed(): boolean {
  try {
    return new WebAssembly.Module(EMPTY) instanceof WebAssembly.Module;
  } catch {
    return false;
  }
}

/** Why `what` is not there, a sentence without its end: what a reader can do something about is told apart. */
export function whyMissing(problem: unknown, what: string): string {
  if (!isAllowed()) return `${what} needs WebAssembly, which this browser or this page does not allow`;
  if (problem instanceof Misfit || problem instanceof WebAssembly.LinkError) {
    return `${what} is of another version than this page; loading the page anew may help`;
  }
  return `${what} could not be loaded`;
}
