// The force that the model does not explain, against what it might follow.

function drawForces() {
  const forces = report.unexplained[state.model].filter((force) => force.trial === trialShown().name);
  if (forces.length === 0) {
    const other = report.drawn.findIndex((_, m) => report.unexplained[m].some((force) => force.trial === trialShown().name));
    $("forces").replaceChildren(make("p", { class: "note" },
      `Under “${report.drawn[state.model]}” the motion does not tell the motors' forces: ${withoutInverse(state.trial, state.model)}. ` +
      (other >= 0 ? `Switch to “${report.drawn[other]}” to see the force that it left.` : "")));
    return;
  }
  $("forces").replaceChildren(...forces.flatMap((force) => [
    make("h3", {}, `${force.at}, ${force.trial}`),
    make("p", {}, `${withUnit(force.rms, force.unit, 3)} rms, ${percent(force.relative)} of the recorded force${force.below === null ? "" : ` below ${withUnit(force.below, "Hz", 3)}`}; it ${force.words}.`),
    make("div", { class: "curves" }, force.dependences.map((dependence) => curve(dependence, force))),
  ]));
}

function curve(dependence, force) {
  const width = 220, height = 128, left = 8, bottom = 20;
  const spread = force.dependences.flatMap((one) => one.mean);
  const reach = spread.reduce((a, b) => Math.max(a, Math.abs(b)), 0) || 1;
  const first = dependence.center[0], last = dependence.center[dependence.center.length - 1];
  const x = (value) => left + (width - 2 * left) * (value - first) / (last - first || 1);
  const y = (value) => (height - bottom) * (0.5 - 0.46 * value / reach);
  const points = dependence.center.map((center, i) => `${x(center).toFixed(1)},${y(dependence.mean[i]).toFixed(1)}`);
  const look = modelClass(state.model);
  const svg = makeSvg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `mean force against ${dependence.variable}` },
    makeSvg("line", { class: "axis", x1: left, x2: width - left, y1: y(0), y2: y(0) }),
    makeSvg("polyline", { points: points.join(" "), fill: "none", stroke: `var(--${look})`, "stroke-width": 1.8 }),
    dependence.center.map((center, i) => makeSvg("circle", { cx: x(center), cy: y(dependence.mean[i]), r: 2.4, class: `${look}-fill` })),
    makeSvg("text", { class: "soft", x: left, y: height - 4 }, number(first)),
    makeSvg("text", { class: "soft", x: width - left, y: height - 4, "text-anchor": "end" }, withUnit(last, dependence.unit, 3)));
  return make("figure", {}, svg, make("figcaption", {}, make("b", {}, dependence.variable), `${dependence.of_size ? ", size of the force" : ""} · ${percent(dependence.share)} · ±${withUnit(reach, force.unit, 2)}`));
}
