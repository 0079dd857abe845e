// SPDX-License-Identifier: Apache-2.0
// node mock/screenshots.mjs PLUMB CELL FOLDER: pictures of the workbench for the documents; see scripts/screenshots.
// PLUMB may be mock/server.mjs.
import { spawn } from "node:child_process";
import { statSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";

const [bin, cell, folder] = process.argv.slice(2);
const largest = 150_000; // bytes of one picture
const words = ["-C", cell, "serve", "--port", "0"];
const server = bin.endsWith(".mjs") ? spawn("node", [bin, ...words]) : spawn(bin, words);
const url = await new Promise((done, fail) => {
  let said = "";
  server.stdout.on("data", (data) => {
    said += data;
    const found = /http:\/\/\S+/.exec(said);
    if (found) done(found[0]);
  });
  server.on("exit", (code) => fail(new Error(`${bin} serve ended with ${code}`)));
});
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--headless", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--no-first-run"],
});

let small = true;
async function take(tab, name) {
  const path = join(folder, `${name}.png`);
  await tab.evaluate(() => document.activeElement?.blur());
  await tab.mouse.move(0, 0);
  await tab.screenshot({ path });
  small &&= statSync(path).size < largest;
}

const go = async (tab, screen) => {
  await tab.evaluate((name) => { location.hash = name; }, screen);
  await tab.waitForSelector(`.rail a[href="#${screen}"][aria-current="page"]`);
};

for (const scheme of ["light", "dark"]) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 860 }, colorScheme: scheme });
  const tab = await context.newPage();
  tab.setDefaultTimeout(60000);
  await tab.goto(url);
  await go(tab, "see");
  await tab.waitForSelector("#picked");
  await tab.waitForSelector(".see .figure svg");
  await tab.waitForTimeout(1500);
  await take(tab, `see-${scheme}`);
  await go(tab, "learn");
  if (scheme === "light") await tab.click("#learn");
  await tab.waitForSelector(".candidate .figure svg");
  await take(tab, `learn-${scheme}`);
  await go(tab, "improve");
  await tab.waitForSelector('[data-figure="waterfall"] svg');
  if (scheme === "dark") {
    await take(tab, "improve-dark");
    await context.close();
    continue;
  }
  const before = await tab.textContent("#held-out");
  await go(tab, "learn");
  await tab.click("#add-first");
  await tab.waitForFunction((was) => document.getElementById("held-out")?.textContent !== was, before);
  await go(tab, "improve");
  await tab.waitForSelector('[data-figure="waterfall"] svg');
  await tab.waitForTimeout(500);
  await take(tab, "improve-light");
  await context.close();
}
await browser.close();
server.kill("SIGINT");
if (!small) {
  console.error(`screenshots: a picture is larger than ${largest / 1000} kB`);
  process.exit(1);
}
