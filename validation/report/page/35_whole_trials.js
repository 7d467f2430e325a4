// Whole trials under each model of the ladder: in closed loop, and the force that the measured motion needs.

/** Errors that any of the models can give, trial by trial: {trial, head, quantity, data, of(rung)}. */
function wholeColumns() {
  const columns = [];
  const longest = (t, listOf) => report.whole_trials.map((trials) => listOf(trials[t])).reduce((a, b) => (b.length > a.length ? b : a));
  const add = (t, quantity, head, list, key) => list.forEach((one, i) => columns.push({
    trial: t, quantity, data: report.whole_trials[0][t].data, head: list.length > 1 ? `${head} ${one.motor}` : head,
    of: (trials) => (key(trials[t])[i] || {}),
  }));
  report.whole_trials[0].forEach((_, t) => {
    const loops = (trial) => trial.closed_loop.loops;
    const motors = (trial) => trial.inverse_model.motors;
    add(t, "closed_loop_position", "position", longest(t, loops), loops);
    add(t, "closed_loop_force", "force", longest(t, loops), loops);
    add(t, "inverse_force", "inverse", longest(t, motors), motors);
  });
  return columns;
}

function wholeValue(column, trials) {
  return column.of(trials)[column.quantity === "closed_loop_position" ? "position_percent" : "force_percent"];
}

/** What others have published: a row for each of their models that has one of these columns. */
function publishedRows(columns) {
  const models = [...new Set(report.published.map((value) => value.model))];
  const valueOf = (model, column) => (report.published.find((one) => one.model === model && one.data === column.data && one.compares === column.quantity) || {}).percent;
  return models.map((model) => ({ name: `published: ${model}`, values: columns.map((column) => valueOf(model, column)) }))
    .filter((row) => row.values.some((value) => value !== undefined));
}

function drawWholeTrials() {
  const columns = report.whole_trials.length ? wholeColumns() : [];
  if (columns.length === 0) return;
  const has = (kind) => columns.some((column) => column.quantity.startsWith(kind));
  const text = (value) => (value === undefined || value === null ? "–" : number(value));
  const trials = [...new Set(columns.map((column) => column.trial))];
  const firstOf = (column) => columns.find((other) => other.trial === column.trial) === column;
  const rows = [...report.ladder.map((rung, r) => ({ name: rung.name, values: columns.map((column) => wholeValue(column, report.whole_trials[r])) })), ...publishedRows(columns)];
  $("whole-trials").replaceChildren(
    make("h3", {}, "Whole trials"),
    make("p", { class: "lead" }, (has("closed_loop") ? "Position and force: the trial simulated from its start to its end with the controller that ran. " : "")
      + (has("inverse") ? "Inverse: the force that the measured motion needs against the one that was commanded. " : "") + "All in % of what was measured."),
    make("table", {}, make("thead", {},
      make("tr", {}, make("td", {}), trials.map((t) => make("th", { class: "group", scope: "colgroup", colspan: columns.filter((column) => column.trial === t).length }, `${report.trials[t].name} (${report.trials[t].role})`))),
      make("tr", {}, make("th", {}, "model"), columns.map((column) => make("th", { class: firstOf(column) ? "number group" : "number", scope: "col" }, column.head)))),
    make("tbody", {}, rows.map((row) => make("tr", {}, make("th", { scope: "row" }, row.name),
      row.values.map((value, c) => make("td", { class: firstOf(columns[c]) ? "number group" : "number" }, text(value))))))),
    ...whyNot(columns).map((why) => make("p", { class: "note" }, why)));
}

/** Why cells of the models are empty, each reason once. */
function whyNot(columns) {
  const reasons = columns.flatMap((column) => report.ladder.map((rung, r) => {
    if (typeof wholeValue(column, report.whole_trials[r]) === "number") return "";
    const inverse = column.quantity === "inverse_force";
    const trial = report.whole_trials[r][column.trial];
    return `– No ${inverse ? "inverse model" : "closed loop"} under “${rung.name}”: ${(inverse ? trial.inverse_model : trial.closed_loop).not_available}.`;
  }));
  return [...new Set(reasons.filter((why) => why))];
}

/** Why there is no inverse model of a trial under a drawn model; empty where there is one. */
function withoutInverse(trial, model) {
  const rung = report.whole_trials[model === 0 ? 0 : report.whole_trials.length - 1];
  return rung ? rung[trial].inverse_model.not_available : "";
}
