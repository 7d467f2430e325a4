#include "tests/cli/robot_folder.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace plumbline::test {
namespace {

namespace fs = std::filesystem;

std::string new_folder() {
  std::string pattern = (fs::temp_directory_path() / "plumbline-cli-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error("no temporary folder");
  }
  return pattern;
}

void write_file(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

std::string experiment(const std::string& role, const std::string& duration, const std::string& signal) {
  return "plumbline: experiment/1\ntitle: A short motion\nrole: " + role + "\nduration: {value: " + duration +
         ", unit: s}\nsample_period: {value: 0.002, unit: s}\nstart:\n  shoulder: {value: 0, unit: deg}\n" +
         "commands:\n  drive:\n    - " + signal + "\n";
}

/// The folder that all tests copy, made once and removed when the program ends.
class Original {
 public:
  Original() : path_(new_folder()) {
    fs::copy(fs::path(PLUMBLINE_ROOT) / "tests/robots/pendulum", path_ / "robot",
             fs::copy_options::recursive);
    fs::remove_all(path_ / "robot/experiments");
    write_file(path_ / "experiments/chirp.yaml",
               experiment("train", "2",
                          "{kind: stepped_chirp, from: 0.5 Hz, to: 8 Hz, steps: 5, first_amplitude: 0.4, "
                          "last_amplitude: 1.5, unit: A}"));
    write_file(path_ / "experiments/steps.yaml",
               experiment("train", "2",
                          "{kind: steps, times: [0.1 s, 0.8 s, 1.4 s], levels: [0.4, -0.3, 0.5], unit: A}"));
    write_file(path_ / "experiments/swing.yaml",
               experiment("held-out", "2",
                          "{kind: multisine, frequencies: [0.7 Hz, 2.3 Hz], amplitudes: [0.4, 0.6], phases: "
                          "[0 deg, 130 deg], unit: A}"));
    const Outcome made =
        run({"twin", "--model", "robot/model.yaml", "--with", "coulomb@drive:level=0.008,smoothing_speed=0.5",
             "--experiment", "experiments/chirp.yaml", "experiments/steps.yaml", "experiments/swing.yaml",
             "--out", "trials"},
            path_.string());
    if (made.status != 0) {
      throw std::runtime_error("plumbline twin failed: " + made.err);
    }
  }
  ~Original() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Original(const Original&) = delete;
  Original& operator=(const Original&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

void RobotFolder::SetUp() {
  static const Original original;
  folder = new_folder();
  fs::copy(original.path(), folder, fs::copy_options::recursive);
}

void RobotFolder::TearDown() {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

Outcome RobotFolder::succeed(const std::vector<std::string>& arguments) const {
  Outcome outcome = plumbline(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome;
}

std::string RobotFolder::read(const std::string& name) const {
  std::ifstream in(fs::path(folder) / name, std::ios::binary);
  EXPECT_TRUE(in.is_open()) << "no file " << name;
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

nlohmann::json RobotFolder::read_json(const std::string& name) const {
  nlohmann::json json = nlohmann::json::parse(read(name), nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << name << " is no JSON";
  return json;
}

void RobotFolder::write(const std::string& name, const std::string& text) const {
  write_file(fs::path(folder) / name, text);
}

void RobotFolder::replace(const std::string& name, const std::string& what, const std::string& by) const {
  std::string text = read(name);
  const std::size_t at = text.find(what);
  ASSERT_NE(at, std::string::npos) << "nothing to replace in " << name << ": " << what;
  write(name, text.replace(at, what.size(), by));
}

void RobotFolder::remove(const std::string& name) const { fs::remove_all(fs::path(folder) / name); }

std::map<std::string, std::string> RobotFolder::snapshot() const {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    files[name] = entry.is_regular_file() ? read(name) : "a folder";
  }
  return files;
}

std::vector<std::string> RobotFolder::changed_since(const std::map<std::string, std::string>& before) const {
  const std::map<std::string, std::string> now = snapshot();
  std::vector<std::string> names;
  for (const auto& [name, content] : now) {
    const auto found = before.find(name);
    if (found == before.end() || found->second != content) {
      names.push_back(name);
    }
  }
  for (const auto& [name, content] : before) {
    if (now.count(name) == 0) {
      names.push_back(name);
    }
  }
  return names;
}

std::vector<std::string> keys(const nlohmann::json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) {
    names.push_back(name);
  }
  return names;
}

}  // namespace plumbline::test
