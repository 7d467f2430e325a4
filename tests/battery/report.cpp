#include "tests/battery/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace plumbline::battery {
namespace {

constexpr const char* kLayout = "{:<44} {:>8} {:>7} {:<15} {:<28} {:>3} {:<6} {:>8} {:>8} {:>6}";

std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

std::string outcome(const Result& result) {
  if (!result.error.empty()) {
    return "ERROR";
  }
  const bool unseen = result.one.kind == Kind::hidden && !result.visible;
  return result.right ? "right" : (unseen ? "unseen" : "WRONG");
}

void add_hidden(const Result& result, const Targets& targets, Summary& summary) {
  ++summary.hidden;
  if (!result.visible) {
    return;
  }
  ++summary.visible;
  if (!result.right) {
    return;
  }
  ++summary.right;
  summary.first += result.first == result.one.row.effect + "@" + result.one.row.at ? 1 : 0;
  summary.above_floor += result.after > targets.floor ? 1 : 0;
  summary.worst_after = std::max(summary.worst_after, result.after);
}

double right_share(const Summary& summary) {
  return summary.visible == 0 ? 1.0 : static_cast<double>(summary.right) / summary.visible;
}

const char* mark(bool met) { return met ? "met" : "MISSED"; }

nlohmann::json to_json(const Result& r) {
  return {{"case", r.one.name},
          {"robot", r.one.robot},
          {"kind", to_string(r.one.kind)},
          {"effect", r.one.row.effect},
          {"at", r.one.row.at},
          {"strength", to_string(r.one.strength)},
          {"with", r.with},
          {"removed", r.one.removed},
          {"bare_held_out", r.bare},
          {"visible", r.visible},
          {"verdict", r.verdict},
          {"first_named", r.first},
          {"others_named", r.others},
          {"set_size", r.set_size},
          {"in_set", r.in_set},
          {"right", r.right},
          {"held_out_before", r.before},
          {"held_out_after", r.after},
          {"seconds", r.seconds},
          {"error", r.error}};
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

Summary summarise(const std::vector<Result>& results, const Targets& targets) {
  Summary summary;
  for (const Result& result : results) {
    summary.seconds += result.seconds;
    if (!result.error.empty()) {
      ++summary.errors;
      continue;
    }
    const int named = result.first.empty() ? 0 : 1;
    switch (result.one.kind) {
      case Kind::hidden:
        add_hidden(result, targets, summary);
        break;
      case Kind::none:
        ++summary.none;
        summary.named_on_none += named;
        break;
      case Kind::removed:
      case Kind::foreign:
        ++summary.removed;
        summary.confident_wrong += result.verdict == "missing" ? 1 : 0;
        break;
    }
  }
  return summary;
}

bool targets_met(const Summary& summary, const Targets& targets) {
  return summary.errors == 0 && right_share(summary) >= targets.right_share && summary.above_floor == 0 &&
         summary.named_on_none <= targets.named_on_none && summary.confident_wrong <= targets.confident_wrong;
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
                          row.effect + "@" + row.at, row.refitted ? "refit  " : "promise", row.train_after,
                          row.held_out_after, row.remark);
    }
  };
  text += fmt::format("    hidden   {}\n", result.with);
  add("ranking", result.ranking);
  add("leads", result.leads);
  return text;
}

std::string summary_text(const Summary& s, const Targets& t) {
  std::string text = fmt::format("{} hidden effects, {} visible (bare held-out error at least {} floors)\n",
                                 s.hidden, s.visible, kVisible);
  text += fmt::format("  right            {:>4} of {} ({:.1f} %), {} named first; target {:.0f} %: {}\n",
                      s.right, s.visible, 100.0 * right_share(s), s.first, 100.0 * t.right_share,
                      mark(right_share(s) >= t.right_share));
  text += fmt::format("  held-out after   worst {:.3f} floors, {} of the right above {}; target 0: {}\n",
                      s.worst_after, s.above_floor, t.floor, mark(s.above_floor == 0));
  text += fmt::format("nothing hidden     {:>4} of {} cases name an effect; target at most {}: {}\n",
                      s.named_on_none, s.none, t.named_on_none, mark(s.named_on_none <= t.named_on_none));
  text += fmt::format("law removed        {:>4} of {} confident wrong names; target at most {}: {}\n",
                      s.confident_wrong, s.removed, t.confident_wrong,
                      mark(s.confident_wrong <= t.confident_wrong));
  if (s.errors > 0) {
    text += fmt::format("could not be run   {:>4} cases: MISSED\n", s.errors);
  }
  return text + fmt::format("{:.0f} s\n", s.seconds);
}

void write_json(const std::string& file, const std::vector<Result>& results, const Summary& s,
                const Targets& t, std::uint64_t seed) {
  nlohmann::json json{{"seed", seed}, {"cases", nlohmann::json::array()}};
  for (const Result& result : results) {
    json["cases"].push_back(to_json(result));
  }
  json["summary"] = {{"hidden", s.hidden},
                     {"visible", s.visible},
                     {"right", s.right},
                     {"named_first", s.first},
                     {"above_floor", s.above_floor},
                     {"worst_held_out_after", s.worst_after},
                     {"none", s.none},
                     {"named_on_none", s.named_on_none},
                     {"removed", s.removed},
                     {"confident_wrong", s.confident_wrong},
                     {"errors", s.errors},
                     {"seconds", s.seconds},
                     {"targets_met", targets_met(s, t)}};
  json["targets"] = {{"right_share", t.right_share},
                     {"held_out_after", t.floor},
                     {"named_on_none", t.named_on_none},
                     {"confident_wrong", t.confident_wrong}};
  std::ofstream out = opened(file);
  out << json.dump(2) << "\n";
  close(out, file);
}

void write_csv(const std::string& file, const std::vector<Result>& results) {
  std::ofstream out = opened(file);
  out << "case,kind,effect,at,strength,with,bare_held_out,visible,verdict,first_named,others_named,set_size,"
         "in_set,"
         "right,held_out_before,held_out_after,seconds,error\n";
  for (const Result& r : results) {
    out << fmt::format("{},{},{},{},{},{},{:.6g},{:d},{},{},{},{},{:d},{:d},{:.6g},{:.6g},{:.3f},{}\n",
                       r.one.name, to_string(r.one.kind), r.one.row.effect, r.one.row.at,
                       to_string(r.one.strength), quoted(r.with), r.bare, r.visible, r.verdict, r.first,
                       r.others, r.set_size, r.in_set, r.right, r.before, r.after, r.seconds,
                       quoted(r.error));
  }
  close(out, file);
}

}  // namespace plumbline::battery
