#include "validation/batch/batch_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "validation/batch/value_drawing.h"
#include "validation/batch/values.h"
#include "validation/report/page.h"

namespace plumbline::batch {
namespace {

using nlohmann::json;
using validation::html_text;

constexpr const char* kStyle = R"(
body { font: 15px/1.45 system-ui, sans-serif; color: #222; margin: 2em auto; max-width: 70em; padding: 0 1em; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin-top: 2em; }
table { border-collapse: collapse; } th, td { text-align: left; padding: .25em .8em .25em 0; vertical-align: top; }
th { border-bottom: 1px solid #888; font-weight: 600; } td { border-bottom: 1px solid #e4e4e4; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.failed { color: #a01818; } .marked { font-weight: 600; } .note { color: #555; }
.values { display: flex; flex-wrap: wrap; gap: 1.2em; }
figure { margin: 0; border: 1px solid #ddd; padding: .6em; } figcaption { font-size: .9em; max-width: 26em; }
svg text { font: 11px system-ui, sans-serif; fill: #444; }
.key span { display: inline-block; margin-right: 1.2em; } .key i { display: inline-block; width: .8em; height: .8em;
  border-radius: 50%; margin-right: .35em; }
@media print { figure { break-inside: avoid; } }
)";

std::string text_of(const json& row, const char* key) { return html_text(row.value(key, "")); }

std::string labels(const std::vector<std::size_t>& of, const std::vector<json>& rows) {
  std::string text;
  for (const std::size_t row : of) {
    text += (text.empty() ? "" : ", ") + text_of(rows[row], "label");
  }
  return text;
}

std::string with_interval(const ValueOverRows& value) {
  const std::string mean = fmt::format("{:.4g}", value.mean);
  return value.lower < value.upper ? fmt::format("{} ({:.4g} to {:.4g})", mean, value.lower, value.upper)
                                   : mean;
}

std::size_t diagnosed(const std::vector<json>& rows) {
  return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [](const json& row) {
    return row.value("status", "") == "done" && row.value("mode", "") == "diagnose";
  }));
}

std::string effects_part(const std::vector<json>& rows) {
  const std::size_t count = diagnosed(rows);
  if (count == 0) {
    return "";
  }
  std::string page = "<h2>Which effects, where</h2>\n";
  const std::vector<EffectOverRows> effects = effects_over(rows);
  if (effects.empty()) {
    return page + fmt::format("<p>No effect was named in any of {} diagnosed rows.</p>\n", count);
  }
  page += "<table><tr><th>effect</th><th>at</th><th>named in</th><th>rows</th><th>a rival in</th></tr>\n";
  for (const EffectOverRows& effect : effects) {
    page +=
        fmt::format("<tr><td>{}</td><td>{}</td><td class=number>{} of {}</td><td>{}</td><td>{}</td></tr>\n",
                    html_text(effect.effect), html_text(effect.at), effect.named.size(), count,
                    labels(effect.named, rows), labels(effect.rival, rows));
  }
  return page + "</table>\n";
}

std::string key_part(const RobotColours& colours) {
  if (colours.names().size() < 2) {
    return "";
  }
  std::string page = "<p class=key>";
  for (const std::string& robot : colours.names()) {
    page += fmt::format("<span><i style=\"background:{}\"></i>{}</span>", colours.of(robot),
                        robot.empty() ? "no robot stated" : html_text(robot));
  }
  return page + "</p>\n";
}

std::string caption_of(const ValueOverRows& value) {
  std::string text =
      fmt::format("<b>{}</b> {}: {} in {} {}", html_text(value.name), html_text(value.unit),
                  with_interval(value), value.rows.size(), value.rows.size() == 1 ? "row" : "rows");
  if (value.differs) {
    text += fmt::format("; <span class=marked>differs between rows (p = {:.1g})</span>", value.probability);
  }
  for (const Drift& drift : value.drifts) {
    if (drift.drifts()) {
      text += fmt::format("; <span class=marked>drifts{}{}: {:+.3g} +- {:.2g} a day</span>",
                          drift.robot.empty() ? "" : " on ", html_text(drift.robot), drift.slope,
                          drift.deviation);
    }
  }
  return text;
}

std::string values_part(const std::vector<ValueOverRows>& values, const std::vector<json>& rows,
                        const RobotColours& colours) {
  if (values.empty()) {
    return "";
  }
  std::string page =
      "<h2>Values</h2>\n<p class=note>Dots with 95 % intervals, over days where rows state them, else in the "
      "order of the rows. Grey: the mean of all rows with its 95 % interval.</p>\n" +
      key_part(colours) + "<div class=values>\n";
  for (const ValueOverRows& value : values) {
    page += "<figure>" + drawing_of(value, rows, colours) + "<figcaption>" + caption_of(value) +
            "</figcaption></figure>\n";
  }
  return page + "</div>\n";
}

std::string drifts_part(const std::vector<ValueOverRows>& values) {
  std::string lines;
  std::size_t looked_at = 0;
  for (const ValueOverRows& value : values) {
    for (const Drift& drift : value.drifts) {
      ++looked_at;
      lines += fmt::format(
          "<tr><td>{}</td><td>{}</td><td class=number>{}</td><td class=number>{:+.3g} +- {:.2g}</td>"
          "<td>{} per day</td><td{}>{}</td></tr>\n",
          html_text(value.name), html_text(drift.robot), drift.days, drift.slope, drift.deviation,
          html_text(value.unit), drift.drifts() ? " class=marked" : "", drift.drifts() ? "drifts" : "no");
    }
  }
  if (looked_at == 0) {
    return "";
  }
  return fmt::format(
             "<h2>What drifts</h2>\n<p class=note>A straight line over the days of each robot. It drifts "
             "where "
             "zero is outside, at 5 % for all {} lines together.</p>\n<table><tr><th>value</th><th>robot</th>"
             "<th>days</th><th>slope</th><th></th><th>drifts</th></tr>\n",
             looked_at) +
         lines + "</table>\n";
}

std::string error_text(const json& row, const char* role) {
  const json errors = row.value("errors", json::object());
  const auto found = errors.find(role);
  return found != errors.end() && found->is_number() ? fmt::format("{:.3f}", found->get<double>()) : "";
}

std::string outcome_of(const json& row) {
  if (row.value("status", "") != "done") {
    return "<span class=failed>failed: " + text_of(row, "why") + "</span>";
  }
  const json& result = row.at("result");
  return row.value("mode", "") == "diagnose" ? html_text(result.value("summary", "")) : row.value("mode", "");
}

std::string rows_part(const std::vector<json>& rows) {
  std::string page =
      "<h2>Rows</h2>\n<p class=note>Errors in floors (1: what the sensors alone leave), of the row's last "
      "model.</p>\n<table><tr><th>row</th><th>robot</th><th>day</th><th>train</th><th>held-out</th>"
      "<th>outcome</th></tr>\n";
  for (const json& row : rows) {
    page += fmt::format(
        "<tr><td><a href=\"rows/{0}.json\">{0}</a></td><td>{1}</td><td>{2}</td><td class=number>{3}</td>"
        "<td class=number>{4}</td><td>{5}</td></tr>\n",
        text_of(row, "label"), text_of(row, "robot"), text_of(row, "day"), error_text(row, "train"),
        error_text(row, "held_out"), outcome_of(row));
  }
  return page + "</table>\n";
}

std::string head_sentence(const std::vector<json>& rows) {
  const auto failed = std::count_if(rows.begin(), rows.end(),
                                    [](const json& row) { return row.value("status", "") != "done"; });
  std::string text = fmt::format("<p>{} {}", rows.size(), rows.size() == 1 ? "row" : "rows");
  if (failed > 0) {
    text += fmt::format("; <span class=failed>{} failed</span>, and {} in nothing but the list of rows",
                        failed, failed == 1 ? "is" : "are");
  }
  return text + ".</p>\n";
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) {
    return text;
  }
  std::string safe = "\"";
  for (const char c : text) {
    safe += c == '"' ? "\"\"" : std::string(1, c);
  }
  return safe + '"';
}

/// The shortest digits that read back the same.
std::string digits(double value) { return fmt::format("{}", value); }

std::string csv_head_of(const json& row) {
  const json result = row.value("result", json::object());
  std::string line;
  for (const std::string& cell :
       {row.value("label", ""), row.value("robot", ""), row.value("day", ""), row.value("mode", ""),
        row.value("status", ""), row.value("why", ""), result.value("verdict", "")}) {
    line += quoted(cell) + ",";
  }
  const json errors = row.value("errors", json::object());
  for (const char* role : {"train", "held_out"}) {
    const auto found = errors.find(role);
    line += (found != errors.end() && found->is_number() ? digits(found->get<double>()) : "") + ",";
  }
  return line;
}

}  // namespace

std::string page_of(const std::string& title, const std::vector<json>& rows) {
  const std::vector<ValueOverRows> values = values_over(rows);
  const RobotColours colours(rows);
  return "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>\n<title>" + html_text(title) +
         "</title>\n<style>" + kStyle + "</style></head><body>\n<h1>" + html_text(title) + "</h1>\n" +
         head_sentence(rows) + effects_part(rows) + values_part(values, rows, colours) + drifts_part(values) +
         rows_part(rows) + "</body></html>\n";
}

std::string csv_of(const std::vector<json>& rows) {
  std::string text =
      "label,robot,day,mode,status,why,verdict,train,held_out,value,unit,estimate,standard_deviation,lower,"
      "upper\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::string head = csv_head_of(rows[r]);
    const std::vector<NamedValue> values = values_of(rows[r], r);
    for (const NamedValue& one : values) {
      const RowValue& value = one.value;
      text += fmt::format("{}{},{},{},{},{},{}\n", head, quoted(one.name), quoted(one.unit),
                          digits(value.value), value.deviation > 0.0 ? digits(value.deviation) : "",
                          digits(value.lower), digits(value.upper));
    }
    if (values.empty()) {
      text += head + ",,,,,\n";
    }
  }
  return text;
}

}  // namespace plumbline::batch
