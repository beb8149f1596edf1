/**
 * SPLICE messages (https://cssplice.org) between a page in an iframe and its host page.
 */

let count = 0;

/** A unique id. `crypto.randomUUID` is missing on pages served without https. */
export function messageId(): string {
  count += 1;
  return `epipole-${Date.now().toString(36)}-${Math.random().toString(36).slice(2)}-${count}`;
}

export function post(message: unknown): void {
  // The origin of the parent is unknown, and the messages contain nothing private.
  parent.postMessage(message, "*");
}

/** Posts a message and returns its id. */
export function tell(subject: string, more: object): string {
  const message_id = messageId();
  post({ subject, message_id, ...more });
  return message_id;
}

/** Answers to a host page. */
export interface Answers {
  /** Takes the state that the host has stored; it has none where it answers with an error. */
  restore: (state: unknown) => void;
  /** Reports at once; returns whether there was something to report. */
  flush: () => boolean;
}

/**
 * Asks the host page, the direct parent, for the stored state, and answers when it wants reports.
 * Returns a function that ends it.
 */
export function answerHost({ restore, flush }: Answers): () => void {
  /** Id of the request that is still open. */
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

/** A message as an object; it may arrive as JSON text. */
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
