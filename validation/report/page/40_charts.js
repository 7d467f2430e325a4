// Measured against predicted, and the residual below, for every channel of the trial that is shown.

const charts = [];       // all uPlot objects of the section; they share one time axis
const decoded = new Map();  // by "trial/channel/model": arrays ready to draw

const kAxisWidth = 68;

function timeOf(trial) {
  trial.at = trial.at || Array.from(floatsOf(trial.time));
  return trial.at;
}

/** Arrays of one channel, unpacked when they are first looked at. */
function curvesOf(t, c, m) {
  const key = `${t}/${c}/${m}`;
  if (!decoded.has(key)) {
    const trial = report.trials[t];
    const channel = trial.channels[c];
    decoded.set(key, {
      measured: unpack(channel.measured, trial.points),
      predicted: unpack(channel.models[m].predicted, trial.points),
      residual: unpack(channel.models[m].residual, trial.points),
    });
  }
  return decoded.get(key);
}

function axes(label, unit) {
  const common = {
    stroke: () => colour("soft"), font: "12px system-ui, 'DejaVu Sans', sans-serif", labelFont: "12px system-ui, 'DejaVu Sans', sans-serif",
    grid: { stroke: () => colour("grid"), width: 1 }, ticks: { stroke: () => colour("line"), width: 1, size: 4 },
    values: (u, ticks) => ticks.map((tick) => (tick === null ? "" : number(tick, 6))),
  };
  return [
    { ...common, size: 26, gap: 3, values: (u, ticks) => ticks.map((tick) => (tick === null ? "" : `${number(tick, 6)} ${unit}`)) },
    { ...common, size: kAxisWidth, label, labelSize: 18, gap: 3, space: 28 },
  ];
}

function line(label, name, more) {
  return { label, stroke: () => colour(name), width: 1.4, points: { show: false },
    value: (u, value) => (value === null || value === undefined ? "–" : number(value, 5)), ...more };
}

const timeSeries = { label: "time, s", value: (u, value) => (value === null ? "–" : value.toFixed(4)) };

/** Stretches in which any contact switch is closed. */
function stances(trial) {
  const open = new Set();
  const list = [];
  for (const event of trial.contact_events) {
    const before = open.size;
    event.kind === "touchdown" ? open.add(event.contact_switch) : open.delete(event.contact_switch);
    if (before === 0 && open.size > 0) list.push([event.time, Infinity]);
    if (before > 0 && open.size === 0) list[list.length - 1][1] = event.time;
    if (list.length === 0) list.push([-Infinity, event.time]);  // it began in stance
  }
  return list;
}

/** Behind the curves: alternate windows or stretches between events, the worst windows, events. */
function shade(u) {
  const { left, top, width, height } = u.bbox;
  const context = u.ctx;
  const x = (value) => Math.min(left + width, Math.max(left, u.valToPos(value, "x", true)));
  const paint = (from, to, fill) => {
    context.fillStyle = fill;
    context.fillRect(x(from), top, x(to) - x(from), height);
  };
  context.save();
  const trial = trialShown();
  const windows = trial.windows;
  const mean = (windows[windows.length - 1].to - windows[0].from) / windows.length;
  if (mean / (u.scales.x.max - u.scales.x.min) * width > 8 * devicePixelRatio) {
    windows.forEach((at, i) => { if (i % 2) paint(at.from, at.to, colour("window")); });
  }
  stances(trial).forEach(([from, to]) => paint(from, to, colour("stance")));
  if (state.window) paint(state.window.from, state.window.to, colour("worst"));
  context.fillStyle = colour("rival");
  for (const worst of worstWindows()) {
    if (worst.trial !== state.trial || worst.to < u.scales.x.min || worst.from > u.scales.x.max) continue;
    context.fillRect(x(worst.from), top, x(worst.to) - x(worst.from) - devicePixelRatio, 2.5 * devicePixelRatio);
  }
  context.strokeStyle = colour("event");
  context.lineWidth = 1.5 * devicePixelRatio;
  context.setLineDash([6 * devicePixelRatio, 3 * devicePixelRatio]);
  for (const event of trial.events) {
    if (event < u.scales.x.min || event > u.scales.x.max) continue;
    context.beginPath();
    context.moveTo(x(event), top);
    context.lineTo(x(event), top + height);
    context.stroke();
  }
  context.restore();
}

/** The floor as a band about zero. */
function shadeFloor(floor) {
  return (u) => {
    const { left, top, width, height } = u.bbox;
    const y = (value) => Math.min(top + height, Math.max(top, u.valToPos(value, "y", true)));
    u.ctx.save();
    u.ctx.fillStyle = colour("band");
    u.ctx.fillRect(left, y(floor), width, Math.max(devicePixelRatio, y(-floor) - y(floor)));
    u.ctx.restore();
  };
}

/** A zoom of one chart becomes the zoom of all. */
function link(u, key) {
  if (key !== "x") return;
  const [from, to] = wholeRange();
  const { min, max } = u.scales.x;
  u.root.dataset.range = `${min.toFixed(3)} ${max.toFixed(3)}`;
  const nearly = 0.01 * (to - from);  // thinned points begin and end a little inside the trial
  const whole = min <= from + nearly && max >= to - nearly;
  const now = state.range;
  if (whole ? now === null : now && Math.abs(now[0] - min) + Math.abs(now[1] - max) < 1e-12) return;
  showRange(whole ? null : [min, max]);
}

