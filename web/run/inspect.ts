/** Values as text, in the style of Node's console. */

/**
 * Maximum number of entries shown of an array; then maximum length of a line before each entry gets its own,
 * characters.
 */
const MOST = 100;
const WIDTH = 72;

/** Formats a printed value: strings unchanged, everything else as a literal. */
export function inspect(value: unknown): string {
  return typeof value === "string" ? value : write(value, 0, new Set());
}

function write(value: unknown, depth: number, above: Set<object>): string {
  if (typeof value === "string") return JSON.stringify(value);
  if (typeof value === "bigint") return `${value}n`;
  if (typeof value === "function") return `[Function: ${value.name || "(anonymous)"}]`;
  if (Object.is(value, -0)) return "-0";
  if (typeof value !== "object" || value === null) return String(value);
  if (value instanceof Error) return `${value.name}: ${value.message}`;
  if (above.has(value)) return "[Circular]";
  const inside = new Set(above).add(value);
  const part = (entry: unknown) => write(entry, depth + 1, inside);
  if (ArrayBuffer.isView(value) && !(value instanceof DataView)) {
    const list = value as unknown as ArrayLike<number>;
    return `${value.constructor.name}(${list.length}) ${listed(list, part, depth)}`;
  }
  if (Array.isArray(value)) return depth > 3 ? "[Array]" : listed(value, part, depth);
  if (depth > 3) return "[Object]";
  if (value instanceof Map || value instanceof Set) {
    return `${value.constructor.name}(${value.size}) ${listed([...value], part, depth)}`;
  }
  const entries = Object.entries(value).map(([key, entry]) => `${key}: ${part(entry)}`);
  return wrapped("{", entries, "}", depth);
}

function listed(list: ArrayLike<unknown>, part: (entry: unknown) => string, depth: number): string {
  const entries = Array.from({ length: Math.min(list.length, MOST) }, (_, index) => part(list[index]));
  if (list.length > MOST) entries.push(`... ${list.length - MOST} more`);
  return wrapped("[", entries, "]", depth);
}

function wrapped(open: string, entries: string[], close: string, depth: number): string {
  if (entries.length === 0) return open + close;
  const line = `${open} ${entries.join(", ")} ${close}`;
  if (line.length <= WIDTH && !line.includes("\n")) return line;
  const indent = "  ".repeat(depth + 1);
  return `${open}\n${fill(entries, indent)}\n${indent.slice(2)}${close}`;
}

/** Joins short entries in lines. */
function fill(entries: string[], indent: string): string {
  const lines: string[] = [];
  let line = "";
  entries.forEach((entry, index) => {
    const word = index < entries.length - 1 ? `${entry},` : entry;
    if (line && (line.length + word.length >= WIDTH || word.includes("\n") || word.includes(": "))) {
      lines.push(line);
      line = "";
    }
    line = line ? `${line} ${word}` : word;
  });
  return [...lines, line].map((text) => indent + text).join("\n");
}
