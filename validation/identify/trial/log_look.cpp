#include "validation/identify/trial/log_look.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "simulator/trace/units.h"

namespace plumbline::validation {
namespace {

constexpr double kDegree = 57.29577951308232;
constexpr double kGapSteps = 5.0;

/// The words of a name: "Joint1_dqDes" gives joint, 1, dq, des.
std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words;
  char before = '_';
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    const auto b = static_cast<unsigned char>(before);
    const bool is_letter = std::isalpha(u) != 0;
    const bool is_digit = std::isdigit(u) != 0;
    if (is_letter || is_digit) {
      const bool begins = (std::isalnum(b) == 0) || (is_digit != (std::isdigit(b) != 0)) ||
                          (std::isupper(u) != 0 && std::islower(b) != 0);
      if (begins) {
        words.emplace_back();
      }
      words.back() += static_cast<char>(std::tolower(u));
    }
    before = c;
  }
  return words;
}

struct Vocabulary {
  ColumnRole role;
  std::set<std::string> words;
};

/// The first entry with one of the name's words decides: "q_des" is a reference, "dq" no position.
const std::vector<Vocabulary>& vocabulary() {
  static const std::vector<Vocabulary> all{
      {ColumnRole::time,
       {"t", "time", "timestamp", "stamp", "sec", "secs", "seconds", "tick", "ticks", "clock"}},
      {ColumnRole::reference,
       {"ref", "reference", "des", "desired", "goal", "target", "setpoint", "sp", "qd", "qdes", "qref", "qg",
        "demand"}},
      {ColumnRole::contact, {"contact", "contacts", "switch", "touch", "touchdown", "stance"}},
      {ColumnRole::command,
       {"u",   "tau", "torque", "torques", "trq",  "cmd",   "command", "effort", "current", "amps",
        "amp", "iq",  "pwm",    "voltage", "volt", "volts", "vir",     "input",  "duty",    "curr"}},
      {ColumnRole::rate,
       {"v", "vel", "velocity", "velocities", "dq", "qdot", "dtheta", "dphi", "omega", "w", "speed", "rate",
        "gyro", "rpm"}},
      {ColumnRole::force, {"fx", "fy", "fz", "force", "forces", "grf", "load"}},
      {ColumnRole::position,
       {"q",     "pos",    "position", "positions", "angle", "angles", "theta",       "phi",
        "alpha", "beta",   "enc",      "encoder",   "joint", "x",      "y",           "z",
        "qm",    "height", "roll",     "pitch",     "yaw",   "stroke", "displacement"}}};
  return all;
}

ColumnRole role_of_name(const std::string& name, std::string& why) {
  const std::vector<std::string> words = words_of(name);
  for (const Vocabulary& entry : vocabulary()) {
    for (const std::string& word : words) {
      if (entry.words.count(word) != 0) {
        why = "\"" + word + "\" in its name";
        return entry.role;
      }
    }
  }
  return ColumnRole::other;
}

/// What the unit alone says, and whether it agrees with the name.
void look_at_unit(ColumnLook& column) {
  if (column.unit.empty()) {
    return;
  }
  const auto is = [&](const char* unit) { return units_agree(column.unit, unit); };
  ColumnRole role = column.role;
  if (is("N m") || is("A") || is("V")) {
    role = ColumnRole::command;
  } else if (is("rad/s") || is("m/s")) {
    role = is("Hz") && column.unit == "Hz" ? role : ColumnRole::rate;
  } else if (is("N") && role == ColumnRole::position) {
    role = ColumnRole::force;
  } else if (is("s") && role != ColumnRole::time) {
    role = ColumnRole::other;
  } else if (role == ColumnRole::other && (is("m") || column.unit == "rad" || column.unit == "deg")) {
    role = ColumnRole::position;
  }
  if (role != column.role && column.role != ColumnRole::reference) {
    column.role = role;
    column.why = "its unit";
  }
}

