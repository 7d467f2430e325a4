// The pieces of a certificate: ledger, limits, the driver's part read back, requirements that are refused.
#include "validation/control/certify/certify.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "controllers/driver/certificate.h"
#include "simulator/trace/error.h"
#include "validation/control/certify/drive_part.h"
#include "validation/control/certify/lasting.h"
#include "validation/control/certify/ledger.h"
#include "validation/control/certify/probe.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;
using driver::Json;

class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "certify-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() { fs::remove_all(path_); }
  std::string path(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

const std::string kHopping = PLUMBLINE_ROOT "/robots/mabel/certify/hopping.yaml";

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Ledger, GoesOnWhereItWas) {
  const Folder folder;
  const std::string file = folder.path("a.progress");
  {
    Ledger ledger(file, "one");
    ledger.add("start 0", Json(3));
    ledger.add("start 1", Json(4));
  }
  std::ofstream(file, std::ios::app) << "{\"key\":\"start 2\",\"res";  // ended while it was written
  Ledger again(file, "one");
  EXPECT_EQ(again.size(), 2U);
  EXPECT_EQ(again.find("start 1")->number(), 4.0);
  EXPECT_EQ(again.find("start 2"), nullptr);
  Ledger other(file, "two");  // a file has changed: nothing is known
  EXPECT_EQ(other.size(), 0U);
}

TEST(DrivePart, LimitsAreRoundedUpToTwoDigits) {
  driver::Plan plan;
  plan.channels.push_back({"a", "rad", driver::ChannelKind::count, 1.0, driver::kNone, driver::kNone});
  plan.channels.push_back({"still", "rad", driver::ChannelKind::count, 1.0, driver::kNone, driver::kNone});
  plan.commands.push_back({"m", "N m", 30.0, driver::kNone, {}});
  Extremes largest;
  largest.rate = Eigen::Vector2d(6.17, 0.0);
  largest.rest = Eigen::Vector2d(0.0123, 5.0);
  largest.slew = Eigen::VectorXd::Constant(1, 4000.0);
  take_limits(plan, largest, 2.0, 3.0, 1.5);
  EXPECT_EQ(plan.channels[0].speed, 13.0);
  EXPECT_EQ(plan.channels[0].rest, 0.037);
  EXPECT_EQ(plan.channels[1].speed, driver::kNone);
  EXPECT_EQ(plan.channels[1].rest, driver::kNone);
  EXPECT_EQ(plan.commands[0].slew, 6000.0);
}

class OfHopping : public ::testing::Test {
 protected:
  OfHopping()
      : requirements_(read_requirements(kHopping)), loaded_(run::read_scenario(requirements_.scenario)) {
    add_published(requirements_);
    complete_drive(requirements_, loaded_);
  }
  Requirements requirements_;
  run::LoadedScenario loaded_;
};

TEST_F(OfHopping, TheDriverReadsBackWhatCertifyWrites) {
  driver::Plan& plan = requirements_.drive;
  plan.library = "x.so";
  Json body;
  body["title"] = plan.title;
  body["model"] = "m.yaml";
  body["controller"] = controller_json(plan);
  body["drive"] = drive_json(plan);
  const driver::Plan back = driver::plan_from(driver::parse_json(driver::canonical_json(body)));
  EXPECT_EQ(back.channel_names(), plan.channel_names());
  EXPECT_EQ(back.constants, plan.constants);
  EXPECT_EQ(back.inputs.size(), 13U);
  EXPECT_EQ(back.channels[0].scale, plan.channels[0].scale);
  EXPECT_EQ(driver::canonical_json(drive_json(back)), driver::canonical_json(drive_json(plan)));
}

TEST_F(OfHopping, NamesEveryFileItStandsOn) {
  std::string roles;
  for (const NamedFile& file : files_of(requirements_, loaded_)) {
    EXPECT_TRUE(fs::exists(file.path)) << file.path;
    roles += file.role + ";";
  }
  for (const char* role : {"controller library", "constants and wiring", "scenario", "model", "skeleton",
                           "requirements", "reference data"}) {
    EXPECT_NE(roles.find(role), std::string::npos) << role;
  }
}

// Equal seeds give equal runs, to the last digit; the wire's faults change them.
TEST_F(OfHopping, ARunCanBeRepeated) {
  const Gait gait = read_gait(loaded_).value();
  LastingOptions options;
  options.cycles = 2;
  options.keep = 500;
  const LastingRun one = last(loaded_, gait, requirements_.drive, options);
  const LastingRun two = last(loaded_, gait, requirements_.drive, options);
  EXPECT_EQ(one.cycles, 2);
  EXPECT_EQ(driver::canonical_json(to_json(one)), driver::canonical_json(to_json(two)));
  EXPECT_EQ(driver::canonical_json(to_json(lasting_run_from(to_json(one)))),
            driver::canonical_json(to_json(one)));
  options.wire.lost = 0.05;
  EXPECT_NE(driver::canonical_json(to_json(last(loaded_, gait, requirements_.drive, options))),
            driver::canonical_json(to_json(one)));

  const Probed probed =
      probe_controller(loaded_.controller->library.path(), requirements_.drive, one.channels);
  EXPECT_EQ(probed.steps, 20000);
  EXPECT_EQ(probed.allocations, 0);
  EXPECT_GT(probed.p999, 0.0);
}

/// Does nothing: notes the order in which tasks would be begun, and is stopped after the first one.
class Asked : public work::Workers {
 public:
  work::Results run(const std::vector<work::Task>& tasks, const work::Watch& watch) override {
    begun.clear();
    for (const std::size_t task : work::order_of(tasks)) {
      begun.push_back(tasks[task].name);
    }
    watch.done(0, "{}", 0.5);
    return {true, {}};
  }
  std::vector<std::string> begun;
};

TEST(Certify, BeginsWithTheRunsThatTookLongestBefore) {
  const Folder folder;
  Asked workers;
  CertifyOptions options;
  options.certificate = folder.path("a.cert");
  options.durations = folder.path("a.cert.durations");
  options.workers = &workers;
  EXPECT_THROW(certify(kHopping, options), Stopped);
  const std::vector<std::string> first = workers.begun;
  ASSERT_GT(first.size(), 10U);
  EXPECT_EQ(text_of(options.durations), "task,seconds\n" + first[0] + ",0.500000\n");

  std::ofstream out(options.durations);
  out << "task,seconds\n";
  for (std::size_t k = 0; k < first.size(); ++k) {
    out << first[k] << ',' << k + 1 << '\n';
  }
  out.close();
  EXPECT_THROW(certify(kHopping, options), Stopped);
  EXPECT_EQ(workers.begun, std::vector<std::string>(first.rbegin(), first.rend()));
}

TEST(Requirements, WrongOnesAreRefusedInOneLine) {
  const Folder folder;
  const std::string good = text_of(kHopping);
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    std::ofstream(folder.path("r.yaml")) << text.replace(at, from.size(), to);
    try {
      read_requirements(folder.path("r.yaml"));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal("runs: 12", "runs: -1").find("runs"), std::string::npos);
  EXPECT_NE(refusal("workspace_margin:", "workspace_margine:").find("workspace_margine"), std::string::npos);
  EXPECT_NE(refusal("allocations: 0", "allocations: 3").find("allocations"), std::string::npos);
  EXPECT_NE(refusal("requirements/1", "requirements/2").find("requirements/1"), std::string::npos);
}

}  // namespace
}  // namespace plumbline::validation
