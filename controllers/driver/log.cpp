#include "controllers/driver/log.h"

#include <dirent.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include "controllers/driver/json.h"

namespace plumbline::driver {
namespace {

constexpr std::size_t kRows = 8192;
constexpr std::size_t kEventText = 24 * sizeof(double);

bool usable_folder(const std::string& folder) {
  if (mkdir(folder.c_str(), 0777) == 0) return true;
  if (errno != EEXIST) return false;
  DIR* const directory = opendir(folder.c_str());
  if (directory == nullptr) return false;
  bool empty = true;
  while (const dirent* entry = readdir(directory)) {
    if (std::strcmp(entry->d_name, ".") != 0 && std::strcmp(entry->d_name, "..") != 0) empty = false;
  }
  closedir(directory);
  errno = ENOTEMPTY;
  return empty;
}

// In a trial a switch is not "measured" in a unit of its own.
std::string trial_unit(const Channel& channel) {
  return channel.kind == ChannelKind::contact ? "1" : channel.unit;
}

std::string trial_column(const Channel& channel) {
  return (channel.kind == ChannelKind::contact ? "contact_" : "q_") + channel.name;
}

// Plain names only: what stands between quotes in YAML must not end them.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out.push_back('\\');
    out.push_back(c);
  }
  return out + "\"";
}

Json histogram_json(const Histogram& histogram) {
  Json json;
  json["count"] = static_cast<double>(histogram.total());
  json["p50_us"] = histogram.quantile(0.5);
  json["p99_us"] = histogram.quantile(0.99);
  json["p99.9_us"] = histogram.quantile(0.999);
  json["max_us"] = static_cast<double>(histogram.largest()) / 1000.0;
  Json::Array bins;
  for (int bin = 0; bin < Histogram::bins; ++bin) {
    if (histogram.count(bin) != 0) {
      bins.emplace_back(Json::Array{Json(bin), Json(static_cast<double>(histogram.count(bin)))});
    }
  }
  json["bins_us_count"] = std::move(bins);
  return json;
}

}  // namespace

const char* to_string(State state) noexcept {
  static constexpr const char* kNames[] = {"waiting", "idle", "holding", "running", "stopped"};
  return kNames[static_cast<int>(state)];
}

Log::Log(const std::string& folder, const Plan& plan, const std::string& model)
    : folder_(folder),
      model_(model),
      plan_(plan),
      channels_(plan.channels.size()),
      commands_(plan.commands.size()),
      log_(plan.log.size()),
      rows_(kHead + channels_ + commands_ + log_, kRows),
      events_(kEventWidth, 256) {
  while (folder_.size() > 1 && folder_.back() == '/') folder_.pop_back();
  if (!usable_folder(folder_))
    throw DriverError(folder_ + ": " + std::strerror(errno) + ", expected a new folder");
  cycles_file_ = open("cycles.csv");
  data_file_ = open("data.csv");
  events_file_ = open("events.txt");
  write_head();
  // Signals are for the loop's thread and the console's: SIGCHLD must end the loop's wait for the controller.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  writer_ = std::thread([this] { write_all(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Log::~Log() {
  over_ = true;
  if (writer_.joinable()) writer_.join();
  for (std::FILE* file : {cycles_file_, data_file_, events_file_}) std::fclose(file);
}

std::FILE* Log::open(const std::string& name) const {
  const std::string path = folder_ + "/" + name;
  std::FILE* const file = std::fopen(path.c_str(), "w");
  if (file == nullptr) throw DriverError(path + ": " + std::strerror(errno));
  return file;
}

void Log::push(const Cycle& cycle) noexcept {
  double* const row = rows_.begin_push();
  if (row == nullptr) return;
  row[0] = cycle.sequence;
  row[1] = static_cast<double>(static_cast<int>(cycle.state));
  row[2] = static_cast<double>(static_cast<int>(cycle.cause));
  row[3] = cycle.missing;
  row[4] = static_cast<double>(cycle.arrival);
  row[5] = static_cast<double>(cycle.sent - cycle.arrival);
  row[6] = static_cast<double>(cycle.controller);
  row[7] = 0.0;
  double* at = std::copy(cycle.channels, cycle.channels + channels_, row + kHead);
  at = std::copy(cycle.commands, cycle.commands + commands_, at);
  std::copy(cycle.log, cycle.log + log_, at);
  rows_.end_push();
}

void Log::event(double seconds, const char* text) noexcept {
  double* const row = events_.begin_push();
  if (row == nullptr) return;
  row[0] = seconds;
  char* const to = reinterpret_cast<char*>(row + 1);
  std::strncpy(to, text, kEventText - 1);
  to[kEventText - 1] = '\0';
  events_.end_push();
}

void Log::write_head() {
  std::fprintf(cycles_file_,
               "sequence [1],state [1],cause [1],missing [1],arrival [s],answer [us],controller [us]");
  std::fprintf(data_file_, "t [s]");
  for (const Channel& channel : plan_.channels) {
    std::fprintf(cycles_file_, ",%s [%s]", channel.name.c_str(),
                 channel.kind == ChannelKind::value ? channel.unit.c_str() : "1");
    std::fprintf(data_file_, ",%s [%s]", trial_column(channel).c_str(), trial_unit(channel).c_str());
  }
  for (const CommandChannel& command : plan_.commands) {
    std::fprintf(cycles_file_, ",u_%s [%s]", command.name.c_str(), command.unit.c_str());
    std::fprintf(data_file_, ",u_%s [%s]", command.name.c_str(), command.unit.c_str());
  }
  for (const std::string& name : plan_.log) {
    std::fprintf(cycles_file_, ",controller_%s [1]", name.c_str());
  }
  std::fprintf(cycles_file_, "\n");
  std::fprintf(data_file_, "\n");
}

