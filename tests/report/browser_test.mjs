// The report in headless Chromium: zoom, legend, worst windows, before and after, keys, printing, nothing on the console.
// Usage: node browser_test.mjs PLAYWRIGHT CHROMIUM FOLDER; FOLDER holds report.html and compared.html, screenshots go there.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import path from "node:path";

const [playwright, executablePath, folder] = process.argv.slice(2).map((name) => path.resolve(name));
const { chromium } = createRequire(import.meta.url)(playwright);

const browser = await chromium.launch({ executablePath, args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
  "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"] });

/** Opens a page from disk; whatever it says on the console, or wants from elsewhere, is a fault. */
async function open(name, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1360, height: 900 }, ...options });
  const faults = [];
  page.on("console", (message) => faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("request", (request) => { if (!request.url().startsWith("file:")) faults.push(request.url()); });
  await page.goto("file://" + path.join(folder, name));
  await page.waitForSelector("html[data-ready]");
  return { page, faults };
}

const text = (page, selector) => page.locator(selector).first().innerText();
const range = async (page) => (await text(page, "#range")).match(/[\d.]+/g).map(Number);
/** What a canvas shows, as a picture. */
const drawn = async (page, selector) => (await page.locator(selector).first().screenshot({ animations: "disabled" })).toString("base64");

