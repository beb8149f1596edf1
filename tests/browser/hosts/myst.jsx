// What mystmd has built, shown by the packages of its themes: the least theme that there can be.

import { ANY_RENDERERS } from "@myst-theme/anywidget";
import { createRoot } from "react-dom/client";

const { anywidget: AnyWidget } = ANY_RENDERERS;

/** A frame stands in a box of three fifths of its width. */
function Frame({ node }) {
  return (
    <div style={{ position: "relative", width: node.width, paddingBottom: "60%" }}>
      <iframe src={node.src} title={node.title} style={{ position: "absolute", inset: 0, width: "100%", height: "100%", border: 0 }} />
    </div>
  );
}

function Content({ node }) {
  const inside = node.children?.map((child) => <Content key={child.key} node={child} />);
  if (node.type === "anywidget") return <AnyWidget node={node} />;
  if (node.type === "iframe") return <Frame node={node} />;
  if (node.type === "text") return node.value;
  if (node.type === "link") return <a href={`${node.url}.html`}>{inside}</a>;
  if (node.type === "paragraph") return <p>{inside}</p>;
  return <div>{inside}</div>;
}

const slug = /([\w-]+)\.html$/.exec(location.pathname)[1];
const { frontmatter, mdast } = await (await fetch(`content/${slug}.json`)).json();
const root = createRoot(document.querySelector("main"));
root.render(
  <>
    <h1>{frontmatter.title}</h1>
    <Content node={mdast} />
  </>,
);
// Themes turn pages without loading them.
globalThis.leave = () => root.unmount();
