"""Scripts, WebAssembly modules and pictures that ``epipole.figures`` shows."""
