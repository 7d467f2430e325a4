// `plumbline report`: one whole page or none, the same one from the same input, from the data of the other
// commands.
#include <gmock/gmock.h>

#include "tests/cli/robot_folder.h"

namespace plumbline::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class Report : public RobotFolder {
 protected:
  /// The data that the page carries.
  json data_of(const std::string& name) const {
    const std::string page = read(name);
    const std::string open = "id=\"report-data\">";
    const std::size_t from = page.find(open) + open.size();
    return json::parse(page.substr(from, page.find("</script>", from) - from));
  }
};

TEST_F(Report, ComparesAsCompareDoes) {
  succeed({"report", "trials/steps", "trials/swing", "--no-diagnose", "-o", "r.html", "--json", "r.json"});
  succeed({"compare", "trials/steps", "trials/swing", "--json", "c.json"});
  const json report = data_of("r.html");
  const json compared = read_json("c.json");
  EXPECT_THAT(keys(report), UnorderedElementsAre("format", "robot", "model", "drawn", "ladder", "trials",
                                                 "diagnosis", "whole_trials", "published", "horizons",
                                                 "unexplained", "estimates", "values", "repeat", "defects"));
  EXPECT_TRUE(report["diagnosis"].is_null());
  EXPECT_EQ(report["horizons"][0], compared["horizons"]);
  EXPECT_EQ(report["defects"][0], compared["defects"]);
  ASSERT_EQ(report["ladder"].size(), 1U);
  EXPECT_DOUBLE_EQ(report["ladder"][0]["train"], compared["train"]);
  EXPECT_DOUBLE_EQ(report["ladder"][0]["held_out"], compared["held_out"]);
  succeed({"ladder", "trials/steps", "trials/swing", "--json", "l.json"});
  EXPECT_EQ(report["whole_trials"][0], read_json("l.json")["models"][0]["trials"]);
  EXPECT_FALSE(report["whole_trials"][0][0]["inverse_model"]["motors"].empty());
  std::size_t place = 0;
  for (const json& trial : report["trials"]) {
    EXPECT_EQ(trial["windows"].size(), 4U);
    for (const json& channel : trial["channels"]) {
      EXPECT_EQ(channel["sensor"], compared["channels"][place]["name"]);
      EXPECT_DOUBLE_EQ(channel["models"][0]["rms"], compared["channels"][place++]["rms"]);
    }
  }
  EXPECT_EQ(place, 4U);
  const json summary = read_json("r.json");
  EXPECT_EQ(summary["file"], "r.html");
  EXPECT_EQ(summary["bytes"], read("r.html").size());
}

TEST_F(Report, IsTheSameFromTheSameInput) {
  const std::vector<std::string> words{"report", "trials/steps", "--no-diagnose", "-o", "r.html"};
  succeed(words);
  const std::string once = read("r.html");
  succeed(words);
  EXPECT_EQ(read("r.html"), once);
}

TEST_F(Report, ShowsTheModelsThatAModelStandsOn) {
  succeed({"add", "coulomb", "--at", "drive", "--model", "robot/model.yaml", "--set", "level=0.008", "--set",
           "smoothing_speed=0.5", "-o", "better.yaml"});
  succeed({"report", "trials/steps", "--no-diagnose", "--model", "better.yaml", "-o", "r.html"});
  const json report = data_of("r.html");
  ASSERT_EQ(report["ladder"].size(), 2U);
  EXPECT_EQ(report["ladder"][0]["name"], "model.yaml");
  EXPECT_EQ(report["ladder"][1]["name"], "better.yaml + coulomb@drive");
  EXPECT_LT(report["ladder"][1]["train"], report["ladder"][0]["train"]);
  EXPECT_TRUE(report["ladder"][1]["held_out"].is_null());
  EXPECT_EQ(report["drawn"].size(), 2U);
  EXPECT_EQ(report["trials"][0]["channels"][0]["models"].size(), 2U);
}

TEST_F(Report, NamesEveryFileThatItRead) {
  succeed({"report", "trials/steps", "--no-diagnose", "-o", "r.html"});
  const json repeat = data_of("r.html")["repeat"];
  EXPECT_EQ(repeat["command"], "plumbline report trials/steps --no-diagnose -o r.html");
  EXPECT_TRUE(repeat["seed"].is_null());
  std::vector<std::string> kinds;
  for (const json& file : repeat["files"]) {
    kinds.push_back(file["kind"]);
    EXPECT_EQ(file["sha256"].get<std::string>().size(), 64U);
  }
  EXPECT_THAT(kinds, UnorderedElementsAre("model", "skeleton", "trial", "data"));
}

TEST_F(Report, ShowsASavedDiagnosis) {
  succeed({"diagnose", "trials/steps", "trials/swing", "--json", "d.json", "--save", "found.yaml"});
  const Outcome outcome = succeed({"report", "trials/steps", "trials/swing", "--model", "found.yaml",
                                   "--diagnosis", "d.json", "-o", "r.html"});
  const json diagnosis = read_json("d.json");
  EXPECT_THAT(outcome.out, HasSubstr(diagnosis["summary"].get<std::string>()));
  EXPECT_EQ(data_of("r.html")["diagnosis"], diagnosis);
  // One answer, one number: the saved model leaves what the last rung says.
  succeed({"compare", "trials/steps", "trials/swing", "--model", "found.yaml", "--json", "c.json"});
  const json compared = read_json("c.json");
  for (const char* role : {"train", "held_out"}) {
    EXPECT_NEAR(compared[role].get<double>(), diagnosis["ladder"].back()[role].get<double>(), 1e-3) << role;
  }
}

TEST_F(Report, BadInputLeavesNothing) {
  write("text.json", "no json");
  write("other.json", "{\"train\": 1}");
  const auto before = snapshot();
  const auto refused = [&](const std::vector<std::string>& more, const std::string& line) {
    std::vector<std::string> words{"report", "trials/steps", "-o", "r.html"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = plumbline(words);
    EXPECT_EQ(outcome.status, 2) << line;
    EXPECT_THAT(outcome.err, HasSubstr(line));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  };
  refused({"--diagnosis", "text.json"}, "text.json: found something that is no JSON");
  refused({"--diagnosis", "other.json"}, "other.json: verdict: found no such key");
  refused({"--diagnosis", "none.json"}, "none.json: found nothing at this path");
  refused({"--diagnosis", "text.json", "--no-diagnose"}, "--no-diagnose excludes --diagnosis");
  refused({"trials/none"}, "trials/none");
  EXPECT_EQ(plumbline({"report", "trials/steps", "-o", "none/r.html"}).status, 2);
  EXPECT_EQ(plumbline({"report", "trials/steps", "--no-diagnose", "-o", "robot/model.yaml"}).status, 2);
  EXPECT_EQ(plumbline({"report", "trials/steps"}).status, 2);
  EXPECT_THAT(changed_since(before), IsEmpty());
}

}  // namespace
}  // namespace plumbline::test
