#include "validation/control/certify/ledger.h"

#include <fstream>

#include "simulator/trace/error.h"

namespace plumbline::validation {

using driver::Json;

Ledger::Ledger(const std::string& file, const std::string& identity) : file_(file) {
  if (file.empty()) {
    return;
  }
  Json head;
  head["plumbline"] = "progress/1";
  head["of"] = identity;
  const std::string first = driver::canonical_json(head);
  std::ifstream in(file);
  std::string line;
  if (std::getline(in, line) && line == first) {
    while (std::getline(in, line)) {
      try {
        const Json entry = driver::parse_json(line);
        results_[entry.at("key").text()] = entry.at("result");
      } catch (const driver::DriverError&) {
        break;  // cut off where the program was ended
      }
    }
  }
  in.close();
  std::ofstream out(file, std::ios::trunc);
  out << first << '\n';
  for (const auto& [key, result] : results_) {
    Json entry;
    entry["key"] = key;
    entry["result"] = result;
    out << driver::canonical_json(entry) << '\n';
  }
  if (!out.flush()) {
    throw InputError({file, 0, ""}, "a file that cannot be written", "a place for the progress");
  }
}

const Json* Ledger::find(const std::string& key) const {
  const auto found = results_.find(key);
  return found == results_.end() ? nullptr : &found->second;
}

void Ledger::add(const std::string& key, const Json& result) {
  results_[key] = result;
  if (file_.empty()) {
    return;
  }
  Json entry;
  entry["key"] = key;
  entry["result"] = result;
  std::ofstream(file_, std::ios::app) << driver::canonical_json(entry) << std::endl;
}

}  // namespace plumbline::validation
