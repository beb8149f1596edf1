// Scripts of calls to figures, and their playback in a page.
// `crates/epipole-web/examples/trace.rs` plays them natively.

import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { jobsWasm, root, wasm } from "./places.mjs";

/** A script that operates every control and handle of a figure, drawing a frame now and then. */
export function write(Figure, name, { width, scale, theme, seed, rounds = 5 }) {
  const figure = new Figure(name);
  const calls = [];
  const script = { figure: name, width, scale, theme, calls };
  // Park and Miller's generator; any deterministic one would do.
  let state = seed;
  const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
  const pick = (list) => list[Math.floor(random() * list.length)];
  const add = (...words) => {
    calls.push(words);
    const [method, ...args] = words;
    if (method !== "draw_settled") figure[method](...args);
  };
  add("draw_settled");
  for (let round = 0; round < rounds; round += 1) {
    const { controls, handles, layout } = JSON.parse(figure.snapshot(width));
    for (const control of controls) {
      const { id, kind } = control;
      if (kind === "slider") {
        add("set_number", id, control.min + random() * (control.max - control.min));
      } else if (kind === "toggle") add("set_flag", id, random() < 0.5);
      else if (kind === "choice") add("set_text", id, pick(control.options)[0]);
      else add("press", id);
      for (let ticks = 0; ticks < 3; ticks += 1) add("tick", random() / 10);
    }
    for (const { id } of handles.slice(0, 8)) {
      add("drag", id, width, random() * layout.width, random() * layout.height);
      add("nudge", id, width, pick(["left", "right", "up", "down"]), pick([0.2, 1, 5]));
    }
    if (handles.length > 0) add("move_to_end", pick(handles).id, width, pick(["left", "right"]));
    for (let clicks = 0; clicks < 3; clicks += 1) {
      add("click", width, random() * layout.width, random() * layout.height);
    }
    const removable = handles.filter((handle) => handle.removable);
    if (removable.length > 0) add("remove", pick(removable).id);
    add("draw_settled");
  }
  add("reset");
  add("draw_settled");
  figure.free();
  return script;
}

/** Programs that play scripts, by profile. Asking cargo each time takes longer than a script. */
const programs = new Map();

function programOf(profile) {
  if (!programs.has(profile)) {
    const flags = profile === "release" ? ["--release"] : [];
    // Without --package, so that dependencies have the same features as in the tests.
    execFileSync("cargo", ["build", "--quiet", "--example", "trace", ...flags], { cwd: root, stdio: "ignore" });
    programs.set(profile, join(root, "target", profile, "examples", "trace"));
  }
  return programs.get(profile);
}

/** Native results of scripts; with `--time`, the milliseconds of each. */
export function playNatively(scripts, ...flags) {
  const program = programOf(flags.includes("--time") ? "release" : "debug");
  const output = execFileSync(program, flags, {
    cwd: root,
    input: JSON.stringify(scripts),
    maxBuffer: 1 << 30,
    stdio: ["pipe", "pipe", "ignore"],
  });
  return JSON.parse(output.toString());
}

/** Addresses of the modules for `playInPage`. */
export function modulesAt(site) {
  const at = (name, path) => [`${site}/bindings/epipole_${name}.js`, `${site}/elements/${path}`];
  return { page: at("figures", wasm), worker: at("jobs", jobsWasm) };
}

/** Runs in a page: the results of scripts there. */
export async function playInPage({ page, worker, scripts, timed = false }) {
  const open = async ([glue, path]) => {
    const module = await import(glue);
    await module.default({ module_or_path: path });
    return module;
  };
  const [{ Figure }, { compute }] = [await open(page), await open(worker)];
  // Scripts of one figure begin alike; their times would differ.
  const known = new Map();
  const answerOf = (figure, key, request) => {
    const asked = `${figure} ${key}`;
    if (timed || !known.has(asked)) known.set(asked, compute(figure, request, { progress: () => {} }));
    return known.get(asked);
  };
  return scripts.map((script) => {
    const figure = new Figure(script.figure);
    const frame = [script.width, script.scale, script.theme];
    const settle = () => {
      for (let stage = 0; stage < 16; stage += 1) {
        const key = figure.job_key();
        if (key === undefined) return;
        try {
          figure.job_done(key, answerOf(script.figure, key, figure.job_request()));
        } catch (problem) {
          figure.job_failed(key, problem);
        }
      }
    };
    const call = ([method, ...args]) => {
      if (method === "draw_settled") {
        settle();
        return figure.draw_sharp(...frame) ?? "";
      }
      return figure[method](...(method === "draw" ? frame : args)) ?? "";
    };
    if (timed) {
      const start = performance.now();
      for (const words of script.calls) call(words);
      return performance.now() - start;
    }
    return script.calls.map((words) => {
      const said = call(words);
      if (words[0] !== "draw_settled") return said + figure.snapshot(script.width) + figure.state();
      return `${figure.pixel_width()} × ${figure.pixel_height()}: ${figure.frame_hash()}`;
    });
  });
}