void look_at_values(const Column& from, ColumnLook& look) {
  constexpr std::size_t kCounted = 1000;
  std::set<double> different;
  bool any = false;
  for (const double value : from.values) {
    if (!std::isfinite(value)) {
      ++look.missing;
      continue;
    }
    look.lowest = any ? std::min(look.lowest, value) : value;
    look.highest = any ? std::max(look.highest, value) : value;
    any = true;
    if (different.size() < kCounted) {
      different.insert(value);
    }
  }
  look.values = static_cast<long>(different.size());
  double before = std::numeric_limits<double>::quiet_NaN();
  const double hair = 1e-9 * std::max(std::abs(look.lowest), std::abs(look.highest));
  for (const double value : different) {
    if (value - before > hair) {
      look.step = look.step > 0.0 ? std::min(look.step, value - before) : value - before;
    }
    before = value;
  }
}

/// ColumnLook::scatter.
double scatter_of(const Eigen::VectorXd& values) {
  constexpr int kHighest = 10;
  constexpr double kNormalMedian = 0.6744897501960817;  // of the magnitude of a standard normal number
  std::vector<double> differences;
  for (const double value : values) {
    if (std::isfinite(value)) {
      differences.push_back(value);
    }
  }
  double least = std::numeric_limits<double>::infinity();
  double binomial = 1.0;  // C(2p, p)
  for (int p = 1; p <= kHighest && differences.size() > 2 * kHighest; ++p) {
    for (std::size_t k = 0; k + 1 < differences.size(); ++k) {
      differences[k] = differences[k + 1] - differences[k];
    }
    differences.pop_back();
    binomial *= 2.0 * (2.0 * p - 1.0) / p;
    if (p > 1) {
      std::vector<double> magnitudes(differences.size());
      std::transform(differences.begin(), differences.end(), magnitudes.begin(),
                     [](double d) { return std::abs(d); });
      const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
      std::nth_element(magnitudes.begin(), middle, magnitudes.end());
      least = std::min(least, *middle / (kNormalMedian * std::sqrt(binomial)));
    }
  }
  return std::isfinite(least) ? least : 0.0;
}

bool rises(const Column& column) {
  Eigen::Index rising = 0;
  for (Eigen::Index k = 1; k < column.values.size(); ++k) {
    rising += column.values[k] > column.values[k - 1] ? 1 : 0;
  }
  constexpr double kMost = 0.99;
  return column.values.size() > 2 &&
         static_cast<double>(rising) >= kMost * static_cast<double>(column.values.size() - 1);
}

/// s, ms, us or ns: by the name, by how large an absolute time is, or by the step.
std::string unit_of_time(const ColumnLook& column, double first, double step) {
  for (const std::string& word : words_of(column.name)) {
    for (const char* unit : {"ns", "us", "ms"}) {
      if (word == unit || word == std::string(unit) + "ec") {
        return unit;
      }
    }
    if (word == "nsec" || word == "nanoseconds") {
      return "ns";
    }
    if (word == "usec" || word == "microseconds" || word == "micros") {
      return "us";
    }
    if (word == "msec" || word == "milliseconds" || word == "millis") {
      return "ms";
    }
  }
  // Seconds since 1970 are between 10^9 and 10^10 in this century.
  const std::array<std::pair<const char*, double>, 3> absolute{{{"ns", 1e18}, {"us", 1e15}, {"ms", 1e12}}};
  for (const auto& [unit, scale] : absolute) {
    if (first > scale && first < 10.0 * scale) {
      return unit;
    }
  }
  return step >= 1e5 ? "ns" : step >= 100.0 ? "us" : step >= 0.5 ? "ms" : "s";
}