const tests = {
  async "the head says what was found"(page) {
    assert.match(await text(page, "#summary"), /^Missing: quadratic at drive\./);
    assert.equal(await page.locator("#ladder-picture .held").count() >= 3, true);
    assert.match(await text(page, "#ladder-picture"), /floor/);
  },
  async "every channel has a chart and its residual"(page) {
    const channels = await page.locator("#charts .chart").count();
    assert.ok(channels >= 2);
    assert.equal(await page.locator("#charts canvas").count(), 2 * channels);
  },
  async "whole trials: with the effect the motion needs the force that was commanded"(page) {
    const rows = await page.locator("#whole-trials tbody tr").evaluateAll((all) => all.map((row) => [...row.querySelectorAll("td")].map((cell) => Number(cell.innerText))));
    assert.equal(rows.length, await page.locator("#ladder-picture .held").count() - 1);  // one diamond is the key's
    assert.equal(rows[0].length, 3);  // trials, one motor
    for (const c of [0, 1, 2]) assert.ok(rows[rows.length - 1][c] < 0.8 * rows[0][c], `${rows}`);
  },
  async "the error over the horizon falls with the effect"(page) {
    const rows = () => page.locator("#horizons tbody tr").evaluateAll((all) => all.map((row) => [...row.querySelectorAll("td.number")].map((cell) => Number(cell.innerText))));
    await page.keyboard.press("b");
    const one = await rows();
    await page.keyboard.press("b");
    const other = await rows();
    assert.ok(one.length > 0 && one.length === other.length);
    const sum = (table) => table.flat().filter((value) => Number.isFinite(value)).reduce((a, b) => a + b, 0);
    assert.ok(Math.max(sum(one), sum(other)) > 2 * Math.min(sum(one), sum(other)));
  },

  async "dragging zooms all channels, a double click shows the whole trial"(page) {
    const [from, to] = await range(page);
    await page.locator("#time").evaluate((section) => section.scrollIntoView());
    const box = await page.locator("#charts .u-over").first().boundingBox();
    await page.mouse.move(box.x + 0.25 * box.width, box.y + 40);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.5 * box.width, box.y + 60, { steps: 5 });
    await page.mouse.up();
    await page.waitForFunction((whole) => document.getElementById("range").textContent !== whole, `${from.toFixed(3)} s to ${to.toFixed(3)} s`);
    const [a, b] = await range(page);
    assert.ok(Math.abs(a - (from + 0.25 * (to - from))) < 0.02 * (to - from), `${a}`);
    assert.ok(Math.abs(b - (from + 0.5 * (to - from))) < 0.02 * (to - from), `${b}`);
    const scales = await page.evaluate(() => [...document.querySelectorAll("#charts .uplot")].map((one) => one.dataset.range));
    assert.equal(new Set(scales).size, 1, "all charts show the same stretch");
    assert.equal(scales[0], `${a.toFixed(3)} ${b.toFixed(3)}`);
    await page.mouse.dblclick(box.x + 0.5 * box.width, box.y + 40);
    await page.waitForFunction((whole) => document.getElementById("range").textContent === whole, `${from.toFixed(3)} s to ${to.toFixed(3)} s`);
  },
  async "the legend hides a curve and brings it back"(page) {
    await page.mouse.move(5, 5);
    const before = await drawn(page, "#charts canvas");
    const entry = page.locator("#charts .u-legend").first().locator("tr").nth(1).locator("th");
    await entry.click();
    await page.mouse.move(5, 5);
    await page.waitForTimeout(100);
    assert.notEqual(await drawn(page, "#charts canvas"), before);
    await entry.focus();
    await entry.press("Enter");
    await entry.blur();
    await page.mouse.move(5, 5);
    await page.waitForTimeout(100);
    assert.equal(await drawn(page, "#charts canvas"), before);
  },
  async "a worst window is one click away"(page) {
    const row = page.locator("#worst tbody tr").first();
    const [from, to] = (await row.locator("button").innerText()).match(/[\d.]+/g).map(Number);
    await row.locator("button").click();
    const [a, b] = await range(page);
    assert.ok(a <= from + 0.005 && a > from - 0.2 && b >= to - 0.005 && b < to + 0.2, `${a} ${b} for ${from} ${to}`);
    assert.equal(await page.locator("#worst tr[aria-current=true]").count(), 1);
    const trial = await page.locator("#trial option:checked").innerText();
    assert.ok(trial.startsWith(await row.locator("td").nth(2).innerText()));
  },
  async "before and after are one switch apart"(page) {
    const rms = async () => Number((await text(page, "#charts .chart h3 small")).match(/rms, ([\d.,]+)/)[1].replace(",", ""));
    const heat = async () => Math.max(...(await page.locator("#heat button").allInnerTexts()).map((t) => Number(t.replace(",", ""))));
    assert.equal(await page.locator("#switch [aria-checked=true]").getAttribute("data-model"), "0");
    const [rmsBefore, heatBefore] = [await rms(), await heat()];
    await page.locator("#switch [data-model='1']").click();
    assert.ok(await rms() < 0.8 * rmsBefore);
    assert.ok(await heat() < 0.8 * heatBefore);
    assert.ok(await heat() < 2, "with the hidden effect the error is at the floor");
    await page.keyboard.press("b");
    assert.equal(await rms(), rmsBefore);
  },
  async "keys do what the tools do"(page) {
    await page.locator("body").press("0");
    const [from, to] = await range(page);
    await page.locator("body").press("+");
    const [a, b] = await range(page);
    assert.ok(Math.abs((b - a) - 0.5 * (to - from)) < 0.01);
    await page.locator("body").press("ArrowRight");
    assert.ok((await range(page))[0] > a);
    await page.locator("body").press("n");
    assert.equal(await page.locator("#worst tr[aria-current=true] td").first().innerText(), "1");
    await page.locator("body").press("n");
    assert.equal(await page.locator("#worst tr[aria-current=true] td").first().innerText(), "2");
    await page.locator("body").press("t");
    assert.equal(await page.locator("#trial").evaluate((select) => select.selectedIndex) >= 0, true);
  },
  async "a cell of the heat map leads to its window"(page) {
    await page.locator("body").press("0");
    const whole = await text(page, "#range");
    await page.locator("#heat button").last().click();
    assert.notEqual(await text(page, "#range"), whole);
  },
  async "evidence: the named effect first, with an interval"(page) {
    assert.match(await text(page, "#ranking tbody tr"), /^quadratic at drive/);
    assert.ok(await page.locator("#ranking .interval").count() > 0);
    assert.match(await text(page, ".finding"), /drag/);
  },
  async "rivals are joined to it"(page) {
    const joined = await page.locator("#ranking tr.joined").allInnerTexts();
    assert.equal(joined.length, 2);
    assert.match(joined[1], /^quadratic at shoulder\s*rival/);
  },
  async "forces are compared below a frequency that stands beside them"(page) {
    const forces = await page.locator("#forces > p:not(.note)").allInnerTexts();
    assert.ok(forces.length > 0);
    for (const force of forces) assert.match(force, /of the recorded force below \d[\d.]* Hz; it /);
  },
  async "what is needed to repeat it"(page) {
    assert.match(await text(page, "#repetition pre"), /^plumbline report trials\/chirp trials\/steps/);
    const hashes = await page.locator("#repetition .hash").allInnerTexts();
    assert.ok(hashes.length >= 9, `${hashes.length}`);
    for (const hash of hashes) assert.match(hash, /^[0-9a-f]{64}$/);
  },
  async "every section and heading has something to show"(page) {
    for (const section of await page.locator("main section").all()) {
      assert.ok((await section.innerText()).length > 60, await section.getAttribute("id"));
    }
    const html = await page.locator("main").innerText();
    assert.doesNotMatch(html, /undefined|NaN|\[object|\bnull\b/);
  },
};

