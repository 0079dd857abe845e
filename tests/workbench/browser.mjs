// SPDX-License-Identifier: Apache-2.0
// A real browser and a running server, for what looks at the workbench as its users do.
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

export const here = dirname(fileURLToPath(import.meta.url));
const page = join(here, "../../offline/workbench/page");
const chromium = process.env.CHROMIUM ?? "/usr/bin/chromium";
const kArguments = ["--headless", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-background-networking",
  "--disable-component-update", "--disable-sync", "--no-first-run"];

/** Names what is missing, and ends with 77: nothing was tested. */
function leave(who, missing, remedy) {
  console.log(`${who}: ${missing}: nothing was tested (${remedy})`);
  process.exit(77);
}

/** {launch, require}: `launch(more words)` starts the browser; `require` finds what the page is built with. `bin` is plumb. */
export function browserFor(who, bin) {
  if (!existsSync(chromium)) leave(who, `there is no browser ${chromium}`, "apt install chromium");
  const installed = [page, join(dirname(bin), "../offline/workbench/page")]
    .find((folder) => existsSync(join(folder, "node_modules/playwright-core")));
  if (!installed) leave(who, "playwright-core is missing", "npm ci in offline/workbench/page");
  const require = createRequire(join(installed, "package.json"));
  const { chromium: browsers } = require("playwright-core");
  return { require, launch: (...more) => browsers.launch({ executablePath: chromium, args: [...kArguments, ...more] }) };
}

/** plumb serve on a cell: {url, child, stop}; stop() ends when it has ended. BIN may be the page's stand-in, a .mjs. */
export async function serve(bin, cell, port = 0) {
  const words = ["-C", cell, "serve", "--port", String(port)];
  const child = bin.endsWith(".mjs") ? spawn("node", [bin, ...words]) : spawn(bin, words);
  process.on("exit", () => child.kill());
  let said = "";
  child.stderr.on("data", (data) => { said += data; });
  const url = await new Promise((done, fail) => {
    let out = "";
    child.stdout.on("data", (data) => {
      out += data;
      const found = /http:\/\/\S+/.exec(out);
      if (found) done(found[0]);
    });
    child.on("exit", (code) => fail(new Error(`the server ended with ${code}: ${said}`)));
  });
  const stop = () => new Promise((done) => {
    child.on("exit", done);
    child.kill("SIGINT");
  });
  return { url, child, stop };
}
