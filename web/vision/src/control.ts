/** Control of a call, beside its options. */
export interface Control {
  /** Cancels the call: it rejects with the reason of the signal. */
  signal?: AbortSignal | undefined;
  /** Receives the current stage and the fraction done, 0 to 1. */
  progress?: ((stage: string, fraction: number) => void) | undefined;
}
