// `plumbline key`, `certify` and `verify` as a user runs them, on requirements that take seconds.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string kRobot = PLUMBLINE_ROOT "/robots/mabel";

/// A copy of the robot with requirements of two hops.
class Certify : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder.path("mabel"));
    for (const char* part : {"controllers", "scenarios", "certify", "published", "meshes", "measured"}) {
      fs::copy(kRobot + "/" + part, folder.path(std::string("mabel/") + part), fs::copy_options::recursive);
    }
    for (const auto& entry : fs::directory_iterator(kRobot)) {
      if (entry.is_regular_file()) {
        fs::copy(entry.path(), folder.path("mabel/" + entry.path().filename().string()));
      }
    }
    std::string text = folder.read("mabel/certify/hopping.yaml");
    const std::size_t from = text.find("required:\n"), to = text.find("\n# What the driver watches");
    ASSERT_NE(to, std::string::npos);
    text.replace(from, to - from,
                 "required:\n"
                 "  published: [{file: ../published.yaml, gait: hopping, names: [travel of a hop]}]\n"
                 "  starts: {runs: 2, at_least: {value: 0.5, unit: \"1\", assumed: \"test\"}}\n"
                 "  allocations: 0\n");
    replace(text, "cycles: 92", "cycles: 10");
    requirements = folder.write("mabel/certify/small.yaml", text);
    succeed({"key", "new", "lab.key"});
  }

  static void replace(std::string& text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), by);
  }
  Outcome succeed(const std::vector<std::string>& arguments) const {
    Outcome outcome = run(arguments, folder.path("."));
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    return outcome;
  }
  Outcome certify(const std::string& certificate, const std::string& body = "body.json") const {
    return run(
        {"certify", requirements, "--key", "lab.key", "-o", certificate, "--body", body, "--threads", "1"},
        folder.path("."));
  }

  TemporaryFolder folder;
  std::string requirements;
};

TEST_F(Certify, SignsWhatHoldsAndRefusesOneChangedByte) {
  const Outcome first = certify("a.cert");
  ASSERT_EQ(first.status, 0) << first.out << first.err;
  EXPECT_THAT(first.out, HasSubstr("random starts"));
  EXPECT_THAT(first.out, HasSubstr("travel of a hop (Park et al. sidebar 2"));
  EXPECT_THAT(first.out, Not(HasSubstr("FAILS")));
  EXPECT_THAT(succeed({"verify", "a.cert", "--key", "lab.pub"}).out,
              HasSubstr("every file is the certified one"));

  // The same input: the same body, byte for byte, from the ledger and from new runs.
  const std::string body = folder.read("body.json");
  EXPECT_EQ(certify("a.cert").status, 0);
  EXPECT_EQ(folder.read("body.json"), body);
  fs::remove(folder.path("a.cert.progress"));
  EXPECT_EQ(certify("a.cert").status, 0);
  EXPECT_EQ(folder.read("body.json"), body);

  // How long runs took decides the order in which they are begun, and nothing else.
  EXPECT_THAT(folder.read("a.cert.durations"), HasSubstr("start 1,"));
  fs::remove(folder.path("a.cert.progress"));
  folder.write("a.cert.durations", "task,seconds\nstart 0,1\ngait 0,2\nstart 1,3\ngait 1,4\n");
  EXPECT_EQ(certify("a.cert").status, 0);
  EXPECT_EQ(folder.read("body.json"), body);

  // One byte of any file: one line that names it.
  for (const nlohmann::json& file : nlohmann::json::parse(body)["files"]) {
    const std::string name = file["file"];
    const fs::path path = fs::path(folder.path(".")) / name;
    if (path.extension() == ".so") continue;  // not ours to change
    std::string text = folder.read(name);
    text[text.size() / 2] ^= 1;
    folder.write(name, text);
    const Outcome refused = run({"verify", "a.cert"}, folder.path("."));
    EXPECT_EQ(refused.status, 1) << name;
    EXPECT_THAT(refused.err, HasSubstr(name + ": is not the file that was certified"));
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    text[text.size() / 2] ^= 1;
    folder.write(name, text);
  }
  succeed({"verify", "a.cert"});

  std::string certificate = folder.read("a.cert");
  certificate[certificate.size() / 2] ^= 1;
  folder.write("b.cert", certificate);
  const Outcome changed = run({"verify", "b.cert"}, folder.path("."));
  EXPECT_EQ(changed.status, 1);
  EXPECT_THAT(changed.err, HasSubstr("b.cert: "));

  EXPECT_EQ(run({"verify", "a.cert", "--date", "2028-01-01"}, folder.path(".")).status, 1);
  succeed({"key", "new", "other.key"});
  EXPECT_EQ(run({"verify", "a.cert", "--key", "other.pub"}, folder.path(".")).status, 1);
  // Keys are not overwritten.
  EXPECT_EQ(run({"key", "new", "lab.key"}, folder.path(".")).status, 2);
}

TEST_F(Certify, AFailureGivesNoCertificate) {
  std::string text = folder.read("mabel/certify/small.yaml");
  replace(text, "starts: {runs: 2",
          "terrain: {runs: 1, at_least: {value: 1, unit: \"1\", assumed: test}, length: "
          "{value: 0.3, unit: m, assumed: test}, height: {value: 0.2, unit: m, assumed: "
          "\"test: no robot hops over this\"}}\n  starts: {runs: 1");
  folder.write("mabel/certify/small.yaml", text);
  const Outcome outcome = certify("c.cert");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("FAILS"));
  EXPECT_THAT(outcome.out, HasSubstr("No certificate"));
  EXPECT_FALSE(fs::exists(folder.path("c.cert")));
  EXPECT_THAT(folder.read("body.json"), HasSubstr("\"holds\":false"));
}

// Broken off by Ctrl-C it keeps what is done, and ends at the body of a run in one piece.
TEST_F(Certify, GoesOnWhereItWas) {
  Process process({"certify", requirements, "--key", "lab.key", "-o", "d.cert", "--threads", "1"},
                  folder.path("."));
  const auto begun = [&] {
    return fs::exists(folder.path("d.cert.progress")) &&
           folder.read("d.cert.progress").find("start 0") != std::string::npos;
  };
  while (process.is_running() && !begun()) usleep(5000);
  process.interrupt();
  EXPECT_EQ(process.wait().status, 130);
  EXPECT_FALSE(fs::exists(folder.path("d.cert")));
  EXPECT_THAT(folder.read("d.cert.progress"), HasSubstr("\"key\":\"start 0\""));
  EXPECT_EQ(certify("d.cert").status, 0);
  const std::string body = folder.read("body.json");
  EXPECT_EQ(certify("e.cert").status, 0);
  EXPECT_EQ(folder.read("body.json"), body);
}

TEST_F(Certify, WrongInputIsOneLine) {
  folder.write("no.key", "nothing\n");
  const Outcome key = run({"certify", requirements, "--key", "no.key", "-o", "f.cert"}, folder.path("."));
  EXPECT_EQ(key.status, 2);
  EXPECT_THAT(key.err, HasSubstr("no.key"));
  EXPECT_EQ(std::count(key.err.begin(), key.err.end(), '\n'), 1) << key.err;
  std::string text = folder.read("mabel/certify/small.yaml");
  replace(text, "names: [travel of a hop]", "names: [travel of a hopp]");
  folder.write("mabel/certify/small.yaml", text);
  const Outcome name = certify("f.cert");
  EXPECT_EQ(name.status, 2);
  EXPECT_THAT(name.err, HasSubstr("travel of a hop"));
}

}  // namespace
}  // namespace plumbline::test
