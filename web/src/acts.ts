/** Actions that a figure's shell triggers on the running figure. */

import type { Engine } from "./module.js";
import type { Session } from "./session.js";
import type { Acts } from "./shell.js";

/** Access to the running figure. */
export interface Running {
  /** The running figure, or undefined if the shell has been replaced. */
  session: () => Session | undefined;
  /** The figure's name. */
  name: () => string;
}

/** Pointer, input, job and photograph actions; without a running figure they do nothing. */
export function actsOn({ session, name }: Running): Pick<Acts, "send" | "hand" | "jobs" | "takePhoto"> {
  const act = (work: (engine: Engine, width: number) => string | undefined) => {
    const running = session();
    running?.act((engine) => work(engine, running.width));
  };
  const learn = (work: (engine: Engine) => boolean) => session()?.learn((engine) => void work(engine));
  return {
    send: (event) => act((engine) => engine.update(event)),
    hand: {
      handleAt: (x, y) => {
        const running = session();
        return running?.ask((engine) => engine.handleAt(running.width, x, y));
      },
      drag: (id, x, y) => act((engine, width) => engine.drag(id, width, x, y)),
      nudge: (id, towards, steps) => act((engine, width) => engine.nudge(id, width, towards, steps)),
      moveToEnd: (id, towards) => act((engine, width) => engine.moveToEnd(id, width, towards)),
      remove: (id) => act((engine) => engine.update({ type: "handle-removed", id })),
      click: (x, y) => {
        act((engine, width) => engine.click(width, x, y));
        // Draw at once, so that a point created by a click can be dragged right away.
        session()?.show();
      },
      set: (id, value) => act((engine) => engine.update({ type: "set", id, value })),
    },
    jobs: {
      next: () => {
        const job = session()?.ask((engine) => engine.job());
        return job && { name: name(), ...job };
      },
      done: (key, result) => learn((engine) => engine.jobDone(key, result)),
      failed: (key, sentence) => learn((engine) => engine.jobFailed(key, sentence)),
    },
    takePhoto: (slot, photo) => session()?.move((engine) => engine.takePhoto(slot, photo)),
  };
}
