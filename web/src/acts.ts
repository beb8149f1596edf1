/** Actions on a figure: those of its tree, and those of glides and solutions. */

import type { Snapshot } from "./contract.js";
import type { FigureHost } from "./host.js";
import type { Engine } from "./module.js";
import type { Stage } from "./motion.js";
import type { Renderer } from "./renderer.js";
import { layoutWidth } from "./room.js";
import { saveFile, savePicture } from "./saving.js";
import type { Acts, Shell } from "./shell.js";

/** The figure and its element, as needed by actions. */
export interface Parts {
  host: FigureHost;
  /** The running figure. */
  renderer: () => Renderer | undefined;
  snapshot: () => Snapshot | undefined;
  shell: () => Shell;
  /** Resolves when the figure has finished computing. */
  answered: () => Promise<void>;
  toggleSolution: (challenge: string) => void;
}

/** Creates the actions of a tree; without a running figure they have no effect. */
export function actsOn({ host, renderer, snapshot, shell, answered, toggleSolution }: Parts): Acts {
  const name = () => host.getAttribute("name") ?? "";
  const act = (work: (engine: Engine, width: number) => string | undefined) => {
    const running = renderer();
    running?.act((engine) => work(engine, running.width));
  };
  const save = async () => {
    await answered();
    const running = renderer();
    if (running) await savePicture(running, name());
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
        // A point created by a click can be dragged immediately.
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
    deeds: {
      reset: () => host.reset(),
      link: () => host.permalink,
      save: () => void save(),
      saveFile: () => {
        const running = renderer();
        if (running) saveFile(running, snapshot()?.file, name());
      },
      fullscreen: document.fullscreenEnabled ? () => void toggleFullscreen(host, shell()) : undefined,
    },
    showHow: toggleSolution,
  };
}

/** Creates the actions of glides and solutions. */
export function stageOn({ renderer, snapshot, shell }: Parts): Stage {
  return {
    look: () => renderer()?.ask((engine) => engine.snapshot(renderer()?.width || layoutWidth(1))),
    move: (work) => void renderer()?.move(work),
    apply: (parameters) => renderer()?.apply(parameters) ?? [],
    busy: () => snapshot()?.waiting != null && shell().jobs.busy,
    freeze: (frozen) => renderer()?.freeze(frozen),
    mark: (before, now) => {
      renderer()?.show();
      shell().markChanges(before, now);
    },
    solution: (challenge) => renderer()?.ask((engine) => engine.solution(challenge)),
    reset: () => {
      renderer()?.act((engine) => engine.update({ type: "reset" }));
      shell().jobs.goOn();
    },
    playing: (challenge) => (shell().playing = challenge),
    point: (id) => shell().markControl(id),
  };
}

async function toggleFullscreen(host: HTMLElement, { speaker }: Shell): Promise<void> {
  if (document.fullscreenElement) await document.exitFullscreen();
  else await host.requestFullscreen().catch(() => speaker.say("Full screen is not allowed here."));
}
