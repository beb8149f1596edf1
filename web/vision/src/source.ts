/** The script of a part's module, as wasm-bindgen generates it from `crates/epipole-js`. */
export interface Bindings {
  default(options: { module_or_path: WebAssembly.Module }): Promise<unknown>;
  call(name: string, given: readonly unknown[], report?: (stage: string, share: number) => boolean): unknown;
}

/** Script of a part, and address of its module. */
export interface Source {
  script: Bindings;
  wasm(): URL;
}
