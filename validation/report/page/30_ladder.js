// The ladder as a picture: one row for each model, train and held-out error on a logarithmic line, the floor at 1.

function drawLadder() {
  const rungs = report.ladder;
  const box = $("ladder-picture");
  const width = Math.max(420, box.clientWidth);
  const labels = Math.min(340, Math.max(150, 0.3 * width));
  const numbers = 150;
  const row = 30;
  const top = 34;
  const height = top + row * rungs.length + 34;
  const errors = rungs.flatMap((rung) => [rung.train, rung.held_out]).filter((e) => e > 0);
  const low = Math.min(0.8, ...errors) * 0.95;
  const high = Math.max(2, ...errors) * 1.15;
  const x = logScale(low, high, labels, width - numbers);
  const y = (i) => top + row * (i + 0.5);
  const svg = makeSvg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": "Error of each model: " + rungs.map((r) => `${r.name}: train ${ratio(r.train)}, held-out ${ratio(r.held_out)}`).join("; ") });
  const text = (at, line, content, look) => makeSvg("text", { x: at, y: line, ...look }, content);
  for (const tick of logTicks(low, high)) {
    svg.append(makeSvg("line", { class: "gridline", x1: x(tick), x2: x(tick), y1: top, y2: height - 30 }),
      text(x(tick), height - 12, number(tick), { class: "soft", "text-anchor": "middle" }));
  }
  svg.append(makeSvg("line", { class: "floor", "stroke-width": 1.6, x1: x(1), x2: x(1), y1: top - 10, y2: height - 30 }),
    text(x(1), top - 16, "floor", { class: "soft", "text-anchor": "middle" }),
    text(width - numbers + 62, top - 16, "train", { class: "soft", "text-anchor": "end" }),
    text(width - 4, top - 16, "held-out", { class: "soft", "text-anchor": "end" }));
  const path = (key) => rungs.map((rung, i) => (rung[key] > 0 ? `${x(rung[key])},${y(i)}` : null)).filter((p) => p).join(" ");
  svg.append(makeSvg("polyline", { class: "path-train", points: path("train") }),
    makeSvg("polyline", { class: "path-held", points: path("held_out") }));
  rungs.forEach((rung, i) => {
    svg.append(text(0, y(i) + 4.5, shortened(rung.name, labels - 14)),
      text(width - numbers + 62, y(i) + 4.5, ratio(rung.train), { "text-anchor": "end" }),
      text(width - 4, y(i) + 4.5, ratio(rung.held_out), { "text-anchor": "end", class: "strong" }),
      ...(rung.train > 0 ? [trainMark(x(rung.train), y(i))] : []),
      ...(rung.held_out > 0 ? [heldMark(x(rung.held_out), y(i))] : []));
  });
  const foot = height - 16;
  svg.append(trainMark(7, foot), text(18, foot + 4.5, "train", { class: "soft" }), heldMark(66, foot), text(77, foot + 4.5, "held-out", { class: "soft" }));
  box.replaceChildren(svg);
}

function trainMark(x, y) { return makeSvg("circle", { class: "train", cx: x, cy: y, r: 5 }); }

function heldMark(x, y) {
  return makeSvg("path", { class: "held", d: `M${x - 6},${y} L${x},${y - 6} L${x + 6},${y} L${x},${y + 6} Z` });
}

/** Cut to about so many pixels; the whole name on hovering. */
function shortened(name, pixels) {
  const letters = Math.max(6, Math.floor(pixels / 6.6));
  const span = makeSvg("tspan", {}, name.length > letters ? name.slice(0, letters - 1) + "…" : name);
  span.append(makeSvg("title", {}, name));
  return span;
}
