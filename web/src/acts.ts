/** What the tree of a figure does to the figure that runs in it. */

import type { Engine } from "./module.js";
import type { Renderer } from "./renderer.js";
import type { Acts } from "./shell.js";

/** The figure as its tree needs it. */
export interface Running {
  /** The running figure, unless the tree is no longer its tree. */
  renderer: () => Renderer | undefined;
  /** The figure's name. */
  name: () => string;
}

/** Acts of hand, inputs, computations and photographs; whatever comes without a running figure does nothing. */
export function actsOn({ renderer, name }: Running): Pick<Acts, "send" | "hand" | "jobs" | "takePhoto"> {
  const act = (work: (engine: Engine, width: number) => string | undefined) => {
    const running = renderer();
    running?.act((engine) => work(engine, running.width));
  };
  const learn = (work: (engine: Engine) => boolean) => renderer()?.learn((engine) => void work(engine));
  return {
    send: (event) => act((engine) => engine.update(event)),
    hand: {
      handleAt: (x, y) => {
        const running = renderer();
        return running?.ask((engine) => engine.handleAt(running.width, x, y));
      },
      drag: (id, x, y) => act((engine, width) => engine.drag(id, width, x, y)),
      nudge: (id, towards, steps) => act((engine, width) => engine.nudge(id, width, towards, steps)),
      moveToEnd: (id, towards) => act((engine, width) => engine.moveToEnd(id, width, towards)),
      remove: (id) => act((engine) => engine.update({ type: "handle-removed", id })),
      click: (x, y) => {
        act((engine, width) => engine.click(width, x, y));
        // A point that a click has made can be dragged on at once.
        renderer()?.show();
      },
      set: (id, value) => act((engine) => engine.update({ type: "set", id, value })),
    },
    jobs: {
      next: () => {
        const job = renderer()?.ask((engine) => engine.job());
        return job && { name: name(), ...job };
      },
      done: (key, result) => learn((engine) => engine.jobDone(key, result)),
      failed: (key, sentence) => learn((engine) => engine.jobFailed(key, sentence)),
    },
    takePhoto: (slot, photo) => renderer()?.move((engine) => engine.takePhoto(slot, photo)),
  };
}
