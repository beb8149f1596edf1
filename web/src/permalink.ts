/**
 * State of a figure in the page's address.
 *
 * `?fig-race.outliers=0.4&fig-race.seed=7#fig-race`: each parameter is prefixed with its figure's
 * key, which is the `id` of the element or of the `<figure>` around it, else the figure's name
 * (with `-2`, `-3`, … for repeated figures). With a single figure on the page, the key may be
 * omitted; unknown parameters without a key belong to the page and are ignored.
 */


/** Parameters of a figure in permalink order. */
export type Parameters = [key: string, value: string][];

const TAG: string = "epipole-figure";

/** Returns the key of a figure's parameters. */
export function keyOf(element: HTMLElement): string {
  const id = anchorOf(element);
  if (id) return id;
  const name = element.getAttribute("name") ?? TAG;
  const same = [...document.querySelectorAll<HTMLElement>(TAG)].filter(
    (other: HTMLElement) => other.getAttribute("name") === name && !anchorOf(other),
  );
  const index = same.indexOf(element);
  return index > 0 ? `${name}-${index + 1}` : name;
}

function anchorOf(element: Element): string {
  return element.id || element.closest("figure[id]")?.id || "";
}

function isAlone(): boolean {
  return document.querySelectorAll(TAG).length === 1;
}

function pairsOf(search: string): Parameters {
  return [...new URLSearchParams(search)];
}

/** Returns the parameters in the page's address: those with the figure's key, and those without any. */
export function parametersIn(
  search: string,
  element: HTMLElement,
): { own: Parameters; loose: Parameters } {
  const prefix = `${keyOf(element)}.`;
  const pairs = pairsOf(search);
  return {
    own: pairs
      .filter(([key]) => key.startsWith(prefix))
      .map(([key, value]) => [key.slice(prefix.length), value]),
    loose: isAlone() ? pairs.filter(([key]) => !key.includes(".")) : [],
  };
}

/** Returns the page's address with a figure's state, replacing the state in it. */
export function linkTo(
  element: HTMLElement,
  state: Parameters,
  isOwn: (key: string) => boolean,
): string {
  const key = keyOf(element);
  const others = pairsOf(location.search).filter(
    ([name]) => !name.startsWith(`${key}.`) && !(isAlone() && isOwn(name)),
  );
  const prefix = isAlone() ? "" : `${key}.`;
  const own: Parameters = state.map(([name, value]) => [prefix + name, value]);
  const query = [...others, ...own]
    .map(([name, value]) => `${encode(name)}=${encode(value)}`)
    .join("&");
  const anchor = anchorOf(element);
  return (
    location.href.replace(/[?#].*$/s, "") +
    (query ? `?${query}` : "") +
    (anchor ? `#${encode(anchor)}` : "")
  );
}

/** Encodes like `encodeURIComponent`, but keeps positions such as `1.5,2` readable. */
function encode(text: string): string {
  return encodeURIComponent(text).replace(/%2C/g, ",");
}
