// Parameters with what was known and what was found, their correlations, and what the data cannot tell.

function drawEstimates() {
  const { parameters, confidence, windows } = report.estimates;
  if (parameters.length === 0) {
    $("estimates").replaceChildren(make("p", { class: "note" }, "Nothing was fitted here: the values are those of the model file."));
    $("values").parentElement.open = true;
    return;
  }
  const known = (p) => (p.known ? `${number(p.known.mean, 4)} ± ${number(p.known.standard_deviation, 2)}` : "nothing");
  const rows = parameters.map((p) => make("tr", {},
    make("td", {}, p.label), make("td", { class: "unit" }, p.unit), make("td", { class: "number" }, p.given === null ? "–" : number(p.given, 4)),
    make("td", { class: "number" }, known(p)),
    make("td", { class: "number" }, `${number(p.value, digitsFor(p.value, p.standard_deviation))} ± ${number(p.standard_deviation, 2)}`),
    make("td", { class: "number" }, p.interval.map((end) => number(end, digitsFor(end, p.standard_deviation))).join(" to ")),
    make("td", { class: "note" }, (p.assumed ? "assumed: " : "") + p.source)));
  $("estimates").replaceChildren(
    make("p", { class: "lead" }, `Fitted on ${windows} train windows. ± is one standard deviation, the interval holds ${percent(confidence)}, both from the scatter between the windows.`),
    make("table", {}, make("thead", {}, make("tr", {}, ["parameter", "unit", "in the model", "known beforehand", "found", `${percent(confidence)} interval`, "source of the model's value"].map((head, i) =>
      make("th", { class: i > 1 && i < 6 ? "number" : false }, head)))), make("tbody", {}, rows)));
}

function drawCorrelation() {
  const { parameters, correlation } = report.estimates;
  if (!correlation || parameters.length < 2) return;
  const short = parameters.map((_, i) => String(i + 1));
  $("correlation").replaceChildren(make("h3", {}, "Correlations"),
    make("table", {}, make("thead", {}, make("tr", {}, make("th", {}), short.map((name) => make("th", { scope: "col" }, name)))),
      make("tbody", {}, correlation.map((row, r) => make("tr", {}, make("th", { scope: "row" }, `${r + 1}  ${parameters[r].label}`),
        row.map((value, c) => make("td", { style: `--p:${r === c ? 0 : (65 * Math.abs(value)).toFixed(0)};--sign:var(--${value < 0 ? "minus" : "plus"})` },
          r === c ? "1" : value.toFixed(2).replace("-", "−"))))))));
}

function drawUntold() {
  const lines = report.estimates.parameters.flatMap((p) => p.doubts.map((doubt) => `${p.label}: ${doubt.text}.`));
  for (const finding of report.diagnosis ? report.diagnosis.accepted : []) {
    if (finding.rivals.length) lines.push(`${labelOf(finding)} from ${finding.rivals.map(labelOf).join(", ")}.`);
  }
  if (report.diagnosis && report.diagnosis.verdict === "unexplained") lines.push("Which law explains the rest: nothing in the catalogue does.");
  if (lines.length === 0) lines.push(report.estimates.parameters.length ? "All fitted parameters are identifiable from these data." : "Nothing was asked of them.");
  $("not-identifiable").replaceChildren(...lines.map((text) => make("li", {}, text)));
}

function quantityRow(what, name, quantity) {
  return make("tr", {}, make("td", {}, what), make("td", {}, name), make("td", { class: "number" }, number(quantity.value, 5)),
    make("td", { class: "number" }, quantity.standard_deviation > 0 ? "± " + number(quantity.standard_deviation, 2) : ""),
    make("td", {}, quantity.unit), make("td", { class: "note" }, (quantity.assumed ? "assumed: " : "") + quantity.source));
}

function drawValues() {
  const model = report.values;
  const rows = [
    ...model.effects.flatMap((effect) => Object.entries(effect.values).map(([name, q]) => quantityRow(`${effect.effect} at ${effect.at}`, name, q))),
    ...model.motors.flatMap((motor) => ["rotor_inertia", "torque_constant", "torque_limit"].filter((key) => motor[key]).map((key) => quantityRow(motor.name, key.replace("_", " "), motor[key]))),
    ...model.pulleys.map((pulley) => quantityRow(pulley.name, "inertia", pulley.inertia)),
    ...model.inertias.map((inertia) => quantityRow(inertia.at, inertia.name, inertia.value)),
  ];
  $("values").replaceChildren(make("table", {}, make("thead", {}, make("tr", {}, ["of", "value", "", "", "unit", "source"].map((head) => make("th", {}, head)))), make("tbody", {}, rows)));
}

function drawRepetition() {
  const repeat = report.repeat;
  const versions = [`plumbline ${repeat.version}`, repeat.compiler, ...Object.entries(repeat.libraries).map(([name, version]) => `${name} ${version}`)];
  const kinds = (kind) => repeat.files.filter((file) => file.kind === kind);
  $("repetition").replaceChildren(
    make("pre", {}, repeat.command),
    make("p", {}, `Windows of ${number(repeat.window)} s. ` + (repeat.seed === null ? "Nothing was drawn at random." : `Seed of the resampling: ${repeat.seed}.`)),
    make("p", {}, versions.join(" · ")),
    make("table", {}, make("thead", {}, make("tr", {}, make("th", {}, ""), make("th", {}, "file"), make("th", {}, "SHA-256"))),
      make("tbody", {}, [["program", [{ file: "plumbline", sha256: repeat.program }]], ...["model", "skeleton", "trial", "data", "diagnosis"].map((kind) => [kind, kinds(kind)])]
        .flatMap(([kind, files]) => files.map((file) => make("tr", {}, make("td", {}, kind), make("td", {}, file.file), make("td", { class: "hash" }, file.sha256)))))));
}
