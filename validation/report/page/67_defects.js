// Where something happens that the model does not know: jumps between segments that are predicted on their own.

function jumpText(one) {
  if (one.impulse === null) return `position jumps by ${number(one.jump)} ${one.unit}`;
  return `velocity jumps by ${number(one.jump)} ${one.unit} (${number(one.impulse)} ${one.unit === "rad/s" ? "N m s" : "N s"})`;
}

function drawDefects() {
  const shown = report.defects[state.model] ?? [];
  if (shown.length === 0) {
    $("defects").replaceChildren();
    return;
  }
  $("defects").replaceChildren(
    make("h3", {}, "Where something happens that the model does not know"),
    make("p", { class: "lead" }, "Each eighth of a window is predicted from its own estimated start. Listed is where one begins elsewhere than the one before it ends, by more than four standard deviations: a blow, a stop, a slip."),
    make("table", {}, make("thead", {}, make("tr", {}, ["trial", "time", "at", "", "deviations"].map((head) => make("th", {}, head)))),
      make("tbody", {}, shown.slice(0, 12).map((one) => make("tr", {}, make("th", { scope: "row" }, `${one.trial} (${one.role})`),
        make("td", {}, `${number(one.time)} s`), make("td", {}, one.at), make("td", {}, jumpText(one)), make("td", { class: "number" }, number(one.deviations)))))));
}
