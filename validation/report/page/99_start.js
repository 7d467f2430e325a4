// The head of the page, the switch, the keys, and what is drawn again when.

function drawHead() {
  const scores = report.ladder;
  const first = scores[0], last = scores[scores.length - 1];
  const windows = report.trials.reduce((sum, trial) => sum + trial.windows.length, 0);
  const seconds = report.trials.reduce((sum, trial) => sum + trial.samples * trial.period, 0);
  const roles = ["train", "held-out"].map((role) => `${report.trials.filter((trial) => trial.role === role).length} ${role}`);
  $("summary").textContent = report.diagnosis ? report.diagnosis.summary : comparedOnly(first, last);
  const facts = [["trials", `${report.trials.length} (${roles.join(", ")})`], ["recorded", `${number(seconds, 3)} s in ${windows} windows`], ["model", report.model]];
  $("facts").replaceChildren(...facts.map(([name, value]) => make("div", {}, make("dt", {}, name), make("dd", {}, value))));
}

function comparedOnly(first, last) {
  const key = last.held_out !== null ? "held_out" : "train";
  const role = key === "train" ? "train" : "held-out";
  const now = `The model predicts the ${role} motion to ${ratio(last[key])} times what the sensors alone would leave.`;
  return first === last ? now : `${now} The model that it stands on, ${first.name}, leaves ${ratio(first[key])} times as much as they do.`;
}

function drawSwitch() {
  const box = $("switch");
  const several = report.drawn.length > 1;
  box.replaceChildren(...report.drawn.map((name, m) => make("button", { role: "radio", "aria-checked": String(m === state.model), "data-model": m, title: name, click: () => showModel(m) },
    make("span", { class: "mark " + modelClass(m) }), several ? (m === 0 ? "Before" : "After") : "Model", make("small", {}, name))));
}

function drawTrialChoice() {
  $("trial").replaceChildren(...report.trials.map((trial, t) => make("option", { value: t, selected: t === state.trial ? "" : false }, `${trial.name} (${trial.role})`)));
  $("trial").value = String(state.trial);
}

const keys = [
  ["b", "before / after", () => showModel(1 - state.model)],
  ["n", "next worst window", () => stepWorst(1)],
  ["p", "previous worst window", () => stepWorst(-1)],
  ["t", "next trial", () => showTrial((state.trial + 1) % report.trials.length)],
  ["+", "zoom in", () => moveRange(0.5, 0)],
  ["-", "zoom out", () => moveRange(2, 0)],
  ["ArrowLeft", "earlier", () => moveRange(1, -0.25)],
  ["ArrowRight", "later", () => moveRange(1, 0.25)],
  ["0", "the whole trial", () => showRange(null)],
];

function drawTools() {
  const names = { ArrowLeft: "←", ArrowRight: "→", "-": "−" };
  $("keys").replaceChildren(...keys.flatMap(([key, what]) => [make("dt", {}, make("kbd", {}, names[key] || key)), make("dd", {}, what)]));
  const button = (key, text) => {
    const [, what, work] = keys.find((one) => one[0] === key);
    return make("button", { title: what, "aria-label": what, "data-zoom": key, click: work }, text);
  };
  $("zoom-tools").replaceChildren(button("ArrowLeft", "←"), button("-", "−"), button("+", "+"), button("ArrowRight", "→"), button("0", "whole trial"));
  $("trial").addEventListener("change", (event) => showTrial(Number(event.target.value)));
}

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName)) return;
  const key = keys.find(([name]) => name === event.key || (name === "+" && event.key === "="));
  if (!key) return;
  event.preventDefault();
  key[2]();
}

function drawFixed() {
  drawLadder();
  drawRanking();
}

/** Paper is white and as wide as it is, whatever the screen was. */
function printing(begins) {
  const root = document.documentElement;
  begins ? root.setAttribute("data-print", "") : root.removeAttribute("data-print");
  const width = begins ? 660 : 0;
  document.body.style.width = begins ? width + "px" : "";
  drawFixed();
  drawStrip();
  resizeCharts(width);
  resizeSpectra(begins ? 320 : 0);
  redrawCharts();
  redrawSpectra();
}

function start() {
  drawHead();
  drawTools();
  drawSwitch();
  drawTrialChoice();
  for (const draw of [drawLadder, drawWholeTrials, drawFindings, drawRanking, drawLeads, drawEstimates, drawCorrelation, drawUntold, drawValues, drawRepetition]) draw();
  const drawTrial = () => { drawTrialChoice(); drawCharts(); drawStrip(); drawWorst(); drawSpectra(); drawForces(); };
  drawTrial();
  drawHeat();
  drawHorizons();
  drawDefects();
  on("trial", drawTrial);
  on("model", () => { drawSwitch(); drawCharts(); drawStrip(); drawWorst(); drawHeat(); drawHorizons(); drawDefects(); drawForces(); });
  on("range", () => { applyRange(); drawStrip(); drawWorst(); });
  window.addEventListener("resize", onceAFrame(() => { drawFixed(); drawStrip(); resizeCharts(0); resizeSpectra(0); }));
  window.addEventListener("beforeprint", () => printing(true));
  window.addEventListener("afterprint", () => printing(false));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { redrawCharts(); redrawSpectra(); });
  document.addEventListener("keydown", onKey);
  document.documentElement.setAttribute("data-ready", "");
}
