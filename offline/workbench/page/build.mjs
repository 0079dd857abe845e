// SPDX-License-Identifier: Apache-2.0
// Writes dist/{index.html,app.js,app.css}. The colours are those of the figures: they are stated once,
// in offline/draw/paint.cpp (or PLUMB_PAINT of the environment), and read from there.
import { build } from "esbuild";
import { copyFileSync, existsSync, mkdirSync, readFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const paintFile = process.env.PLUMB_PAINT ?? above(here);
const largestGzip = 250_000; // bytes: what the page may weigh on the wire

/** offline/draw/paint.cpp of the sources that this folder, or a build folder in them, is part of. */
function above(folder) {
  const file = join(folder, "offline/draw/paint.cpp");
  if (existsSync(file)) return file;
  if (dirname(folder) === folder) throw new Error("offline/draw/paint.cpp is not above this folder: name it in PLUMB_PAINT");
  return above(dirname(folder));
}

function tones(name) {
  const found = new RegExp(`${name}\\{([^}]*)\\}`).exec(readFileSync(paintFile, "utf8"));
  const colours = found ? found[1].match(/#[0-9a-f]{6}/g) : null;
  if (!colours) throw new Error(`${paintFile} has no colours ${name}: build.mjs reads them there`);
  return colours.map((colour, i) => `--plumb-${i}:${colour};`).join("");
}

const colours = {
  name: "colours",
  setup(b) {
    b.onResolve({ filter: /^plumb-colours\.css$/ }, () => ({ path: "colours", namespace: "plumb" }));
    b.onLoad({ filter: /.*/, namespace: "plumb" }, () => ({
      contents:
        `:root{color-scheme:light dark;${tones("kLight")}}\n` +
        `@media (prefers-color-scheme:dark){:root{${tones("kDark")}}}\n`,
      loader: "css",
    }));
  },
};

const out = join(here, "dist");
mkdirSync(out, { recursive: true });
await build({
  entryPoints: [join(here, "src/app.tsx")],
  outdir: out,
  bundle: true,
  minify: true,
  format: "esm",
  target: ["es2021"],
  jsx: "automatic",
  jsxImportSource: "preact",
  legalComments: "none",
  plugins: [colours],
  logLevel: "warning",
});
copyFileSync(join(here, "src/index.html"), join(out, "index.html"));

let sum = 0;
for (const name of ["index.html", "app.js", "app.css"])
  sum += gzipSync(readFileSync(join(out, name)), { level: 9 }).length;
console.log(`page: ${(sum / 1000).toFixed(1)} kB gzipped`);
if (sum > largestGzip) {
  console.error(`page: more than ${largestGzip / 1000} kB gzipped`);
  process.exit(1);
}
