// esbuild plugin for the module `epipole-look`: the figures' style sheet as one string.

import { build } from "esbuild";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));

export const look = {
  name: "epipole-look",
  setup({ onResolve, onLoad }) {
    onResolve({ filter: /^epipole-look$/ }, ({ path }) => ({ path, namespace: "look" }));
    onLoad({ filter: /.*/, namespace: "look" }, async () => {
      const { outputFiles } = await build({
        entryPoints: [join(here, "src/figure.css")],
        bundle: true,
        target: ["chrome107", "firefox104", "safari16"],
        minify: true,
        write: false,
      });
      return { contents: outputFiles[0].text, loader: "text" };
    });
  },
};
