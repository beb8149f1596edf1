/** Names of the package and of the page, with their documentation, for completion and hints. */

/** A name available to code. */
export interface Name {
  name: string;
  /** Declaration. */
  signature: string;
  docs: string;
  /** Whether it is a method of Vision. */
  isMethod: boolean;
}

/** Functions of the page. */
const OF_THE_PAGE: Name[] = [
  ["show", "show(image, options?: { title?, points?, lines? })", "Shows an image, with points (u, v) and lines (a, b, c)."],
  ["plot", "plot(x, y?, options?: { title?, label?, xLabel?, yLabel?, dots? })", "Plots numbers."],
  ["figure", "figure(name): { state, readouts, data, set(parameters), draw(marks) }", "A figure of this page."],
].map(([name = "", signature = "", docs = ""]) => ({ name, signature, docs, isMethod: false }));

let reading: Promise<Name[]> | undefined;

/** Reads the declarations of the package once. If they are missing, returns only the names of the page. */
export function names(declarations: URL): Promise<Name[]> {
  reading ??= fetch(declarations)
    .then((response) => (response.ok ? response.text() : ""))
    .catch(() => "")
    .then((text) => [...OF_THE_PAGE, ...methodsOf(text)]);
  return reading;
}

/** Returns the methods of the interface `Functions`, each with the comment above it. */
export function methodsOf(declarations: string): Name[] {
  const start = declarations.indexOf("interface Functions");
  const body = start < 0 ? "" : declarations.slice(start);
  const found = body.matchAll(/\/\*\*((?:(?!\*\/)[\s\S])*)\*\/\s*(\w+)(\([^\n]*);/g);
  return [...found].map(([, comment = "", name = "", rest = ""]) => ({
    name,
    signature: name + rest,
    docs: comment.replace(/\s*\n\s*\*?\s*/g, " ").trim(),
    isMethod: true,
  }));
}
