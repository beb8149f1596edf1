/** Plots of numbers, loaded for the first one. */

import uPlot from "uplot";
import type { Axes, Series } from "./messages.js";

/** Height of a plot, CSS pixels. */
const HIGH_PX = 260;
/** Minimum width, CSS pixels. */
const LEAST_PX = 240;
const FONT = "13px system-ui, sans-serif";

export function drawPlot(place: HTMLElement, { x, y, label, dots }: Series, axes: Axes): void {
  // A canvas does not support light-dark().
  const color = (name: string) => {
    place.style.color = `var(${name})`;
    return getComputedStyle(place).color;
  };
  const lines = { grid: { stroke: color("--edge") }, ticks: { stroke: color("--edge") } };
  const side = { stroke: color("--muted"), labelFont: FONT, font: FONT, ...lines };
  const accent = color("--accent");
  place.style.color = "";
  const size = () => ({ width: Math.max(LEAST_PX, place.clientWidth), height: HIGH_PX });
  const points = { show: dots, size: 6, fill: accent };
  const plot = new uPlot(
    {
      ...size(),
      scales: { x: { time: false } },
      legend: { show: label !== "" },
      axes: [{ ...side, label: axes.x || undefined }, { ...side, label: axes.y || undefined }],
      series: [{ label: axes.x || "x" }, { label: label || "y", stroke: accent, width: dots ? 0 : 2, points }],
    },
    sorted(x, y),
    place,
  );
  const canvas = plot.root.querySelector("canvas");
  canvas?.setAttribute("role", "img");
  canvas?.setAttribute("aria-label", describe({ x, y, label, dots }, axes));
  new ResizeObserver(() => plot.setSize(size())).observe(place);
  if (!axes.title) return;
  const title = document.createElement("p");
  title.textContent = axes.title;
  place.append(title);
}

/** Sorts values by x, as required by the plotting library. */
function sorted(x: readonly number[], y: readonly number[]): [number[], (number | null)[]] {
  const order = x.map((_, index) => index).filter((index) => Number.isFinite(x[index]));
  order.sort((first, second) => (x[first] ?? 0) - (x[second] ?? 0));
  const value = (index: number) => (Number.isFinite(y[index]) ? (y[index] ?? null) : null);
  return [order.map((index) => x[index] ?? 0), order.map(value)];
}

function describe({ x, y, label }: Series, axes: Axes): string {
  const range = (values: readonly number[]) => {
    const finite = values.filter(Number.isFinite);
    if (finite.length === 0) return "no numbers";
    const [least, most] = [finite.reduce((a, b) => Math.min(a, b)), finite.reduce((a, b) => Math.max(a, b))];
    return `from ${least.toPrecision(3)} to ${most.toPrecision(3)}`;
  };
  const shown = `${label || axes.y || "y"} ${range(y)} over ${axes.x || "x"} ${range(x)}`;
  return `${axes.title || "Plot"}: ${shown}`;
}
