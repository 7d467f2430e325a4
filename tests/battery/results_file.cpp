#include "tests/battery/results_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "tests/battery/result_json.h"

namespace plumbline::battery {
namespace {

std::string head_of(const RunOptions& options) {
  nlohmann::json head{{"battery", 1}, {"seed", options.seed}, {"as_stated", options.as_stated}};
  if (options.world != World::own) {
    head["world"] = to_string(options.world);
    head["lab"] = options.lab;
    if (options.tolerances) {
      head["tolerances"] = true;
    }
  }
  return head.dump();
}

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

ResultsFile::ResultsFile(std::string file, const RunOptions& options) : file_(std::move(file)) {
  if (std::filesystem::exists(file_)) {
    read(head_of(options));
  } else {
    append(head_of(options));
  }
}

void ResultsFile::read(const std::string& head) {
  const std::string text = text_of(file_);
  if (text.rfind(head + "\n", 0) != 0) {
    throw std::runtime_error(
        fmt::format("{}:1: found {}, expected {}", file_, text.substr(0, text.find('\n')), head));
  }
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  std::size_t whole = line.size() + 1;
  for (int number = 2; std::getline(lines, line) && !lines.eof(); ++number) {
    try {
      results_.push_back(result_from(nlohmann::json::parse(line)));
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("{}:{}: {}", file_, number, error.what()));
    }
    whole += line.size() + 1;
  }
  std::filesystem::resize_file(file_, whole);
}

const Result* ResultsFile::find(const std::string& name) const {
  const auto found = std::find_if(results_.begin(), results_.end(),
                                  [&](const Result& result) { return result.one.name == name; });
  return found == results_.end() ? nullptr : &*found;
}

void ResultsFile::add(const Result& result) {
  append(to_json(result).dump());
  results_.push_back(result);
}

void ResultsFile::append(const std::string& line) const {
  std::ofstream out(file_, std::ios::app);
  out << line << "\n";
  out.close();
  if (!out) {
    throw std::runtime_error(file_ + ": cannot be written");
  }
}

void add_durations(const std::string& file, work::Durations& durations) {
  std::ifstream in(file);
  if (!in) {
    throw std::runtime_error(file + ": no such file");
  }
  for (std::string line; std::getline(in, line);) {
    const nlohmann::json result = nlohmann::json::parse(line, nullptr, false);
    if (result.is_object() && result.contains("case") && result.contains("processor_seconds")) {
      durations.add(result["case"], result["processor_seconds"]);
    }
  }
}

}  // namespace plumbline::battery