let failed = 0;
async function run(name, page, faults, work) {
  try {
    await work(page);
    assert.deepEqual(faults, []);
    console.log("ok    ", name);
  } catch (error) {
    ++failed;
    console.log("FAILED", name, "\n", error.stack || error);
  }
  faults.length = 0;
}

const { page, faults } = await open("report.html");
for (const [name, work] of Object.entries(tests)) await run(name, page, faults, work);

/** A picture of the whole page, and nothing wider than the window. */
async function picture(page, name) {
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  assert.ok(wide <= 1, `${name}: ${wide} pixels too wide`);
  const file = path.join(folder, name + ".png");
  await page.screenshot({ path: file, fullPage: true });
  assert.ok(statSync(file).size > 50000, name);
}

for (const [name, options] of Object.entries({
  wide: { viewport: { width: 1600, height: 1000 } }, laptop: { viewport: { width: 1280, height: 800 } },
  narrow: { viewport: { width: 520, height: 900 } }, dark: { colorScheme: "dark" } })) {
  const opened = await open("report.html", options);
  await run(`a picture, ${name}`, opened.page, opened.faults, (one) => picture(one, name));
}
/** The same page with the channels of its trials the other way round. */
function reversed() {
  const page = readFileSync(path.join(folder, "report.html"), "utf8");
  return page.replace(/(id="report-data">)(.*?)(<\/script>)/s, (_, open_tag, data, close) => {
    const report = JSON.parse(data);
    for (const trial of report.trials) {
      trial.channels.reverse();
      for (const at of trial.windows) at.channels.forEach((channels) => channels.reverse());
    }
    return open_tag + JSON.stringify(report).replace(/</g, "\\u003c") + close;
  });
}
writeFileSync(path.join(folder, "reversed.html"), reversed());
for (const name of ["report.html", "reversed.html"]) {
  const opened = await open(name);
  await run(`the channel with the largest error comes first, whichever model is shown: ${name}`, opened.page, opened.faults, async (one) => {
    const names = () => one.locator("#charts .chart").evaluateAll((all) => all.map((chart) => chart.dataset.channel));
    const ratios = (await one.locator("#charts .chart h3 small").allInnerTexts()).map((t) => Number(t.match(/rms, ([\d.,]+)/)[1].replace(",", "")));
    assert.ok(ratios.length >= 2);
    assert.deepEqual(ratios, [...ratios].sort((a, b) => b - a));
    const before = await names();
    await one.keyboard.press("b");
    assert.deepEqual(await names(), before);
  });
}
const compared = await open("compared.html");
await run("a page without a diagnosis", compared.page, compared.faults, async (one) => {
  assert.match(await text(one, "#summary"), /^The model predicts the train motion/);
  assert.equal(await one.locator("#switch button").count(), 1);
  assert.doesNotMatch(await one.locator("body").innerText(), /undefined|NaN|\[object/);
  await picture(one, "compared");
});
const printed = await open("report.html");
await run("printing", printed.page, printed.faults, async (one) => {
  const file = path.join(folder, "report.pdf");
  await one.pdf({ path: file, format: "A4" });
  assert.ok(statSync(file).size > 50000);
});
await browser.close();
console.log(failed ? `${failed} failed` : "all passed");
process.exit(failed ? 1 : 0);
