// SPDX-License-Identifier: Apache-2.0
// Bundles the pages, each into one file that asks for nothing: node build.mjs OUT
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, "dist");

const bundled = await build({
  entryPoints: [join(here, "src/page/main.ts")],
  bundle: true,
  minify: true,
  write: false,
  format: "iife",
  target: "es2022",
  legalComments: "inline",
});
const script = bundled.outputFiles[0].text.replaceAll("</script", "<\\/script");
const uplot = await readFile(join(here, "node_modules/uplot/dist/uPlot.min.css"), "utf8");
const style = uplot + (await readFile(join(here, "src/page/style.css"), "utf8"));
const page = await readFile(join(here, "src/page/view.html"), "utf8");
await mkdir(out, { recursive: true });
await writeFile(
  join(out, "view.html"),
  page.replace("/*STYLE*/", () => style).replace("/*SCRIPT*/", () => script),
);
