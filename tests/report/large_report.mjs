// How large a report is and how long it takes to open, from navigation until everything is drawn.
// Usage: node large_report.mjs PLAYWRIGHT CHROMIUM PAGE
import { createRequire } from "node:module";
import { statSync } from "node:fs";
import path from "node:path";

const [playwright, executablePath, file] = process.argv.slice(2).map((name) => path.resolve(name));
const { chromium } = createRequire(import.meta.url)(playwright);
const browser = await chromium.launch({ executablePath, args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
  "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"] });
const times = [];
for (let i = 0; i < 5; ++i) {
  const page = await browser.newPage({ viewport: { width: 1360, height: 900 } });
  const start = performance.now();
  await page.goto("file://" + file);
  await page.waitForSelector("html[data-ready]");
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  times.push(performance.now() - start);
  if (i === 4) await page.screenshot({ path: file.replace(/html$/, "png") });
  await page.close();
}
await browser.close();
const megabytes = statSync(file).size / 1e6;
const slowest = Math.max(...times);
console.log(`${megabytes.toFixed(2)} MB; opens in ${times.map((t) => (t / 1000).toFixed(2)).join(", ")} s`);
process.exit(megabytes < 15 && slowest < 3000 ? 0 : 1);
