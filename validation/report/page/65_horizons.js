// How far off a prediction is, so long after the last measurement that it knows.

/** Every horizon that any channel reaches, s. */
function horizonColumns() {
  return [...new Set(report.horizons.flat().map((one) => one.horizon))].sort((a, b) => a - b);
}

function drawHorizons() {
  const columns = horizonColumns();
  if (columns.length === 0) return;
  const shown = report.horizons[state.model];
  const keys = [...new Set(report.horizons.flat().map((one) => JSON.stringify([one.trial, one.role, one.channel, one.unit])))].map((key) => JSON.parse(key));
  const valueOf = ([trial, , channel], horizon) => {
    const one = shown.find((other) => other.trial === trial && other.channel === channel && other.horizon === horizon);
    if (!one) return "–";
    return one.windows === 0 ? "lost" : number(one.rms);
  };
  $("horizons").replaceChildren(
    make("h3", {}, "Error over the prediction horizon"),
    make("p", { class: "lead" }, "Root mean square error so long after the last measurement that the prediction knows: it saw one window and goes on with the recorded commands alone."),
    make("table", {}, make("thead", {}, make("tr", {}, ["trial", "channel", "unit"].map((head) => make("th", {}, head)),
      columns.map((horizon) => make("th", { class: "number", scope: "col" }, `${number(horizon)} s`)))),
    make("tbody", {}, keys.map((key) => make("tr", {}, make("th", { scope: "row" }, `${key[0]} (${key[1]})`), make("td", {}, key[2]), make("td", {}, key[3]),
      columns.map((horizon) => make("td", { class: "number" }, valueOf(key, horizon))))))));
}
