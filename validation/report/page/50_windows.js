// The windows of the trial as a strip of bars, and the worst of all trials as a list of links.

const kWorst = 12;

/** The worst windows of the model that is shown, over all trials. */
function worstWindows() {
  worstWindows.of = worstWindows.of || [];
  if (!worstWindows.of[state.model]) {
    const all = report.trials.flatMap((trial, t) => trial.windows.map((at, index) => ({
      trial: t, index, from: at.from, to: at.to, ratio: at.ratio[state.model],
      channel: trial.channels[argmax(at.channels[state.model])].sensor,
    })));
    worstWindows.of[state.model] = all.sort((a, b) => b.ratio - a.ratio).slice(0, kWorst);
  }
  return worstWindows.of[state.model];
}

function argmax(values) { return values.reduce((best, value, i) => (value > values[best] ? i : best), 0); }

function isShown(worst) { return state.window !== null && state.window === report.trials[worst.trial].windows[worst.index]; }

function drawWorst() {
  const several = report.trials.length > 1;
  const rows = worstWindows().map((worst, i) => make("tr", { "aria-current": isShown(worst) ? "true" : false },
    make("td", {}, String(i + 1)),
    make("td", {}, make("button", { "data-worst": i, click: () => showWindow(worst.trial, worst.index, false) },
      `${worst.from.toFixed(2)}–${worst.to.toFixed(2)} s`)),
    several ? make("td", {}, report.trials[worst.trial].name) : null,
    make("td", {}, worst.channel),
    make("td", { class: "number" }, ratio(worst.ratio))));
  $("worst").replaceChildren(
    make("thead", {}, make("tr", {}, make("th", {}, ""), make("th", {}, "window"), several ? make("th", {}, "trial") : null,
      make("th", {}, "worst channel"), make("th", { class: "number", title: "in units of the floor, over all channels" }, "error"))),
    make("tbody", {}, rows));
}

/** The next (or, with -1, the last) of the worst windows. */
function stepWorst(direction) {
  const list = worstWindows();
  const now = list.findIndex(isShown);
  const next = list[now < 0 ? (direction > 0 ? 0 : list.length - 1) : (now + direction + list.length) % list.length];
  showWindow(next.trial, next.index, !isInView($("charts")));
}

/** Error of every window over time, logarithmic; a bar leads to its window. */
function drawStrip() {
  const box = $("strip");
  const trial = trialShown();
  const width = Math.max(300, box.clientWidth);
  const height = 76;
  const [from, to] = wholeRange();
  const left = kAxisWidth + 18;
  const right = width - 10;
  const x = (t) => left + (right - left) * (t - from) / (to - from);
  const all = report.trials.flatMap((one) => one.windows.flatMap((at) => at.ratio));
  const low = Math.min(0.5, ...[all.reduce((a, b) => Math.min(a, b), 1)]);
  const high = Math.max(2, all.reduce((a, b) => Math.max(a, b), 1)) * 1.1;
  const y = logScale(low, high, height - 6, 6);
  const svg = makeSvg("svg", { width, height, role: "img", "aria-label": "Error of each window over time, in units of the floor" });
  const shown = state.range || [from, to];
  if (state.range) svg.append(makeSvg("rect", { class: "shown", x: x(Math.max(from, shown[0])), y: 0, height, width: Math.max(2, x(Math.min(to, shown[1])) - x(Math.max(from, shown[0]))) }));
  trial.windows.forEach((at, index) => {
    const value = at.ratio[state.model];
    svg.append(makeSvg("rect", { class: `bar ${modelClass(state.model)}-fill`, x: x(at.from) + 0.5, width: Math.max(1, x(at.to) - x(at.from) - 1), y: y(value),
      height: Math.max(1, height - 6 - y(value)), "data-window": index, click: () => showWindow(state.trial, index, false) },
    makeSvg("title", {}, `${at.from.toFixed(2)}–${at.to.toFixed(2)} s: ${ratio(value)} times the floor`)));
  });
  svg.append(makeSvg("line", { class: "floor", "stroke-width": 1.4, x1: left, x2: right, y1: y(1), y2: y(1) }),
    makeSvg("text", { class: "soft", x: left - 6, y: y(1) + 4, "text-anchor": "end" }, "floor"));
  let below = y(1);
  for (const tick of logTicks(low, high).filter((value) => value > 1.6 && Number.isInteger(Math.log10(value)))) {
    if (below - y(tick) < 13) continue;
    below = y(tick);
    svg.append(makeSvg("text", { class: "soft", x: left - 6, y: y(tick) + 4, "text-anchor": "end" }, number(tick)));
  }
  box.replaceChildren(svg);
}
