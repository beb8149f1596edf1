/** Plots of numbers, loaded with the first of them. */

import uPlot from "uplot";
import type { Axes, Series } from "./messages.js";

/** Height of a plot, CSS pixels. */
const HIGH_PX = 260;
const FONT = "13px system-ui, sans-serif";

export function drawPlot(place: HTMLElement, series: readonly Series[], axes: Axes): void {
  // A canvas does not understand light-dark().
  const color = (name: string) => {
    place.style.color = `var(${name})`;
    return getComputedStyle(place).color;
  };
  const data = uPlot.join(series.map(({ x, y }) => sorted(x, y)));
  const side = { stroke: color("--muted"), labelFont: FONT, font: FONT, grid: { stroke: color("--edge") }, ticks: { stroke: color("--edge") } };
  const accent = color("--accent");
  place.style.color = "";
  const plot = new uPlot(
    {
      width: Math.max(240, place.clientWidth),
      height: HIGH_PX,
      scales: { x: { time: false } },
      legend: { show: series.some(({ label }) => label !== "") },
      axes: [{ ...side, label: axes.x || undefined }, { ...side, label: axes.y || undefined }],
      series: [
        { label: axes.x || "x" },
        ...series.map(({ label, dots }) => ({
          label: label || "y",
          stroke: accent,
          width: dots ? 0 : 2,
          points: { show: dots, size: 6, fill: accent },
        })),
      ],
    },
    data,
    place,
  );
  plot.root.querySelector("canvas")?.setAttribute("role", "img");
  plot.root.querySelector("canvas")?.setAttribute("aria-label", describe(series, axes));
  new ResizeObserver(() => plot.setSize({ width: Math.max(240, place.clientWidth), height: HIGH_PX })).observe(place);
  if (!axes.title) return;
  const title = document.createElement("p");
  title.textContent = axes.title;
  place.append(title);
}

/** Values in the order of their places, as the plot wants them. */
function sorted(x: readonly number[], y: readonly number[]): [number[], (number | null)[]] {
  const order = x.map((_, index) => index).filter((index) => Number.isFinite(x[index]));
  order.sort((first, second) => (x[first] ?? 0) - (x[second] ?? 0));
  const value = (index: number) => (Number.isFinite(y[index]) ? (y[index] ?? null) : null);
  return [order.map((index) => x[index] ?? 0), order.map(value)];
}

function describe(series: readonly Series[], { title, x, y }: Axes): string {
  const range = (values: readonly number[]) => {
    const finite = values.filter(Number.isFinite);
    const shown = (value: number) => value.toPrecision(3);
    const extreme = (pick: (first: number, second: number) => number) => finite.reduce((all, value) => pick(all, value));
    return finite.length === 0 ? "no numbers" : `from ${shown(extreme(Math.min))} to ${shown(extreme(Math.max))}`;
  };
  const parts = series.map((one) => `${one.label || y || "y"} ${range(one.y)} over ${x || "x"} ${range(one.x)}`);
  return `${title || "Plot"}: ${parts.join("; ")}`;
}