void look_at_time(const LogFile& log, LogLook& look) {
  for (const bool by_name : {true, false}) {
    for (std::size_t i = 0; i < look.columns.size() && look.time < 0; ++i) {
      const bool named = look.columns[i].role == ColumnRole::time;
      if ((named || (!by_name && i == 0)) && rises(log.table.columns[i])) {
        look.time = static_cast<int>(i);
      }
    }
  }
  for (std::size_t i = 0; i < look.columns.size(); ++i) {
    if (look.columns[i].role == ColumnRole::time && static_cast<int>(i) != look.time) {
      look.columns[i].role = ColumnRole::other;
    }
  }
  if (look.time < 0) {
    return;
  }
  ColumnLook& column = look.columns[static_cast<std::size_t>(look.time)];
  if (column.role != ColumnRole::time) {
    column.role = ColumnRole::time;
    column.why = "the first column, and it rises";
  }
  const Eigen::VectorXd& time = log.table.columns[static_cast<std::size_t>(look.time)].values;
  std::vector<double> steps;
  for (Eigen::Index k = 1; k < time.size(); ++k) {
    if (std::isfinite(time[k]) && std::isfinite(time[k - 1])) {
      look.not_rising += time[k] > time[k - 1] ? 0 : 1;
      if (time[k] > time[k - 1]) {
        steps.push_back(time[k] - time[k - 1]);
      }
    }
  }
  if (steps.empty()) {
    look.time = -1;
    return;
  }
  std::sort(steps.begin(), steps.end());
  const double median = steps[steps.size() / 2];
  if (column.unit.empty() || !units_agree(column.unit, "s")) {
    column.unit = unit_of_time(column, column.lowest, median);
    column.unit_is_guess = true;
  }
  look.time_scale = to_si_factor(column.unit);
  look.start = look.time_scale * column.lowest;
  look.duration = look.time_scale * (column.highest - column.lowest);
  look.median_step = look.time_scale * median;
  look.shortest_step = look.time_scale * steps.front();
  look.longest_step = look.time_scale * steps.back();
  look.gaps =
      std::count_if(steps.begin(), steps.end(), [&](double step) { return step > kGapSteps * median; });
}

/// Correlation of the differences of one column with another, and the factor between them; in the columns'
/// units and seconds. Differences over several rows, so that counting noise does not hide it.
struct Derivative {
  double correlation = 0.0, factor = 0.0;
};

Derivative derivative(const Eigen::VectorXd& position, const Eigen::VectorXd& rate,
                      const Eigen::VectorXd& time) {
  constexpr Eigen::Index kOver = 4;
  double pp = 0.0;
  double rr = 0.0;
  double pr = 0.0;
  for (Eigen::Index k = kOver; k + kOver < position.size(); ++k) {
    const double dt = time[k + kOver] - time[k - kOver];
    const double p = (position[k + kOver] - position[k - kOver]) / dt;
    const double r = rate[k];
    if (std::isfinite(p) && std::isfinite(r) && dt > 0.0) {
      pp += p * p;
      rr += r * r;
      pr += p * r;
    }
  }
  return pp > 0.0 && rr > 0.0 ? Derivative{pr / std::sqrt(pp * rr), pr / pp} : Derivative{};
}

/// What is the rate of a position: the name is only a hint, the numbers say it.
void look_at_rates(const LogFile& log, LogLook& look) {
  constexpr double kSure = 0.9;
  if (look.time < 0) {
    return;
  }
  const Eigen::VectorXd time =
      look.time_scale * log.table.columns[static_cast<std::size_t>(look.time)].values;
  for (std::size_t r = 0; r < look.columns.size(); ++r) {
    ColumnLook& rate = look.columns[r];
    const bool is_clock = !rate.unit.empty() && units_agree(rate.unit, "s");  // another one beside the time
    if (is_clock || (rate.role != ColumnRole::rate && rate.role != ColumnRole::other)) {
      continue;
    }
    Derivative best;
    std::size_t of = 0;
    for (std::size_t p = 0; p < look.columns.size(); ++p) {
      if (look.columns[p].role == ColumnRole::position && look.columns[p].values > 2) {
        const Derivative found = derivative(log.table.columns[p].values, log.table.columns[r].values, time);
        if (std::abs(found.correlation) > std::abs(best.correlation)) {
          best = found;
          of = p;
        }
      }
    }
    if (std::abs(best.correlation) < kSure) {
      continue;
    }
    rate.role = ColumnRole::rate;
    rate.why = "it follows the difference of " + look.columns[of].name;
    const double factor = std::abs(best.factor);
    const auto near = [&](double value) { return factor > 0.8 * value && factor < 1.25 * value; };
    ColumnLook& position = look.columns[of];
    if (rate.unit.empty() && !position.unit.empty()) {
      const bool degrees = position.unit == "deg" || position.unit == "degree";
      rate.unit = near(1.0)                        ? position.unit + "/s"
                  : near(kDegree) && !degrees      ? "deg/s"
                  : near(1.0 / kDegree) && degrees ? "rad/s"
                                                   : "";
      rate.unit_is_guess = true;
    }
  }
}

