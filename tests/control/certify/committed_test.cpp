// The certificates that come with the robots: signed by the key beside them, canonical, and what they say
// follows from the runs that they hold. Which of their files have changed since is printed, and is no
// failure: a certificate is made again when its robot is finished, not with every edit (docs/driving.md).
#include <gmock/gmock.h>

#include <filesystem>
#include <set>

#include "controllers/driver/certificate.h"
#include "controllers/driver/plan.h"
#include "controllers/driver/signature.h"
#include "simulator/run/scenario.h"
#include "validation/control/certify/lasting.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;
using driver::Certificate;
using driver::Json;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> committed() {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(PLUMBLINE_ROOT "/robots")) {
    if (entry.path().extension() == ".cert") {
      found.push_back(fs::relative(entry.path(), PLUMBLINE_ROOT).string());
    }
  }
  return found;
}

class Committed : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { certificate = driver::read_certificate(PLUMBLINE_ROOT "/" + GetParam()); }
  Certificate certificate;
};

TEST_P(Committed, IsSignedByAKeyBesideIt) {
  int keys = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(certificate.file).parent_path())) {
    const std::string text = driver::read_bytes(entry.path().string());
    EXPECT_THAT(text, testing::Not(HasSubstr("PRIVATE KEY"))) << entry;
    keys += entry.path().extension() == ".pub" && driver::public_key(text) == certificate.key ? 1 : 0;
  }
  EXPECT_EQ(keys, 1);
}

// Whoever clones the repository has every file at the same place: below its root, named from the certificate.
TEST_P(Committed, NamesNothingOutsideTheRepository) {
  const fs::path folder = fs::path(GetParam()).parent_path();
  std::set<std::string> roles;
  for (const driver::CertifiedFile& file : driver::certified_files(certificate)) {
    ASSERT_FALSE(fs::path(file.file).is_absolute()) << file.file;
    const std::string from_root = (folder / file.file).lexically_normal().string();
    const bool library = file.role == "controller library";
    EXPECT_THAT(from_root, StartsWith(library ? "build/controllers/" : "robots/"));
    roles.insert(file.role);
  }
  for (const char* role :
       {"controller library", "constants and wiring", "scenario", "model", "skeleton", "requirements"}) {
    EXPECT_EQ(roles.count(role), 1U) << role;
  }
}

// What was reached, counted again from the runs.
TEST_P(Committed, SaysWhatItsRunsShow) {
  const Json& body = certificate.body;
  std::map<std::string, int> runs, lasted;
  for (const auto& [key, run] : body.at("runs").object()) {
    const std::string what = key.substr(0, key.find(' '));
    if (what == "gait" || what == "orbit") continue;
    ++runs[what];
    if (run.at("end").text().empty()) {
      ++lasted[what];
      EXPECT_EQ(run.at("supervisor").text(), "") << key;
    }
  }
  const std::map<std::string, std::string> names{{"start", "random starts"},
                                                 {"robot", "robots drawn"},
                                                 {"noise", "sensor noise"},
                                                 {"wire", "samples lost"},
                                                 {"terrain", "steps of up to"}};
  int found = 0;
  for (const Json& one : body.at("requirements").array()) {
    EXPECT_TRUE(one.at("holds").boolean()) << one.at("name").text();
    for (const auto& [what, name] : names) {
      if (one.at("name").text().find(name) == std::string::npos) continue;
      ++found;
      EXPECT_THAT(one.at("reached").text(), HasSubstr("(" + std::to_string(lasted[what]) + ")")) << name;
      EXPECT_THAT(one.at("required").text(), HasSubstr(" of " + std::to_string(runs[what]) + " runs"))
          << name;
    }
  }
  EXPECT_EQ(found, static_cast<int>(runs.size()));
}

// The driver can be loaded with it, and its limits are no narrower than what the lasting runs had.
TEST_P(Committed, HasLimitsThatTheDriverCanTake) {
  const driver::Plan plan = driver::plan_from(certificate.body);
  for (const auto& [key, run] : certificate.body.at("runs").object()) {
    if (key.rfind("gait", 0) == 0 || key == "orbit" || !run.at("end").text().empty()) continue;
    for (std::size_t c = 0; c < plan.channels.size(); ++c) {
      EXPECT_GT(plan.channels[c].speed, run.at("rate").array()[c].number()) << key << plan.channels[c].name;
    }
    for (std::size_t m = 0; m < plan.commands.size(); ++m) {
      EXPECT_GE(plan.commands[m].limit, run.at("command").array()[m].number())
          << key << plan.commands[m].name;
    }
  }
}

TEST_P(Committed, ItsFilesAsTheyAreNow) {
  const std::string libraries = certificate.body.at("versions").at("libraries").text();
  std::string changed;
  for (const driver::CertifiedFile& file : driver::certified_files(certificate)) {
    const std::string path = driver::path_of(certificate, file.file);
    const bool library = file.role == "controller library";
    if (library && libraries != PLUMBLINE_LIBRARIES) continue;  // another compiler: other bytes
    if (!fs::exists(path)) {
      EXPECT_TRUE(library) << path;  // another build folder
    } else if (driver::sha256_of_file(path) != file.sha256) {
      changed += "\n  " + fs::path(path).lexically_relative(PLUMBLINE_ROOT).lexically_normal().string();
    }
  }
  if (!changed.empty()) {
    GTEST_SKIP() << GetParam()
                 << " is no longer valid (docs/driving.md says how it is made again). Changed since:"
                 << changed;
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, Committed, ::testing::ValuesIn(committed()),
                         [](const auto& one) { return fs::path(one.param).stem().string(); });

}  // namespace
}  // namespace plumbline::validation
