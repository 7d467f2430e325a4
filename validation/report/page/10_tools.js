// Small helpers: elements, numbers, colours, packed data.

function $(id) { return document.getElementById(id); }

/** An element with attributes (a function becomes a listener, false leaves an attribute out) and children. */
function make(tag, attributes, ...children) {
  return furnish(document.createElement(tag), attributes, children);
}

function makeSvg(tag, attributes, ...children) {
  return furnish(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

function furnish(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

/** About `digits` significant digits; powers of ten for what is very large or small. */
function number(value, digits = 3) {
  if (value === null || value === undefined) return "–";
  if (typeof value === "string") return value === "inf" ? "∞" : value === "-inf" ? "−∞" : value;
  if (value === 0) return "0";
  const size = Math.abs(value);
  let text = size >= 1e5 || size < 1e-3 ? value.toExponential(digits - 1) : value.toPrecision(digits);
  if (text.includes("e") && size < 1e5 && size >= 1e-3) text = String(Math.round(value));
  text = text.replace(/(\.\d*?)0+(?=e|$)/, "$1").replace(/\.(?=e|$)/, "");
  return text.replace("e+", "e").replace(/-/g, "−");
}

/** An error in units of the floor. */
function ratio(value) {
  if (value === null || value === undefined) return "–";
  return value >= 1000 ? Math.round(value).toLocaleString("en") : value >= 100 ? value.toFixed(1) : value.toFixed(2);
}

function percent(share) { return `${(100 * share).toFixed(share < 0.0995 && share > 0 ? 1 : 0)} %`; }

/** So many significant digits that a change by one deviation shows, 4 to 9. */
function digitsFor(value, deviation) {
  if (!(deviation > 0) || !(Math.abs(value) > 0)) return 4;
  return Math.min(9, Math.max(4, Math.ceil(Math.log10(Math.abs(value) / deviation)) + 1));
}

function withUnit(value, unit, digits = 4) {
  return unit === "1" || !unit ? number(value, digits) : `${number(value, digits)} ${unit}`;
}

function colour(name) { return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim(); }

function isInView(element) {
  const { top, bottom } = element.getBoundingClientRect();
  return top < 0.7 * innerHeight && bottom > 0.3 * innerHeight;
}

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

function floatsOf(base64) { return new Float32Array(bytesOf(base64).buffer); }

/** 16-bit points with a middle and step for each block; -32768: nothing. */
function unpack(packed, blocks) {
  const raw = new Int16Array(bytesOf(packed.data).buffer);
  const values = new Array(raw.length);
  let at = 0;
  blocks.forEach((points, b) => {
    for (const end = at + points; at < end; ++at) {
      values[at] = raw[at] === -32768 ? null : packed.middle[b] + packed.step[b] * raw[at];
    }
  });
  return values;
}

/** Runs the work once for all calls until the next frame. */
function onceAFrame(work) {
  let waiting = false;
  return () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; work(); });
  };
}

/** Values 1, 2, 5 times powers of ten (or only powers of ten over more than two decades) from low to high. */
function logTicks(low, high) {
  const ticks = [];
  const factors = Math.log10(high / low) > 2.2 ? [1] : [1, 2, 5];
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e) {
    for (const f of factors) {
      const tick = f * Math.pow(10, e);
      if (tick >= low * 0.999 && tick <= high * 1.001) ticks.push(Number(tick.toPrecision(3)));
    }
  }
  return ticks;
}

/** Maps [low, high] to [from, to] on a logarithmic line. */
function logScale(low, high, from, to) {
  const span = Math.log(high / low) || 1;
  return (value) => from + (to - from) * Math.log(Math.max(value, low) / low) / span;
}
