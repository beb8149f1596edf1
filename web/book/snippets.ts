// Code snippets that show a figure in a given state, one for each kind of host page.

export interface Wish {
  name: string;
  title: string;
  state: Record<string, string>;
  /** Address of the book, with a trailing slash. */
  book: string;
  /** Height of the figure, CSS pixels. */
  height: number;
}

export interface Host {
  name: string;
  write: (wish: Wish) => string;
}

function escape(text: string): string {
  return text.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
}

function attributes({ name, state }: Wish): string {
  return [["name", name], ...Object.entries(state)].map(([key, value]) => `${key}="${escape(value ?? "")}"`).join(" ");
}

function element(wish: Wish, more = ""): string {
  return `<epipole-figure ${attributes(wish)}${more}></epipole-figure>`;
}

function script({ book }: Wish): string {
  return `<script type="module" src="${escape(book)}embed/epipole.js"></script>`;
}

function frame(wish: Wish): string {
  const address = new URL(`embed/${wish.name}.html`, wish.book);
  for (const [key, value] of Object.entries(wish.state)) address.searchParams.set(key, value);
  return (
    `<iframe src="${escape(address.href)}" title="${escape(wish.title)}" width="100%" height="${wish.height}" ` +
    'loading="lazy" allow="fullscreen; clipboard-write"></iframe>'
  );
}

/** A value as a Python literal. */
function python(value: string): string {
  if (value === "true") return "True";
  if (value === "false") return "False";
  return /^-?\d+(\.\d+)?$/.test(value) ? String(Number(value)) : JSON.stringify(value);
}

export const HOSTS: readonly Host[] = [
  { name: "HTML", write: (wish) => `${script(wish)}\n${element(wish)}` },
  { name: "Frame (courses, wikis)", write: frame },
  { name: "Markdown", write: (wish) => `${script(wish)}\n\n<div>${element(wish)}</div>` },
  { name: "Slides", write: (wish) => `${script(wish)}\n${element(wish, ' compact style="height: 560px"')}` },
  { name: "JavaScript bundle", write: (wish) => `import "@epipole/figures";\n\n${element(wish)}` },
  {
    name: "Python notebook",
    write: ({ name, state }) => {
      // Names that are no Python identifiers go into a dictionary.
      const plain = Object.keys(state).every((key) => /^[a-z_]\w*$/.test(key));
      const pairs = Object.entries(state);
      const more = plain
        ? pairs.map(([key, value]) => `, ${key}=${python(value)}`).join("")
        : `, **{${pairs.map(([key, value]) => `${JSON.stringify(key)}: ${python(value)}`).join(", ")}}`;
      return `from epipole.figures import Figure\n\nFigure(${JSON.stringify(name)}${more})`;
    },
  },
];
