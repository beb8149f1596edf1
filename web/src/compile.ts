/** Compiles a WebAssembly module from a response, and explains failures. */

/** The smallest valid module. */
const EMPTY = Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0);

/** Error for a module of another version. */
class Misfit extends Error {}

/**
 * Compiles a module while it downloads. `wanted` lists its required exports: a stale cached file is
 * rejected here, before the generated script initializes it (which cannot be undone).
 */
export async function compile(answer: Promise<Response>, wanted: readonly string[]): Promise<WebAssembly.Module> {
  const response = await answer;
  if (!response.ok) throw new Error(`${response.status} for ${response.url}`);
  const typed = response.headers.get("Content-Type")?.startsWith("application/wasm");
  // Some servers lack the MIME type for WebAssembly; their responses are compiled in one piece.
  const module =
    typed && "compileStreaming" in WebAssembly
      ? await WebAssembly.compileStreaming(response)
      : await WebAssembly.compile(await response.arrayBuffer());
  const has = new Set(WebAssembly.Module.exports(module).map(({ name }) => name));
  const missing = wanted.filter((name) => !has.has(name));
  if (missing.length > 0) throw new Misfit(`${response.url} has no ${missing.join(", ")}`);
  return module;
}

/** Whether browser and page allow WebAssembly. */
function isAllowed(): boolean {
  try {
    return new WebAssembly.Module(EMPTY) instanceof WebAssembly.Module;
  } catch {
    return false;
  }
}

/** Returns the reason why `what` is missing, without final period; distinguishes causes that the reader can fix. */
export function whyMissing(problem: unknown, what: string): string {
  if (!isAllowed()) return `${what} needs WebAssembly, which this browser or this page does not allow`;
  if (problem instanceof Misfit || problem instanceof WebAssembly.LinkError) {
    return `${what} is of another version than this page; loading the page anew may help`;
  }
  return `${what} could not be loaded`;
}
