// Pictures of a report for the README. Usage: node pictures.mjs PLAYWRIGHT CHROMIUM PAGE FOLDER
import { createRequire } from "node:module";
import path from "node:path";

const [playwright, executablePath, file, folder] = process.argv.slice(2).map((name) => path.resolve(name));
const { chromium } = createRequire(import.meta.url)(playwright);
const browser = await chromium.launch({ executablePath, args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
  "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"] });

async function open(width, height) {
  const page = await browser.newPage({ viewport: { width, height }, deviceScaleFactor: 1.25 });
  await page.goto("file://" + file);
  await page.waitForSelector("html[data-ready]");
  return page;
}

const narrow = await open(860, 700);
await narrow.locator("#ladder-picture").screenshot({ path: path.join(folder, "ladder.png") });
const wide = await open(1180, 1120);
await wide.locator("#worst tr", { hasText: "mimo" }).locator("button").first().click();
await wide.mouse.move(5, 5);  // nothing is pointed at
await wide.locator("#time").evaluate((section) => section.scrollIntoView());
await wide.screenshot({ path: path.join(folder, "report.png") });
await browser.close();
