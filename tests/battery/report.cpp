#include "tests/battery/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>

#include "tests/battery/result_json.h"

namespace plumbline::battery {
namespace {

constexpr const char* kLayout = "{:<44} {:>8} {:>7} {:<15} {:<28} {:>3} {:<6} {:>8} {:>8} {:>6}";

std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

/// Nothing hidden is always to be judged; what is hidden only where it can be seen.
bool counts(const Result& result) { return result.one.kind == Kind::none || result.visible; }

std::string outcome(const Result& result) {
  if (!result.error.empty()) {
    return "ERROR";
  }
  return result.right ? "right" : (counts(result) ? "WRONG" : "unseen");
}

int inside(const Result& result) {
  return static_cast<int>(std::count_if(result.recovered.begin(), result.recovered.end(),
                                        [](const Recovered& one) { return one.is_inside(); }));
}

void add_hidden(const Result& result, const Targets& targets, Summary& summary) {
  ++summary.hidden;
  (result.one.strength == Strength::weak ? summary.weak_of_all : summary.clear_of_all).add(result.right);
  if (!result.visible) {
    return;
  }
  (result.one.strength == Strength::weak ? summary.weak : summary.clear).add(result.right);
  summary.alone.add(result.alone);
  summary.in_larger_set += !result.right && result.in_set ? 1 : 0;
  if (result.right) {
    summary.clean.add(result.invented == 0);
    summary.first.add(result.first == name_of(result.one.rows.front()));
    summary.at_floor.add(result.after <= targets.each_after);
    summary.after.push_back(result.after);
  }
}

const char* mark(bool met) { return met ? "met" : "MISSED"; }

nlohmann::json to_json(const Count& count) {
  return {{"of", count.of}, {"met", count.met}, {"share", count.share()}};
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char letter : text) {
    out += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  }
  return out + "\"";
}

std::ofstream opened(const std::string& file) {
  std::ofstream out(file);
  if (!out) {
    throw std::runtime_error(file + ": cannot be written");
  }
  return out;
}

void close(std::ofstream& out, const std::string& file) {
  out.close();
  if (!out) {
    throw std::runtime_error(file + ": cannot be written");
  }
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) {
    return 0.0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Summary summarise(const std::vector<Result>& results, const Targets& targets) {
  Summary summary;
  for (const Result& result : results) {
    summary.seconds.push_back(result.seconds);
    summary.processor_seconds.push_back(result.processor_seconds);
    summary.errors += result.error.empty() ? 0 : 1;
    if (!result.error.empty()) {
      continue;
    }
    summary.intervals.of += static_cast<int>(result.recovered.size());
    summary.intervals.met += inside(result);
    if (result.one.kind == Kind::hidden) {
      add_hidden(result, targets, summary);
    } else if (counts(result)) {
      Count& count = result.one.kind == Kind::none   ? summary.none
                     : result.one.kind == Kind::pair ? summary.pairs
                                                     : summary.unknown;
      count.add(result.right);
      if (&count == &summary.unknown) {
        summary.silent.add(result.first.empty());
      }
    }
  }
  return summary;
}

namespace {

/// One line of the scoreboard.
struct Line {
  std::string what, measured, target;
  bool met;
  bool enough = true;  // cases for a verdict; without, nothing is missed
};

std::string share_text(const Count& count) {
  return count.of == 0 ? "-" : fmt::format("{:.1f} % ({} of {})", 100.0 * count.share(), count.met, count.of);
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100.0 * share); }

constexpr int kFewIntervals = 100;  // fewer tell nothing about how often intervals hold

std::vector<Line> scoreboard(const Summary& s, const Targets& t) {
  const int named = s.none.of - s.none.met;
  const double intervals = s.intervals.share();
  return {{"right name, medium and strong", share_text(s.clear), percent(t.clear), s.clear.share() >= t.clear,
           s.clear.of > 0},
          {"right name, weak", share_text(s.weak), percent(t.weak), s.weak.share() >= t.weak, s.weak.of > 0},
          {"right name, all", share_text(s.overall()), percent(t.overall), s.overall().share() >= t.overall,
           s.overall().of > 0},
          {"nothing hidden, an effect named", fmt::format("{} of {}", named, s.none.of),
           std::to_string(t.named_on_none), named <= t.named_on_none, s.none.of > 0},
          {"pairs with both found, none invented", share_text(s.pairs), percent(t.pairs),
           s.pairs.share() >= t.pairs, s.pairs.of > 0},
          {"laws outside the catalogue, no confident name", share_text(s.unknown), percent(t.unknown),
           s.unknown.share() >= t.unknown, s.unknown.of > 0},
          {"held-out error after, median, floors", fmt::format("{:.3f}", median(s.after)),
           fmt::format("{}", t.after), median(s.after) <= t.after, !s.after.empty()},
          {"95 % intervals that hold the truth", share_text(s.intervals),
           percent(t.intervals_from) + " to " + percent(t.intervals_to),
           s.intervals.of < kFewIntervals || (intervals >= t.intervals_from && intervals <= t.intervals_to),
           s.intervals.of >= kFewIntervals},
          {"seconds for a case, median", fmt::format("{:.1f}", median(s.seconds)),
           fmt::format("{}", t.seconds), median(s.seconds) <= t.seconds}};
}

}  // namespace

bool targets_met(const Summary& summary, const Targets& targets) {
  const std::vector<Line> lines = scoreboard(summary, targets);
  return summary.errors == 0 &&
         std::all_of(lines.begin(), lines.end(), [](const Line& line) { return line.met; });
}

std::string table_head() {
  return fmt::format(kLayout, "case", "bare", "", "verdict", "first named", "set", "", "before", "after",
                     "s");
}

std::string table_line(const Result& r) {
  const std::string line = fmt::format(kLayout, r.one.name, fmt::format("{:.2f}", r.bare),
                                       r.visible ? "visible" : "", or_dash(r.verdict), or_dash(r.first),
                                       r.set_size, outcome(r), fmt::format("{:.3f}", r.before),
                                       fmt::format("{:.3f}", r.after), fmt::format("{:.1f}", r.seconds));
  return r.error.empty() ? line : line + "  " + r.error;
}

std::string explanation(const Result& result) {
  std::string text;
  const auto add = [&](const std::string& title, const std::vector<validation::RankRow>& rows) {
    constexpr std::size_t kShown = 10;
    for (std::size_t i = 0; i < std::min(rows.size(), kShown); ++i) {
      const validation::RankRow& row = rows[i];
      text += fmt::format("    {:<8} {:<34} {} train {:9.3f} held-out {:9.3f}  {}\n", i == 0 ? title : "",
                          row.label(), row.refitted ? "refit  " : "promise", row.train_after,
                          row.held_out_after, row.remark);
    }
  };
  text += fmt::format("    hidden   {}\n", result.with);
  add("ranking", result.ranking);
  add("leads", result.leads);
  for (const validation::PairRow& row : result.pairs) {
    text +=
        fmt::format("    pair     {:<34} + {:<34} train {:9.3f} held-out {:9.3f}  {}\n", row.first.label(),
                    row.second.label(), row.train_after, row.held_out_after, row.remark);
  }
  return text;
}

std::string summary_text(const Summary& s, const Targets& t) {
  std::string text = fmt::format(
      "{} cases with one hidden effect, {} of them visible (held-out error before anything is named at least "
      "{} floors)\n\n",
      s.hidden, s.overall().of, kVisible);
  for (const Line& line : scoreboard(s, t)) {
    text += fmt::format("  {:<48} {:<22} target {:<13} {}\n", line.what, line.measured, line.target,
                        line.enough ? mark(line.met) : "too few");
  }
  text += fmt::format("\n  visible or not: medium and strong {}, weak {}\n", share_text(s.clear_of_all),
                      share_text(s.weak_of_all));
  text += fmt::format("  visible ones named themselves, not only by a rival: {}\n", share_text(s.alone));
  text += fmt::format("  right ones with nothing invented beside: {}\n", share_text(s.clean));
  text +=
      fmt::format("  outside the catalogue, nothing named, not even as a part: {}\n", share_text(s.silent));
  text += fmt::format("\n  of the right ones {} named first; {} with an error above {} floors\n",
                      share_text(s.first), s.at_floor.of - s.at_floor.met, t.each_after);
  text += fmt::format("  a case takes {:.1f} s of processor, median\n", median(s.processor_seconds));
  text += fmt::format("  of the others {} in a set of more than {} names\n", s.in_larger_set, kMostNames);
  if (s.errors > 0) {
    text += fmt::format("  {} cases could not be run: MISSED\n", s.errors);
  }
  return text;
}

std::string confusion_text(const std::vector<Result>& results) {
  struct Line {
    Count right;
    std::map<std::string, int> others;
  };
  std::map<std::string, Line> lines;
  for (const Result& result : results) {
    if (!result.error.empty() || !counts(result)) {
      continue;
    }
    const bool one = result.one.kind == Kind::hidden;
    Line& line = lines[one ? result.one.rows.front().effect : "(" + to_string(result.one.kind) + ")"];
    line.right.add(result.right);
    if (!result.right) {
      ++line.others[result.first.empty() ? result.verdict : result.first.substr(0, result.first.find('@'))];
    }
  }
  std::string text = "hidden                    right    otherwise named\n";
  for (const auto& [law, line] : lines) {
    std::string others;
    for (const auto& [name, times] : line.others) {
      others += fmt::format("{}{} x {}", others.empty() ? "" : ", ", times, name);
    }
    text += fmt::format("{:<24} {:>3} of {:<3}  {}\n", law, line.right.met, line.right.of, others);
  }
  return text;
}

void write_json(const std::string& file, const std::vector<Result>& results, const Summary& s,
                const Targets& t, std::uint64_t seed) {
  nlohmann::json json{{"seed", seed}, {"cases", nlohmann::json::array()}};
  for (const Result& result : results) {
    json["cases"].push_back(to_json(result));
  }
  for (const Line& line : scoreboard(s, t)) {
    json["scoreboard"].push_back({{"measure", line.what},
                                  {"measured", line.measured},
                                  {"target", line.target},
                                  {"met", line.met},
                                  {"enough", line.enough}});
  }
  json["summary"] = {{"hidden", s.hidden},
                     {"visible", s.overall().of},
                     {"clear", to_json(s.clear)},
                     {"weak", to_json(s.weak)},
                     {"first", to_json(s.first)},
                     {"in_larger_set", s.in_larger_set},
                     {"none", to_json(s.none)},
                     {"pairs", to_json(s.pairs)},
                     {"unknown", to_json(s.unknown)},
                     {"at_floor", to_json(s.at_floor)},
                     {"clear_of_all", to_json(s.clear_of_all)},
                     {"weak_of_all", to_json(s.weak_of_all)},
                     {"alone", to_json(s.alone)},
                     {"clean", to_json(s.clean)},
                     {"silent", to_json(s.silent)},
                     {"intervals", to_json(s.intervals)},
                     {"median_after", median(s.after)},
                     {"median_seconds", median(s.seconds)},
                     {"median_processor_seconds", median(s.processor_seconds)},
                     {"errors", s.errors},
                     {"targets_met", targets_met(s, t)}};
  std::ofstream out = opened(file);
  out << json.dump(2) << "\n";
  close(out, file);
}

void write_csv(const std::string& file, const std::vector<Result>& results) {
  std::ofstream out = opened(file);
  out << "case,kind,strength,with,bare_held_out,visible,verdict,first_named,others_named,set_size,"
         "asked,inside,right,held_out_before,held_out_after,seconds,error\n";
  for (const Result& r : results) {
    out << fmt::format("{},{},{},{},{:.6g},{:d},{},{},{},{},{},{},{:d},{:.6g},{:.6g},{:.3f},{}\n", r.one.name,
                       to_string(r.one.kind), to_string(r.one.strength), quoted(r.with), r.bare, r.visible,
                       r.verdict, r.first, r.others, r.set_size, r.recovered.size(), inside(r), r.right,
                       r.before, r.after, r.seconds, quoted(r.error));
  }
  close(out, file);
}

}  // namespace plumbline::battery
