// What the driver reads from a certificate, and what it refuses.
#include "controllers/driver/plan.h"

#include <gtest/gtest.h>

#include "tests/driver/small_body.h"

namespace plumbline::driver {
namespace {

std::string refusal(const Json& body) {
  try {
    plan_from(body);
  } catch (const DriverError& error) {
    return error.what();
  }
  return "";
}

/// The body with one text in its canonical form replaced.
std::string refusal_with(const std::string& from, const std::string& to) {
  std::string text = canonical_json(small_body());
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return refusal(parse_json(text.replace(at, from.size(), to)));
}

TEST(Plan, IsReadWhole) {
  const Plan plan = plan_from(small_body());
  EXPECT_EQ(plan.channel_names(), (std::vector<std::string>{"joint", "tilt", "foot"}));
  EXPECT_EQ(plan.channels[2].kind, ChannelKind::contact);
  EXPECT_EQ(plan.channels[2].rest, kNone);
  EXPECT_EQ(plan.commands[0].hold.channel, 0);
  EXPECT_EQ(plan.inputs[0].scale, 1e-3);
  EXPECT_EQ(plan.workspace[0].deceleration, 50.0);
  EXPECT_EQ(plan.packets.lost, 5);
  EXPECT_EQ(plan.constants.size(), 2U);
}

TEST(Plan, EveryMissingMemberIsNamed) {
  const Json body = small_body();
  for (const auto& member : body.at("drive").object()) {
    Json::Object drive = body.at("drive").object();
    drive.erase(member.first);
    Json changed = body;
    changed["drive"] = Json(drive);
    EXPECT_EQ(refusal(changed), "body.drive." + member.first + ": is missing");
  }
}

TEST(Plan, WrongValuesAreNamed) {
  EXPECT_EQ(refusal_with("\"limit\":10", "\"limit\":-10"),
            "body.drive.commands[0].limit: expected a number above 0");
  EXPECT_NE(refusal_with("\"lost\":5", "\"lost\":5.5").find("whole number"), std::string::npos);
  EXPECT_NE(refusal_with("\"to\":\"motor\"", "\"to\":\"mot\"").find("no name of the robot's"),
            std::string::npos);
  EXPECT_NE(refusal_with("\"kind\":\"count\"", "\"kind\":\"counts\"").find("expected count"),
            std::string::npos);
  EXPECT_NE(refusal_with("\"late\":0", "\"late\":0,\"later\":1").find("later: is not known"),
            std::string::npos);
  EXPECT_NE(refusal_with("\"scale\":0.001", "\"scale\":0").find("not 0"), std::string::npos);
}

}  // namespace
}  // namespace plumbline::driver
