// What a user can get wrong, as a table: files that are edited, a command, and what the one line must say.
#pragma once

#include <gmock/gmock.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/cli/robot_folder.h"

namespace plumbline::test {

struct Edit {
  std::string file, what, by;
};

struct BadInput {
  std::string name;
  std::vector<Edit> edits;  ///< what is wrong with the files; an empty `what` writes a whole file
  std::vector<std::string> arguments;
  std::vector<std::string> message;  ///< parts that the one line must have
};

inline void PrintTo(const BadInput& bad, std::ostream* out) { *out << bad.name; }

inline std::string name_of(const testing::TestParamInfo<BadInput>& bad) { return bad.param.name; }

class BadInputs : public RobotFolder, public testing::WithParamInterface<BadInput> {
 protected:
  void make(const std::vector<Edit>& edits) const {
    for (const Edit& edit : edits) {
      edit.what.empty() ? write(edit.file, edit.by) : replace(edit.file, edit.what, edit.by);
    }
  }
};
inline const std::vector<std::string> kCompare{"compare", "trials/steps", "--json", "out.json"};
inline const std::vector<std::string> kCheckModel{"check", "robot/model.yaml", "--json", "out.json"};
inline constexpr const char* kData = "trials/steps/data.csv";
inline constexpr const char* kTrial = "trials/steps/trial.yaml";
inline constexpr const char* kModel = "robot/model.yaml";
inline constexpr const char* kHead = "t [s],u_drive [A],q_drive [rad],q_shoulder [rad]";

}  // namespace plumbline::test
