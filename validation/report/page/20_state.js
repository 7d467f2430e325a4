// What is shown, and who wants to know when it changes.

const report = JSON.parse($("report-data").textContent);
$("report-data").textContent = "";  // parsed: the text need not stay in memory

const state = { trial: 0, model: 0, range: null, window: null };
const listeners = { trial: [], model: [], range: [], look: [] };

function on(what, work) { listeners[what].push(work); }
function tell(what) { for (const work of listeners[what]) work(); }

function trialShown() { return report.trials[state.trial]; }
function modelClass(model) { return model === 0 && report.drawn.length > 1 ? "before" : "after"; }

function showTrial(index) {
  if (index === state.trial) return;
  state.trial = index;
  state.range = state.window = null;
  tell("trial");
}

function showModel(index) {
  if (index === state.model || index >= report.drawn.length) return;
  state.model = index;
  tell("model");
}

/** null: the whole trial. `at`: the window that this is about, if it is. */
function showRange(range, at = null) {
  state.range = range;
  state.window = at;
  tell("range");
}

function wholeRange() {
  const windows = trialShown().windows;
  return [windows[0].from, windows[windows.length - 1].to];
}

/** One window with a little of its neighbours. */
function showWindow(trial, index, scroll) {
  showTrial(trial);
  const at = report.trials[trial].windows[index];
  const margin = 0.15 * (at.to - at.from);
  const [first, last] = wholeRange();
  showRange([Math.max(first, at.from - margin), Math.min(last, at.to + margin)], at);
  if (scroll) $("time").scrollIntoView();
}
