// On narrow screens, distant sections are skipped at first (content-visibility) so that the page
// loads quickly. After loading, the rest is laid out one section at a time: scroll heights become
// exact, and nothing jumps in browsers without scroll anchoring.

export function settleSections(): void {
  const sections = [...document.querySelectorAll("article > section")];
  const settle = () => {
    sections.shift()?.classList.add("settled");
    if (sections.length > 0) whenIdle(settle);
  };
  if (location.hash) {
    // The position of the link target depends on everything above it.
    for (const section of sections) section.classList.add("settled");
  } else if (document.readyState === "complete") whenIdle(settle);
  else addEventListener("load", () => whenIdle(settle), { once: true });
}

/** Runs `work` in a separate frame. Safari lacks requestIdleCallback. */
function whenIdle(work: () => void): void {
  requestAnimationFrame(() => {
    if ("requestIdleCallback" in window) requestIdleCallback(work, { timeout: 500 });
    else setTimeout(work);
  });
}
