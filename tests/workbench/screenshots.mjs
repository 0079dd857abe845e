// SPDX-License-Identifier: Apache-2.0
// node tests/workbench/screenshots.mjs PLUMB TWIN FOLDER: pictures of the workbench for the documents, light and dark.
// TWIN: a measured and fitted cell of plumb-twin that speaks Modbus on this machine; see scripts/screenshots.
import { writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { browserFor, serve } from "./browser.mjs";

const [program, cell, folder] = process.argv.slice(2);
const bin = resolve(program);
const kMost = 700_000; // bytes of all pictures together
const kStations = 12;  // that the twin has visited when its picture is taken
const { launch } = browserFor("screenshots", bin);
const browser = await launch();
const server = await serve(bin, cell);
const maker = await browser.newPage();
let total = 0;

/** A picture as WebP, a third of the bytes of PNG. */
async function take(tab, name) {
  await tab.evaluate(() => { document.activeElement?.blur(); scrollTo(0, 0); });
  await tab.mouse.move(0, 0);
  const png = (await tab.screenshot()).toString("base64");
  const webp = await maker.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    canvas.getContext("2d").drawImage(image, 0, 0);
    return canvas.toDataURL("image/webp", 0.85).split(",")[1];
  }, png);
  const bytes = Buffer.from(webp, "base64");
  total += bytes.length;
  writeFileSync(join(folder, `${name}.webp`), bytes);
}

const go = async (tab, screen) => {
  await tab.evaluate((name) => { location.hash = name; }, screen);
  await tab.waitForSelector(`.rail a[href="#${screen}"][aria-current="page"]`);
};

/** The same screen in both themes. */
async function both(tab, name) {
  for (const scheme of ["light", "dark"]) {
    await tab.emulateMedia({ colorScheme: scheme });
    await tab.waitForTimeout(1500);
    await take(tab, `${name}-${scheme}`);
  }
}

const tab = await browser.newPage({ viewport: { width: 1280, height: 860 } });
tab.setDefaultTimeout(60000);
await tab.goto(server.url);
await go(tab, "see");
await tab.waitForSelector("#picked");
await tab.waitForSelector(".see .figure svg");
await both(tab, "see");
await go(tab, "learn");
await tab.click("#learn");
await tab.waitForSelector(".candidate .figure svg");
await both(tab, "learn");
await tab.click("#add-first");
await tab.waitForSelector(".change");
await go(tab, "improve");
await tab.waitForSelector('[data-figure="waterfall"] svg');
await both(tab, "improve");
await go(tab, "ship");
await tab.selectOption("#mode", "full");
await tab.click("#deploy");
await tab.waitForSelector("#deployed-mode");
await go(tab, "monitor");
await tab.click("#start-demonstration");
await tab.waitForFunction((n) => Number(/Mean of(\d+)/.exec(document.getElementById("true-error")?.textContent ?? "")?.[1] ?? 0) >= n, kStations);
await both(tab, "monitor");
await tab.click("#stop-demonstration");
await browser.close();
await server.stop();
if (total > kMost) {
  console.error(`screenshots: ${total} bytes are more than ${kMost}`);
  process.exit(1);
}
