// On a narrow screen the browser leaves out what is far below until it is needed, so that a page
// comes quickly. Once it is there, the rest is laid out too, a section at a time: then lengths are
// true, and nothing jumps in a browser that does not hold on to what the reader sees.

export function settleSections(): void {
  const sections = [...document.querySelectorAll("article > section")];
  const settle = () => {
    sections.shift()?.classList.add("settled");
    if (sections.length > 0) whenIdle(settle);
  };
  if (location.hash) {
    // The place that the link names depends on everything above it.
    for (const section of sections) section.classList.add("settled");
  } else if (document.readyState === "complete") whenIdle(settle);
  else addEventListener("load", () => whenIdle(settle), { once: true });
}

/** In a frame of its own. Safari has no requestIdleCallback. */
function whenIdle(work: () => void): void {
  requestAnimationFrame(() => {
    if ("requestIdleCallback" in window) requestIdleCallback(work, { timeout: 500 });
    else setTimeout(work);
  });
}
