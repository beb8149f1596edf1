/** Errors of calls. */

/** Reason why data give no result. */
export type Code = "TooFew" | "Degenerate" | "NoConsensus";

/** Error for data without a result: too few, degenerate, or without a model supported by enough of them. */
export class VisionError extends Error {
  override readonly name = "VisionError";
  /** Reason. */
  readonly code: Code;

  constructor(code: Code, message: string) {
    super(message);
    this.code = code;
  }
}

/** Class or code, and message, as returned by modules and the worker. */
export type Fault = readonly [kind: string, message: string];

/** Returns the error to throw. */
export function errorOf([kind, message]: Fault): Error {
  switch (kind) {
    case "TypeError":
      return new TypeError(message);
    case "RangeError":
      return new RangeError(message);
    case "AbortError":
      return new DOMException(message, "AbortError");
    case "TooFew":
    case "Degenerate":
    case "NoConsensus":
      return new VisionError(kind, message);
    default:
      return new Error(message);
  }
}

/** Returns class or code, and message, of any error thrown by a module. */
export function faultOf(problem: unknown): Fault {
  if (Array.isArray(problem)) return [String(problem[0]), String(problem[1])];
  return ["Error", problem instanceof Error ? problem.message : String(problem)];
}