void Log::write_all() {
  while (!over_.load()) {
    if (!drain()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  while (drain()) {
  }
}

bool Log::drain() {
  bool any = false;
  while (const double* row = events_.front()) {
    const char* const text = reinterpret_cast<const char*>(row + 1);
    std::fprintf(events_file_, "%.6f %s\n", row[0], text);
    std::fprintf(stdout, "%10.3f s  %s\n", row[0], text);
    events_.pop();
    any = true;
  }
  if (any) {
    std::fflush(events_file_);
    std::fflush(stdout);
  }
  for (int k = 0; k < 1000; ++k) {
    const double* const row = rows_.front();
    if (row == nullptr) break;
    write_row(row);
    rows_.pop();
    any = true;
  }
  return any;
}

void Log::write_row(const double* row) {
  std::fprintf(cycles_file_, "%.0f,%.0f,%.0f,%.0f,%.6f,%.1f,%.3f", row[0], row[1], row[2], row[3],
               1e-9 * row[4], 1e-3 * row[5], 1e-3 * row[6]);
  for (std::size_t k = 0; k < channels_ + commands_ + log_; ++k) {
    std::fprintf(cycles_file_, ",%.15g", row[kHead + k]);
  }
  std::fprintf(cycles_file_, "\n");
  const bool running = static_cast<int>(row[1]) == static_cast<int>(State::running);
  if (running && !trial_over_) {
    write_trial_row(row);
  } else if (trial_begun_) {
    trial_over_ = true;
  }
}

void Log::write_trial_row(const double* row) {
  if (!trial_begun_) first_sequence_ = row[0];
  // A sample that did not come leaves a hole in time: the trial is over there, and what follows is in
  // cycles.csv.
  if (trial_begun_ && row[0] != last_sequence_ + 1.0) {
    trial_missing_ += static_cast<std::uint64_t>(row[0] - last_sequence_) - 1;
    trial_over_ = true;
    return;
  }
  trial_begun_ = true;
  last_sequence_ = row[0];
  ++trial_rows_;
  std::fprintf(data_file_, "%.15g", (row[0] - first_sequence_) * plan_.period);
  for (std::size_t k = 0; k < channels_; ++k) {
    std::fprintf(data_file_, ",%.15g", row[kHead + k] * plan_.channels[k].scale);
  }
  for (std::size_t k = 0; k < commands_; ++k) {
    std::fprintf(data_file_, ",%.15g", row[kHead + channels_ + k]);
  }
  std::fprintf(data_file_, "\n");
}

void Log::write_trial_yaml() const {
  std::FILE* const file = open("trial.yaml");
  std::fprintf(file, "plumbline: trial/1\ntitle: %s\nmodel: %s\nrole: held-out\ndata: data.csv\n",
               quoted(plan_.robot + ", " + plan_.title).c_str(), quoted(model_).c_str());
  std::fprintf(file, "time: {column: t, unit: s}\ncommands:\n");
  for (const CommandChannel& command : plan_.commands) {
    std::fprintf(file, "  %s: {column: u_%s, unit: %s}\n", command.name.c_str(), command.name.c_str(),
                 quoted(command.unit).c_str());
  }
  std::fprintf(file, "measured:\n");
  for (const Channel& channel : plan_.channels) {
    std::fprintf(file, "  %s: {column: %s, unit: %s}\n", channel.name.c_str(), trial_column(channel).c_str(),
                 quoted(trial_unit(channel)).c_str());
  }
  std::fclose(file);
}

void Log::finish(const std::string& notes, const Counts& counts, const Histogram& wake,
                 const Histogram& answer, const Histogram& controller) {
  over_ = true;
  if (writer_.joinable()) writer_.join();
  for (std::FILE* file : {cycles_file_, data_file_, events_file_}) std::fflush(file);
  if (trial_rows_ > 0) write_trial_yaml();
  Json json;
  json["notes"] = notes;
  json["wake_up"] = histogram_json(wake);
  json["sense_to_command"] = histogram_json(answer);
  json["controller_step"] = histogram_json(controller);
  Json& packets = json["packets"];
  const auto number = [](std::uint64_t n) { return Json(static_cast<double>(n)); };
  packets["cycles"] = number(counts.cycles);
  packets["controller_steps"] = number(counts.steps);
  packets["lost"] = number(counts.lost);
  packets["duplicated"] = number(counts.duplicated);
  packets["reordered"] = number(counts.reordered);
  packets["corrupt"] = number(counts.corrupt);
  packets["of_another_session"] = number(counts.foreign);
  packets["not_sent"] = number(counts.unsent);
  json["log"]["rows_lost"] = number(rows_.lost());
  json["log"]["events_lost"] = number(events_.lost());
  json["log"]["trial_rows"] = number(trial_rows_);
  json["log"]["trial_ended_at_missing_packets"] = number(trial_missing_);
  std::FILE* const file = open("timing.json");
  const std::string text = canonical_json(json);
  std::fprintf(file, "%s\n", text.c_str());
  std::fclose(file);
}

}  // namespace plumbline::driver
