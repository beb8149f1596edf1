/**
 * SPLICE messages (https://cssplice.org) between a page in an iframe and its host page.
 */

let count = 0;

/** Returns a unique id. `crypto.randomUUID` is missing on pages served without https. */
export function messageId(): string {
  count += 1;
  return `epipole-${Date.now().toString(36)}-${Math.random().toString(36).slice(2)}-${count}`;
}

export function post(message: unknown): void {
  // The origin of the parent is unknown, and the messages contain no private data.
  parent.postMessage(message, "*");
}

/** Posts a message and returns its id. */
export function tell(subject: string, more: object): string {
  const message_id = messageId();
  post({ subject, message_id, ...more });
  return message_id;
}

/** Callbacks for a host page. */
export interface Answers {
  /** Receives the state stored by the host; without one if the host answers with an error. */
  restore: (state: unknown) => void;
  /** Reports immediately; returns whether there was anything to report. */
  flush: () => boolean;
}

/**
 * Asks the host page, the direct parent, for the stored state, and answers its requests for reports. Returns a function
 * that stops it.
 */
export function answerHost({ restore, flush }: Answers): () => void {
  /** Id of the pending request. */
  let asked: string | undefined;
  const onMessage = ({ source, data }: MessageEvent) => {
    const message = source === parent ? recordOf(data) : undefined;
    if (message?.["subject"] === "SPLICE.flushState") {
      const hadState = flush();
      post({ subject: "SPLICE.flushState.response", message_id: message["message_id"], success: true, hadState });
    }
    if (message?.["subject"] !== "SPLICE.getState.response") return;
    if (asked === undefined || message["message_id"] !== asked) return;
    asked = undefined;
    restore(message["error"] == null ? message["state"] : undefined);
  };
  addEventListener("message", onMessage);
  asked = tell("SPLICE.getState", {});
  return () => removeEventListener("message", onMessage);
}

/** Returns a message as an object; it may arrive as JSON text. */
export function recordOf(data: unknown): Record<string, unknown> | undefined {
  let value = data;
  if (typeof data === "string") {
    try {
      value = JSON.parse(data);
    } catch {
      return undefined;
    }
  }
  return typeof value === "object" && value !== null ? (value as Record<string, unknown>) : undefined;
}
