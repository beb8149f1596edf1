// Code snippets that show a figure in a given state, one for each kind of host page.

export interface EmbeddedFigure {
  name: string;
  title: string;
  state: Record<string, string>;
  /** Controls, readouts and goals to show, as attributes of the element. */
  choice: Record<string, string>;
  /** Address of the book, with a trailing slash. */
  book: string;
  /** Height of the figure, CSS pixels. */
  height: number;
}

export interface Host {
  name: string;
  write: (figure: EmbeddedFigure) => string;
}

function escape(text: string): string {
  return text.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
}

function attributes({ name, state, choice }: EmbeddedFigure): string {
  return [["name", name], ...Object.entries({ ...state, ...choice })].map(([key, value]) => `${key}="${escape(value ?? "")}"`).join(" ");
}

function element(figure: EmbeddedFigure, more = ""): string {
  return `<epipole-figure ${attributes(figure)}${more}></epipole-figure>`;
}

function script({ book }: EmbeddedFigure): string {
  return `<script type="module" src="${escape(book)}embed/epipole.js"></script>`;
}

function frame(figure: EmbeddedFigure): string {
  const address = new URL(`embed/${figure.name}.html`, figure.book);
  for (const [key, value] of Object.entries({ ...figure.state, ...figure.choice })) address.searchParams.set(key, value);
  return (
    `<iframe src="${escape(address.href)}" title="${escape(figure.title)}" width="100%" height="${figure.height}" ` +
    'loading="lazy" allow="fullscreen; clipboard-write"></iframe>'
  );
}

/** Formats a value as a Python literal. */
function python(value: string): string {
  if (value === "true") return "True";
  if (value === "false") return "False";
  return /^-?\d+(\.\d+)?$/.test(value) ? String(Number(value)) : JSON.stringify(value);
}

export const HOSTS: readonly Host[] = [
  { name: "HTML", write: (figure) => `${script(figure)}\n${element(figure)}` },
  { name: "Frame (courses, wikis)", write: frame },
  { name: "Markdown", write: (figure) => `${script(figure)}\n\n<div>${element(figure)}</div>` },
  { name: "Slides", write: (figure) => `${script(figure)}\n${element(figure, ' compact style="height: 560px"')}` },
  { name: "JavaScript bundle", write: (figure) => `import "@epipole/figures";\n\n${element(figure)}` },
  {
    name: "Python notebook",
    write: ({ name, state, choice }) => {
      // Names that are not Python identifiers go into a dictionary.
      const plain = Object.keys(state).every((key) => /^[a-z_]\w*$/.test(key));
      // In Python, `readouts` are the numbers themselves.
      const chosen = Object.entries(choice).map(([key, value]) => [key === "readouts" ? "readouts_shown" : key, value]);
      const pairs = [...Object.entries(state), ...chosen] as [string, string][];
      const more = plain
        ? pairs.map(([key, value]) => `, ${key}=${python(value)}`).join("")
        : `, **{${pairs.map(([key, value]) => `${JSON.stringify(key)}: ${python(value)}`).join(", ")}}`;
      return `from epipole.figures import Figure\n\nFigure(${JSON.stringify(name)}${more})`;
    },
  },
];
