// What was found, the ranking of the candidates with their uncertainty, and what they cannot be told from.

const kRows = 12;

function labelOf(one) { return `${one.effect} at ${one.at}`; }
function same(a, b) { return a.effect === b.effect && a.at === b.at; }

function drawFindings() {
  const diagnosis = report.diagnosis;
  if (!diagnosis) {
    $("findings").replaceChildren(make("p", { class: "note" }, "No diagnosis was made: the page compares only."));
    return;
  }
  const cards = diagnosis.accepted.map((finding) => make("div", { class: "finding" },
    make("h3", {}, labelOf(finding)),
    finding.equation ? make("code", {}, finding.equation) : null,
    make("table", {}, make("tbody", {}, finding.parameters.map((p) => make("tr", {}, make("td", {}, p.name),
      make("td", {}, `${number(p.value, digitsFor(p.value, p.standard_deviation))} ± ${number(p.standard_deviation, 2)} ${p.unit === "1" ? "" : p.unit}`))))),
    make("p", {}, `Held-out error ${ratio(finding.held_out_before)} → ${ratio(finding.held_out_after)}, train ${ratio(finding.train_before)} → ${ratio(finding.train_after)} times the floor. Chosen in ${percent(finding.selected_share)} of the resamples of windows.`),
    make("p", {}, rivalWords(finding))));
  $("findings").replaceChildren(...(cards.length ? cards : [make("p", { class: "note" }, "No effect was accepted.")]));
}

function rivalWords({ rivals }) {
  const same = rivals.filter((rival) => rival.same).map(labelOf);
  const others = rivals.filter((rival) => !rival.same).map((rival) => `${labelOf(rival)} (correlation ${rival.correlation.toFixed(4)})`);
  return [...(same.length ? [`On this model it is the same force as: ${same.join("; ")}.`] : []),
    others.length ? `These data cannot tell it from: ${others.join("; ")}.`
      : "Nothing else in the catalogue explains these data as well."].join(" ");
}

/** Rows of the first round: the named effect and its rivals first, joined; then the rest by error. */
function rankingRows(diagnosis) {
  const ranking = diagnosis.ranking;
  const named = diagnosis.accepted.find((finding) => ranking.some((row) => same(row, finding) && row.refitted));
  if (!named) return { rows: ranking.slice(0, kRows), joined: 0, named: null };
  const rivals = named.rivals.map((rival) => ranking.find((row) => same(row, rival)) || { ...rival, tied: true });
  const set = [ranking.find((row) => same(row, named)), ...rivals];
  const rest = ranking.filter((row) => !set.some((one) => same(one, row)));
  return { rows: [...set, ...rest.slice(0, Math.max(4, kRows - set.length))], joined: set.length, named };
}

function drawRanking() {
  const diagnosis = report.diagnosis;
  if (!diagnosis || diagnosis.ranking.length === 0) return;
  const { rows, joined, named } = rankingRows(diagnosis);
  const judged = report.ladder.some((rung) => rung.held_out !== null);
  const errorOf = (row) => (judged ? row.held_out_after : row.train_after);
  const values = rows.flatMap((row) => (row.tied ? [] : [row.held_out_after, row.train_after])).filter((e) => e > 0);
  const low = Math.min(0.85, ...values) * 0.95;
  const high = Math.max(2, ...values) * 1.1;
  const width = Math.max(150, Math.min(480, $("ranking").clientWidth - 760));
  const x = logScale(low, high, 8, width - 8);
  const plot = (row) => {
    const svg = makeSvg("svg", { width, height: 22, role: "img", "aria-label": `error ${ratio(errorOf(row))}` },
      makeSvg("line", { class: "gridline", x1: 0, x2: width, y1: 11, y2: 11 }),
      makeSvg("line", { class: "floor", x1: x(1), x2: x(1), y1: 0, y2: 22 }));
    const interval = row.judged_interval;
    if (row.refitted && interval && interval[1] > 0) {
      svg.append(makeSvg("line", { class: "interval", x1: x(interval[0]), x2: Math.max(x(interval[0]) + 1, x(interval[1])), y1: 11, y2: 11 }));
    }
    svg.append(...(row.train_after > 0 ? [trainMark(x(row.train_after), 11)] : []));
    svg.append(...(row.held_out_after > 0 && judged ? [heldMark(x(row.held_out_after), 11)] : []));
    return svg;
  };
  const line = (row, i) => make("tr", { class: joined > 1 && i < joined ? "joined" : false },
    make("td", { class: joined > 1 && i < joined ? "set" : "alone" }, labelOf(row),
      named && i === 0 ? make("span", { class: "tag named" }, "named") : null,
      joined > 1 && i > 0 && i < joined ? make("span", { class: "tag" }, "rival") : null),
    row.tied ? make("td", { colspan: 4, class: "note" }, "the same law at a place that is rigidly tied to it")
      : [make("td", { class: "plot" }, plot(row)),
        make("td", { class: "number" }, ratio(row.train_after)),
        make("td", { class: "number" }, judged ? ratio(row.held_out_after) : "–"),
        make("td", { class: "number" }, row.refitted && row.selected_share !== undefined ? percent(row.selected_share) : "–")],
    make("td", { class: "note" }, row.tied ? "" : row.refitted ? row.remark : "promised by the linearisation only"));
  const axis = makeSvg("svg", { width, height: 18 }, logTicks(low, high).map((tick) =>
    makeSvg("text", { class: "soft", x: x(tick), y: 13, "text-anchor": "middle" }, number(tick))));
  $("ranking").replaceChildren(
    make("h3", {}, `Candidates of the first round, of ${diagnosis.candidates} screened`),
    make("p", { class: "lead" }, `Error with the candidate added, in units of the floor; ○ train, ◆ held-out. The bar holds 90 % of the resamples of windows. ${joined > 1 ? "The joined rows are what these data cannot tell apart." : ""}`),
    make("table", {}, make("thead", {}, make("tr", {}, ["effect", "error / floor", "train", "held-out", "chosen", ""].map((head, i) =>
      make("th", { class: i > 1 && i < 5 ? "number" : i === 0 ? "alone" : false }, head)))),
    make("tbody", {}, rows.map(line), make("tr", {}, make("td", { class: "alone" }), make("td", { class: "plot" }, axis)))));
}

function drawLeads() {
  const diagnosis = report.diagnosis;
  if (!diagnosis || diagnosis.verdict === "nothing_missing") return;
  const shown = (lead) => diagnosis.ranking.some((row) => same(row, lead) && row.train_after === lead.train_after);
  if (diagnosis.leads.every(shown)) return;  // there was one round only
  $("leads").replaceChildren(make("h3", {}, "Tried last and not accepted"),
    make("table", {}, make("thead", {}, make("tr", {}, ["effect", "train", "held-out", "why not"].map((head, i) => make("th", { class: i === 1 || i === 2 ? "number" : false }, head)))),
      make("tbody", {}, diagnosis.leads.slice(0, 8).map((row) => make("tr", {}, make("td", {}, labelOf(row)),
        make("td", { class: "number" }, ratio(row.train_after)), make("td", { class: "number" }, ratio(row.held_out_after)), make("td", { class: "note" }, row.remark))))));
}
