/** Errors of calls. */

/** Code of data without a result. */
export type Code = "TooFew" | "Degenerate" | "NoConsensus";

/** Data without a result: too few, degenerate, or without a model that enough of them support. */
export class VisionError extends Error {
  override readonly name = "VisionError";
  /** Reason. */
  readonly code: Code;

  constructor(code: Code, message: string) {
    super(message);
    this.code = code;
  }
}

/** Class or code, and message, as the modules and the worker give them. */
export type Fault = readonly [kind: string, message: string];

/** The error to throw. */
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

/** Class or code, and message, of anything thrown by a module. */
export function faultOf(problem: unknown): Fault {
  if (Array.isArray(problem)) return [String(problem[0]), String(problem[1])];
  return ["Error", problem instanceof Error ? problem.message : String(problem)];
}
