/**
 * Text as part of an address: deflated if the browser supports it, in base 64 with characters that need no escaping.
 */

/** Maximum length of the text in a link, characters. */
const MOST = 100_000;

async function through(bytes: Uint8Array<ArrayBuffer>, stream: GenericTransformStream): Promise<Uint8Array<ArrayBuffer>> {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

/** Packs text; the first letter identifies the encoding. */
export async function packed(text: string): Promise<string> {
  const plain = new TextEncoder().encode(text);
  const isDeflated = typeof CompressionStream === "function";
  const bytes = isDeflated ? await through(plain, new CompressionStream("deflate-raw")) : plain;
  const letters = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  const code = btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
  return (isDeflated ? "d" : "p") + code;
}

/** Unpacks text. Rejects with a message if it is damaged. */
export async function unpacked(code: string): Promise<string> {
  try {
    if (!/^[dp]/.test(code) || code.length > MOST) throw new Error("of no way that is known");
    const letters = atob(code.slice(1).replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    const plain = code.startsWith("d") ? await through(bytes, new DecompressionStream("deflate-raw")) : bytes;
    const text = new TextDecoder("utf-8", { fatal: true }).decode(plain);
    if (text.length <= MOST) return text;
  } catch {
    // Damaged; the error is thrown below.
  }
  throw new Error("The code in this link is damaged or longer than 100,000 characters.");
}