/// Columns of positions and references without a unit.
void guess_unit(ColumnLook& column) {
  constexpr double kTwoTurns = 13.0;
  if (!column.unit.empty() || column.values < 2) {
    return;
  }
  const double largest = std::max(std::abs(column.lowest), std::abs(column.highest));
  const std::vector<std::string> words = words_of(column.name);
  const auto has = [&](const char* word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  const bool whole = column.step >= 1.0;
  std::string unit;
  switch (column.role) {
    case ColumnRole::position:
    case ColumnRole::reference:
      unit = has("deg") || has("degree") || has("degrees") || (largest > kTwoTurns && !whole) ? "deg" : "rad";
      unit = has("mm") ? "mm" : unit;
      break;
    case ColumnRole::rate:
      unit = has("deg") || largest > 100.0 ? "deg/s" : "rad/s";
      break;
    case ColumnRole::command:
      unit = has("current") || has("amps") || has("amp") || has("iq") || has("curr")     ? "A"
             : has("voltage") || has("volt") || has("volts") || has("vir") || has("pwm") ? "V"
                                                                                         : "N m";
      break;
    case ColumnRole::force:
      unit = "N";
      break;
    case ColumnRole::contact:
      unit = "1";
      break;
    default:
      return;
  }
  column.unit = unit;
  column.unit_is_guess = true;
  if (column.role == ColumnRole::position && whole && largest > kTwoTurns) {
    column.why += "; whole numbers: counts? then give the size of one as `scale`";
  }
}

}  // namespace

std::string to_string(ColumnRole role) {
  switch (role) {
    case ColumnRole::time:
      return "time";
    case ColumnRole::command:
      return "command";
    case ColumnRole::position:
      return "position";
    case ColumnRole::rate:
      return "rate";
    case ColumnRole::reference:
      return "reference";
    case ColumnRole::contact:
      return "contact";
    case ColumnRole::force:
      return "force";
    default:
      return "other";
  }
}

const ColumnLook* LogLook::find(ColumnRole role) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const ColumnLook& column) { return column.role == role; });
  return found == columns.end() ? nullptr : &*found;
}

LogLook look_at(const LogFile& log) {
  LogLook look;
  look.file = log.table.file;
  look.rows = static_cast<long>(log.table.rows());
  look.remarks = log.remarks;
  look.topics = log.topics;
  for (const Column& column : log.table.columns) {
    ColumnLook one;
    one.name = column.name;
    one.unit = column.unit;
    look_at_values(column, one);
    one.scatter = scatter_of(column.values);
    const auto bad = log.bad.find(column.name);
    if (bad != log.bad.end() && !bad->second.missing) {
      one.text = bad->second.text;
    }
    one.role = one.values > 0 ? role_of_name(column.name, one.why) : ColumnRole::other;
    look_at_unit(one);
    if (one.values == 2 && one.lowest == 0.0 && one.highest == 1.0 && one.role != ColumnRole::command) {
      one.role = ColumnRole::contact;
      one.why = "0 and 1 alone";
    }
    look.columns.push_back(std::move(one));
  }
  look_at_time(log, look);
  for (ColumnLook& column : look.columns) {
    if (column.role == ColumnRole::position) {
      guess_unit(column);
    }
  }
  look_at_rates(log, look);
  for (ColumnLook& column : look.columns) {
    guess_unit(column);
  }
  return look;
}

}  // namespace plumbline::validation
