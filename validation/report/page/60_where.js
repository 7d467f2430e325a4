// Where the error lives: channel by phase, and frequency.

function allHeat() {
  return report.trials.flatMap((trial) => trial.channels.flatMap((channel) => channel.models.flatMap((one) => one.heat.map((cell) => cell[0]))));
}

/** Every phase that any channel has, group by group; trials with events bring columns of their own. */
function phaseColumns() {
  const columns = [];
  for (const trial of report.trials) {
    for (const [group, name] of trial.channels[0].phases) {
      if (!columns.some((column) => column.group === group && column.name === name)) columns.push({ group, name });
    }
  }
  const order = [...new Set(columns.map((column) => column.group))];
  return columns.sort((a, b) => order.indexOf(a.group) - order.indexOf(b.group));
}

function drawHeat() {
  const columns = phaseColumns();
  const groups = [...new Set(columns.map((column) => column.group))];
  const most = Math.max(2, allHeat().reduce((a, b) => Math.max(a, b), 1));
  const shareOf = logScale(1, most, 0, 100);
  const firstOf = (column) => columns.find((other) => other.group === column.group) === column;
  const head = [
    make("tr", {}, make("td", {}), groups.map((group) => make("th", { class: "group", scope: "colgroup", colspan: columns.filter((column) => column.group === group).length }, group))),
    make("tr", {}, make("td", {}), columns.map((column) => make("th", { class: firstOf(column) ? "group" : false, scope: "col" }, column.name))),
  ];
  const cellOf = (t, channel, column) => {
    const i = channel.phases.findIndex(([group, name]) => group === column.group && name === column.name);
    if (i < 0 || channel.shares[i] === 0) return make("td", { class: firstOf(column) ? "group" : false });
    const [error, worst] = channel.models[state.model].heat[i];
    const depth = shareOf(error);
    return make("td", { class: firstOf(column) ? "group" : false }, make("button", {
      style: `--p:${depth.toFixed(1)}`, click: () => showWindow(t, worst, true),
      title: `${channel.sensor}, ${column.name}: ${ratio(error)} times the floor in ${percent(channel.shares[i])} of the samples`,
    }, ratio(error)));
  };
  const rows = report.trials.flatMap((trial, t) => [
    make("tr", { class: "trial" }, make("th", { colspan: columns.length + 1 }, `${trial.name} (${trial.role})`)),
    ...trial.channels.map((channel) => make("tr", {}, make("th", { scope: "row" }, channel.sensor), columns.map((column) => cellOf(t, channel, column)))),
  ]);
  const scrolled = $("heat").firstChild ? $("heat").firstChild.scrollTop : 0;
  $("heat").replaceChildren(make("div", { class: "screenful", tabindex: "0", role: "region", "aria-label": "Error by channel and phase" },
    make("table", {}, make("thead", {}, head), make("tbody", {}, rows))),
    make("p", { class: "scale" }, "floor", make("i", {}), `${ratio(most)} times the floor`));
  $("heat").firstChild.scrollTop = scrolled;
}

const spectra = [];

function drawSpectra() {
  while (spectra.length) spectra.pop().destroy();
  const box = $("spectra");
  box.replaceChildren();
  $("spectrum-trial").textContent = trialShown().name;
  for (const c of channelOrder()) addSpectrum(box, trialShown().channels[c]);
}

function isPower(tick) { return tick !== null && Math.abs(Math.log10(tick) - Math.round(Math.log10(tick))) < 1e-6; }

/** 1, 2, ... 9 times the powers of ten between low and high (uPlot's own search takes seconds for small numbers). */
function decades(low, high) {
  const ticks = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e) {
    for (let f = 1; f < 10; ++f) {
      const tick = f * Math.pow(10, e);
      if (tick >= low && tick <= high) ticks.push(tick);
    }
  }
  return ticks;
}

function addSpectrum(box, channel) {
  // What is smaller than a hundredth of the floor is nothing; a channel that was held has nothing at all.
  const least = 0.01 * channel.floor_density;
  const densities = channel.models.map((one) => Array.from(floatsOf(one.density)).slice(1).map((d) => (d > least ? d : null)));
  if (densities.every((one) => one.filter((d) => d !== null).length < 4)) {
    box.append(make("div", { class: "chart" }, make("h3", {}, channel.sensor), make("p", { class: "note" }, "Nothing above a hundredth of the floor at any frequency but zero.")));
    return;
  }
  const frequency = densities[0].map((_, k) => (k + 1) * channel.models[0].frequency_step);
  const floor = frequency.map(() => channel.floor_density);
  const names = report.drawn.length > 1 ? ["before", "after"] : ["residual"];
  const figure = make("div", { class: "chart" }, make("h3", {}, channel.sensor));
  box.append(figure);
  const parts = axes(`${channel.unit}/√Hz`, "Hz");
  parts[0].values = (u, ticks) => ticks.map((tick) => (isPower(tick) ? `${number(tick)} Hz` : ""));
  for (const axis of parts) axis.splits = (u, i, low, high) => decades(low, high);
  parts[1].values = (u, ticks) => ticks.map((tick) => (isPower(tick) ? number(tick) : ""));
  spectra.push(new uPlot({
    width: Math.max(300, figure.clientWidth), height: 230, padding: [8, 12, 0, 0],
    cursor: { drag: { x: true, y: true, uni: 30 } },
    scales: { x: { distr: 3, time: false, range: (u, min, max) => [min, max] },
      y: { distr: 3, range: (u, min, max) => [Math.max(least, min || 0) / 1.5, Math.max(10 * least, max || 0) * 1.5] } },
    axes: parts,
    series: [{ label: "Hz", value: (u, value) => (value === null ? "–" : number(value, 4)) },
      ...names.map((name, m) => line(name, modelClass(m), { width: 1.5 })),
      line("floor", "floor", { dash: [5, 4], width: 1.4 })],
  }, [frequency, ...densities, floor], figure));
}

function redrawSpectra() { for (const u of spectra) u.redraw(false, true); }
function resizeSpectra(width) {
  for (const u of spectra) u.setSize({ width: width || Math.max(300, u.root.parentElement.clientWidth), height: u.height });
}
