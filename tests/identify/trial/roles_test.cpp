#include "tests/identify/trial/fixture.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;

class Roles : public ScratchFolder {
 protected:
  /// Reads a trial of this name, role and data file.
  Trial trial(const std::string& name, const std::string& role, const std::string& data,
              const std::string& csv) {
    fs::create_directories(folder / name);
    write_file(folder / name / data, csv);
    write_file(folder / name / "trial.yaml",
               replaced(replaced(good_trial(), "role: train", "role: " + role), "data.csv", data));
    return read_trial((folder / name).string(), robot);
  }
  /// Another experiment.
  static std::string other_csv() {
    return replaced(good_csv(), "\n0.07,0.7,7,7,14,", "\n0.07,0.7,7,7.5,14,");
  }
};

TEST_F(Roles, DifferentDataMayHaveDifferentRoles) {
  check_roles({trial("a", "train", "data.csv", good_csv()), trial("b", "held-out", "data.csv", other_csv())});
}

TEST_F(Roles, TheSameDataMayServeTwiceInOneRole) {
  check_roles({trial("a", "train", "data.csv", good_csv()), trial("b", "train", "data.csv", good_csv())});
  check_roles(
      {trial("a", "held-out", "data.csv", good_csv()), trial("b", "held-out", "data.csv", good_csv())});
}

TEST_F(Roles, TheSameFileIsRefusedHoweverItIsNamed) {
  const Trial train = trial("a", "train", "data.csv", good_csv());
  Trial held_out = trial("b", "held-out", "data.csv", other_csv());
  fs::remove(folder / "b" / "data.csv");
  fs::create_symlink(folder / "a" / "data.csv", folder / "b" / "data.csv");
  held_out.data_file = (folder / "b" / ".." / "b" / "data.csv").string();
  const std::string message = input_error([&] { check_roles({train, held_out}); });
  EXPECT_NE(message.find((folder / "b").string()), std::string::npos) << message;
  EXPECT_NE(message.find((folder / "a").string()), std::string::npos) << message;
}

TEST_F(Roles, ACopyUnderAnotherNameIsRefused) {
  const Trial train = trial("a", "train", "data.csv", good_csv());
  EXPECT_NE(input_error([&] { check_roles({trial("b", "held-out", "copy.csv", good_csv()), train}); }), "");
  // Written another way, it still holds the same numbers.
  const std::string rewritten = replaced(good_csv(), "0.07,0.7,7,7,14,21", "0.07,0.70,7.0,7,1.4e1,21");
  EXPECT_NE(input_error([&] { check_roles({train, trial("c", "held-out", "copy.csv", rewritten)}); }), "");
}

TEST_F(Roles, ACopyWithAShiftedTimeOrWithoutAColumnIsRefused) {
  const Trial train = trial("a", "train", "data.csv", good_csv());
  Trial copy = trial("b", "held-out", "data.csv", good_csv());
  copy.time.array() += 5.0;
  copy.measured.pop_back();
  copy.commands.erase(copy.commands.begin());
  EXPECT_NE(input_error([&] { check_roles({train, copy}); }), "");
}

TEST_F(Roles, WhatWasFittedOrHasChosenCannotTest) {
  const Trial test = trial("t", "test", "data.csv", good_csv());
  EXPECT_EQ(test.role, Role::test);
  check_roles({test, trial("a", "train", "data.csv", other_csv())});
  const std::string message = input_error([&] {
    check_roles({test, trial("b", "held-out", "copy.csv", good_csv())});
  });
  EXPECT_NE(message.find("expected other data; what was fitted or has chosen cannot test"), std::string::npos)
      << message;
  EXPECT_NE(input_error([&] { check_roles({trial("c", "train", "copy.csv", good_csv()), test}); }), "");
}

TEST_F(Roles, TheSameInputOnAnotherMotionIsAnotherExperiment) {
  const Trial train = trial("a", "train", "data.csv", good_csv());
  Trial again = trial("b", "held-out", "data.csv", good_csv());
  again.measured[0].values[12] += 1e-3;
  check_roles({train, again});
}

}  // namespace
}  // namespace plumbline::validation
