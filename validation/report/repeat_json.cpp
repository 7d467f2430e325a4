#include "validation/report/repeat_json.h"

#include <set>

#include "simulator/trace/sha256.h"

namespace plumbline::validation {
namespace {

using nlohmann::json;

/// Each file once, in the order of its first mention.
class FileList {
 public:
  void add(const std::string& kind, const std::string& file) {
    if (!file.empty() && seen_.insert(file).second) {
      list_.push_back({{"file", file}, {"kind", kind}, {"sha256", sha256_of_file(file)}});
    }
  }
  const json& list() const { return list_; }

 private:
  std::set<std::string> seen_;
  json list_ = json::array();
};

json files_json(const Repetition& repetition, const model::Model& model, const std::vector<Trial>& trials) {
  FileList files;
  for (const std::string& file : repetition.models) {
    files.add("model", file);
  }
  files.add("skeleton", model.skeleton.file);
  for (const Trial& trial : trials) {
    files.add("trial", trial.file);
    files.add("data", trial.data_file);
  }
  for (const std::string& file : repetition.others) {
    files.add("diagnosis", file);
  }
  return files.list();
}

std::string program_hash() { return sha256_of_file("/proc/self/exe"); }

}  // namespace

std::string inputs_hash(const model::Model& model, const std::vector<Trial>& trials) {
  Repetition inputs;
  inputs.models = model.lineage;
  std::string hashes = program_hash();
  for (const json& file : files_json(inputs, model, trials)) {
    hashes += '\n' + file["sha256"].get<std::string>();
  }
  return sha256_of(hashes);
}

std::string shell_line(const std::vector<std::string>& words) {
  static const std::string kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  std::string line;
  for (const std::string& word : words) {
    line += line.empty() ? "" : " ";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) {
      line += c == '\'' ? "'\\''" : std::string(1, c);
    }
    line += '\'';
  }
  return line;
}

json repeat_json(const Repetition& repetition, const model::Model& model, const std::vector<Trial>& trials) {
  return {{"version", PLUMBLINE_VERSION},
          {"program", program_hash()},
          {"compiler", PLUMBLINE_COMPILER},
          {"libraries", json::parse(PLUMBLINE_LIBRARIES)},
          {"command", shell_line(repetition.command)},
          {"window", repetition.window},
          {"seed", repetition.resampled ? json(repetition.seed) : json()},
          {"files", files_json(repetition, model, trials)}};
}

}  // namespace plumbline::validation