/** `least`: what must be seen in any case, so that a channel at rest is not blown up to its last digit. */
function chart(where, height, label, least, series, data, behind) {
  const u = new uPlot({
    width: Math.max(300, where.clientWidth), height, padding: [8, 10, 0, 0],
    cursor: { sync: { key: "time", scales: ["x", null], filters: { pub: (type) => type === "mousemove" || type === "mouseleave" } }, drag: { x: true, y: false }, points: { size: 6 } },
    scales: { x: { time: false }, y: { range: (self, min, max) => padded(min, max, least) } },
    axes: axes(label, "s"), series: [timeSeries, ...series],
    hooks: { drawClear: [shade, ...behind], setScale: [link] },
  }, data, where);
  reachLegend(u);
  charts.push(u);
  return u;
}

/** Entries of a legend answer to keys as they do to clicks. */
function reachLegend(u) {
  for (const entry of u.root.querySelectorAll(".u-legend .u-series:not(:first-child) th")) {
    entry.tabIndex = 0;
    entry.setAttribute("role", "button");
    entry.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      entry.click();
    });
  }
}

/** A little room around the values, and never less than `least` ({low, high}, or a span about the middle). */
function padded(min, max, least) {
  let [low, high] = min === null || min === undefined ? [0, 0] : [min, max];
  if (least.span) {
    const room = Math.max(0, least.span - (high - low)) / 2;
    [low, high] = [low - room, high + room];
  } else {
    [low, high] = [Math.min(low, least.low), Math.max(high, least.high)];
  }
  const room = 0.06 * (high - low);
  return [low - room, high + room];
}

/** Channels of the trial that is shown, the largest error of the first model first: a switch of models moves none. */
function channelOrder() {
  const errors = trialShown().channels.map((channel) => channel.models[0].ratio);
  return errors.map((_, c) => c).sort((a, b) => errors[b] - errors[a]);
}

/** The two charts of one channel. */
function addChannel(box, c) {
  const trial = trialShown();
  const channel = trial.channels[c];
  const curves = curvesOf(state.trial, c, state.model);
  const one = channel.models[state.model];
  const look = modelClass(state.model);
  const dash = look === "after" ? [7, 3] : undefined;
  const figure = make("div", { class: "chart", "data-channel": channel.sensor });
  figure.append(make("h3", {}, channel.sensor,
    make("small", {}, `residual ${withUnit(one.rms, channel.unit, 3)} rms, ${ratio(one.ratio)} times the floor of ${withUnit(channel.floor, channel.unit, 3)}`)));
  box.append(figure);
  chart(figure, 190, channel.unit, { span: 8 * channel.floor },
    [line("measured", "measured", { width: 2.4 }), line("predicted", look, { dash, width: 1.4 })],
    [timeOf(trial), curves.measured, curves.predicted], []);
  chart(figure, 128, "residual, " + channel.unit, { low: -1.6 * channel.floor, high: 1.6 * channel.floor }, [line("residual", look, { width: 1.1 })],
    [timeOf(trial), curves.residual], [shadeFloor(channel.floor)]);
}

/** The temperature of a motor under the last model, which no sensor shows; whichever model is drawn. */
function addTemperature(box, n) {
  const trial = trialShown();
  const hidden = trial.temperatures[n];
  const key = `${state.trial}/temperature/${n}`;
  if (!decoded.has(key)) decoded.set(key, unpack(hidden.values, trial.points));
  const values = decoded.get(key);
  const [low, high] = values.reduce(([a, b], value) => [Math.min(a, value), Math.max(b, value)], [Infinity, -Infinity]);
  const figure = make("div", { class: "chart", "data-temperature": hidden.state });
  figure.append(make("h3", {}, hidden.state.replace(/_/g, " "),
    make("small", {}, `under ${report.drawn[report.drawn.length - 1]}, not measured: from the recorded commands, cold at first, ${withUnit(low, hidden.unit, 4)} to ${withUnit(high, hidden.unit, 4)}`)));
  box.append(figure);
  chart(figure, 150, hidden.unit, { span: 1 }, [line("temperature", modelClass(report.drawn.length - 1), { width: 1.4 })], [timeOf(trial), values], []);
}

function drawCharts() {
  while (charts.length) charts.pop().destroy();
  const box = $("charts");
  box.replaceChildren();
  channelOrder().forEach((c) => addChannel(box, c));
  trialShown().temperatures.forEach((_, n) => addTemperature(box, n));
  box.append(...trialShown().switches.map((one) => make("p", { class: "note" },
    `Contact switch ${one.sensor}: touchdown and lift-off are predicted to ${number(1e3 * one.models[state.model].rms)} ms rms, ${ratio(one.models[state.model].ratio)} times the floor of ${number(1e3 * one.floor)} ms.`)));
  applyRange();
}

function applyRange() {
  const [from, to] = state.range || wholeRange();
  for (const u of charts) u.setScale("x", { min: from, max: to });
  $("range").textContent = `${from.toFixed(3)} s to ${to.toFixed(3)} s`;
}

function redrawCharts() { for (const u of charts) u.redraw(false, true); }

function resizeCharts(width) {
  for (const u of charts) {
    u.setSize({ width: width || Math.max(300, u.root.parentElement.clientWidth), height: u.height });
  }
}

/** Zooms by a factor about the middle, or moves by a share of what is shown. */
function moveRange(factor, share) {
  const [first, last] = wholeRange();
  const [from, to] = state.range || [first, last];
  const length = Math.min(last - first, (to - from) * factor);
  const middle = 0.5 * (from + to) + share * (to - from);
  const start = Math.min(Math.max(first, middle - 0.5 * length), last - length);
  showRange(length >= (last - first) * 0.999 ? null : [start, start + length]);
}
