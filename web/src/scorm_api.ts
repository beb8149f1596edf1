/**
 * The API that a learning platform provides to SCORM 1.2 packages, in a parent frame or the window that opened the
 * package.
 */

/** All values are strings, with "true" or "false" for success. */
export interface Api {
  LMSInitialize: (empty: "") => string;
  LMSGetValue: (name: string) => string;
  LMSSetValue: (name: string, value: string) => string;
  LMSCommit: (empty: "") => string;
  LMSFinish: (empty: "") => string;
}

/** Maximum length of `cmi.suspend_data` in the standard, characters. */
const LONGEST = 4096;
/** Maximum depth of parent frames searched, from the standard. */
const DEEPEST = 7;

function search(from: Window): Api | undefined {
  let at = from;
  for (let depth = 0; depth <= DEEPEST; depth += 1) {
    try {
      const { API } = at as unknown as { API?: Api };
      if (API) return API;
    } catch {
      // Frames of another origin are not accessible.
      return undefined;
    }
    if (at.parent === at) break;
    at = at.parent;
  }
  return undefined;
}

/** Returns the initialized API; undefined without a platform. */
export function findApi(): Api | undefined {
  const api = search(window) ?? (window.opener ? search(window.opener as Window) : undefined);
  return api && api.LMSInitialize("") !== "false" ? api : undefined;
}

/**
 * Stores a state and, if there are goals, the fraction reached, 0 to 1. Returns false if the state is longer than the
 * standard allows; the score is stored even then.
 */
export function record(api: Api, state: unknown, reached: number | undefined): boolean {
  const text = JSON.stringify(state);
  const fits = text.length <= LONGEST;
  if (fits) api.LMSSetValue("cmi.suspend_data", text);
  if (reached !== undefined) {
    api.LMSSetValue("cmi.core.score.min", "0");
    api.LMSSetValue("cmi.core.score.max", "100");
    api.LMSSetValue("cmi.core.score.raw", String(Math.round(100 * reached)));
  }
  api.LMSSetValue("cmi.core.lesson_status", (reached ?? 1) === 1 ? "completed" : "incomplete");
  api.LMSCommit("");
  return fits;
}

/** Ends the visit once, when the page is left; `keep` stores unsaved state. */
export function finishOnLeave(api: Api, keep: () => void): void {
  let finished = false;
  addEventListener("pagehide", () => {
    if (finished) return;
    finished = true;
    keep();
    api.LMSSetValue("cmi.core.exit", "suspend");
    api.LMSFinish("");
  });
}
