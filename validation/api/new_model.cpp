#include "validation/api/new_model.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "simulator/model/joint_chain.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/mjcf_file.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/table.h"
#include "simulator/trace/units.h"
#include "validation/api/new_model_text.h"
#include "validation/identify/inverse_model/inverse_model.h"
#include "validation/identify/trial/new_folder.h"
#include "validation/identify/trial/trial_from_log.h"

namespace plumbline::api {
namespace {

namespace fs = std::filesystem;
using validation::ColumnLook;
using validation::LogLook;
using validation::Role;

constexpr double kTrainShare = 0.6;

/// Folders that this command has made; removed again unless all went well.
class Made {
 public:
  Made() = default;
  ~Made() {
    std::error_code none;
    for (auto path = trials_.rbegin(); path != trials_.rend() && !done_; ++path) {
      fs::remove_all(*path, none);
    }
    for (auto path = parents_.rbegin(); path != parents_.rend() && !done_; ++path) {
      fs::remove(*path, none);  // only while it is empty
    }
  }
  Made(const Made&) = delete;
  Made& operator=(const Made&) = delete;

  /// The folders above a file that are not there yet.
  void make_parents(const fs::path& file) {
    std::vector<fs::path> missing;
    std::error_code none;
    for (fs::path at = file.parent_path(); !at.empty() && !fs::exists(at, none); at = at.parent_path()) {
      missing.push_back(at);
    }
    for (auto path = missing.rbegin(); path != missing.rend(); ++path) {
      if (!fs::create_directory(*path, none)) {
        throw InputError({file.string(), 0, ""}, "a folder that cannot be made",
                         "a place that can be written");
      }
      parents_.push_back(*path);
    }
  }
  void add(const std::string& trial) { trials_.push_back(trial); }
  void keep() { done_ = true; }

 private:
  std::vector<fs::path> parents_, trials_;
  bool done_ = false;
};

std::string relative_to(const fs::path& folder, const std::string& path) {
  return fs::proximate(fs::absolute(path).lexically_normal(), fs::absolute(folder).lexically_normal())
      .string();
}

fs::path folder_of(const std::string& file) { return fs::absolute(file).lexically_normal().parent_path(); }

void refuse_existing(const std::string& file) {
  std::error_code none;
  if (fs::exists(fs::symlink_status(file, none))) {
    throw InputError({file, 0, ""}, "a file of this name", "the name of a new model file");
  }
}

LogLook look_at_log(const std::string& log, const std::vector<std::string>& topics) {
  LogLook look = validation::look_at_log(log, topics);
  if (look.time < 0) {
    throw InputError({log, 0, ""}, "no column that rises like a time", "a column such as t [s]");
  }
  return look;
}

std::vector<JointColumns> columns_of(const std::vector<PlannedJoint>& joints) {
  std::vector<JointColumns> columns;
  for (const PlannedJoint& one : joints) {
    columns.push_back(one.columns);
  }
  return columns;
}

long commands_among(const std::vector<JointColumns>& joints) {
  return std::count_if(joints.begin(), joints.end(),
                       [](const JointColumns& one) { return one.command >= 0; });
}

/// By the wish; else whichever unit has more of the log's columns.
std::string command_unit_for(const NewModelWish& wish, const Plan& plan) {
  if (!wish.command_unit.empty() || plan.look == nullptr) {
    return wish.command_unit.empty() ? "N m" : wish.command_unit;
  }
  std::vector<JointColumns> torques = columns_of(plan.joints);
  std::vector<JointColumns> currents = torques;
  match_columns(*plan.look, "N m", torques);
  match_columns(*plan.look, "A", currents);
  const auto stated = [&](const JointColumns& one) {
    const ColumnLook* column =
        one.command < 0 ? nullptr : &plan.look->columns[static_cast<std::size_t>(one.command)];
    return column != nullptr && !column->unit.empty() && units_agree(column->unit, "A");
  };
  const bool amperes = std::any_of(currents.begin(), currents.end(), stated);
  return amperes && commands_among(currents) >= commands_among(torques) ? "A" : "N m";
}

void match(Plan& plan, const NewModelWish& wish) {
  std::vector<JointColumns> columns = columns_of(plan.joints);
  match_columns(*plan.look, plan.command_unit, columns);
  std::string names;
  bool any = false;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    plan.joints[j].columns = columns[j];
    any = any || columns[j].position >= 0 || columns[j].command >= 0;
    names += (j == 0 ? "" : ", ") + columns[j].joint;
  }
  if (!any) {
    throw InputError(
        {wish.log, 0, ""}, "no column that belongs to a joint",
        "columns named after the joints (" + names + "), or numbered as many as there are joints");
  }
}

/// Every motor has its command and every joint its position.
bool is_complete(const Plan& plan) {
  return std::all_of(plan.joints.begin(), plan.joints.end(), [&](const PlannedJoint& one) {
    const bool is_commanded = one.columns.command >= 0 || !plan.is_driven(one);
    return plan.is_held(one) || (one.columns.position >= 0 && is_commanded);
  });
}

std::string assumed_gain() {
  return "nobody has said it: 1, to begin with; put the data sheet's here, times the gear's ratio";
}

/// Where the recorded motion needs force in proportion to the current, that factor is nearer than 1.
void guess_gains(const model::Model& model, const validation::Trial& train, Plan& plan) {
  constexpr double kSure = 0.7;  // as CommandGain::implausible
  constexpr double kShare = 0.5;
  for (const validation::CommandGain& found : validation::command_gains(model, train)) {
    const double factor = found.factor();
    const bool sure = std::max(found.correlation, found.core_correlation) > kSure;
    for (PlannedJoint& one : plan.joints) {
      if (one.motor == found.motor && sure && std::isfinite(factor) && factor > 0.0) {
        one.gain = {
            factor, kShare,
            "from the train trial: the force that its motion needs with the skeleton's masses follows "
            "the current by this factor; the data sheet's, times the gear's ratio, is better"};
      }
    }
  }
}

struct TrialPlan {
  Role role;
  std::string folder;
  double from, to;
};

/// Both parts of the log, in its own time; absolute times count from the first row (docs/formats/trial.md).
std::vector<TrialPlan> trials_of(const Plan& plan, const NewModelWish& wish) {
  constexpr double kAbsolute = 1e7;  // s
  constexpr double kBetween = 2.0;   // steps that belong to neither
  const LogLook& look = *plan.look;
  const double start = look.start > kAbsolute ? 0.0 : look.start;
  const double split = start + kTrainShare * look.duration;
  const fs::path beside = fs::path(wish.file).parent_path();
  const std::string stem = fs::path(wish.log).stem().string();
  return {{Role::train, (beside / (stem + "_train")).string(), start, split},
          {Role::held_out, (beside / (stem + "_held_out")).string(), split + kBetween * look.median_step,
           start + look.duration}};
}

void write_trials(const Plan& plan, const NewModelWish& wish, const std::vector<TrialPlan>& trials,
                  Made& made) {
  for (const TrialPlan& trial : trials) {
    const fs::path folder = fs::absolute(trial.folder).lexically_normal();
    const std::string text = trial_text(plan, trial.role, trial.from, trial.to, relative_to(folder, wish.log),
                                        relative_to(folder, wish.file));
    validation::write_new_folder(trial.folder, [&](const std::string& temporary) {
      write_text_atomically((fs::path(temporary) / "trial.yaml").string(), text);
    });
    made.add(trial.folder);
  }
}

/// Reads model and trials back; with a current as command, the model once more with better constants.
void write_all(const std::string& temporary, const NewModelWish& wish, Plan& plan, NewModel& result,
               Made& made) {
  write_text_atomically(temporary, model_text(plan));
  const model::Model model = model::read_model(temporary, model::known_effects());
  if (plan.look == nullptr) {
    return;
  }
  const std::vector<TrialPlan> trials = trials_of(plan, wish);
  write_trials(plan, wish, trials, made);
  for (const TrialPlan& trial : trials) {
    result.trials.push_back(trial.folder);
  }
  if (!is_complete(plan)) {
    result.remarks.emplace_back(
        "Not every joint has both columns: fill in what the trials leave open, or delete motor, ratio and "
        "sensor of a joint that was not recorded.");
    return;
  }
  const validation::Trial train = validation::read_trial(trials.front().folder, model);
  validation::read_trial(trials.back().folder, model);
  if (plan.command_unit == "A") {
    guess_gains(model, train, plan);
    write_text_atomically(temporary, model_text(plan));
    model::read_model(temporary, model::known_effects());
  }
}

void describe(const Plan& plan, NewModel& result) {
  std::vector<bool> used(plan.look == nullptr ? 0 : plan.look->columns.size(), false);
  const auto name = [&](int index) -> std::string {
    if (index < 0) {
      return "";
    }
    used[static_cast<std::size_t>(index)] = true;
    return plan.look->columns[static_cast<std::size_t>(index)].name;
  };
  for (const PlannedJoint& one : plan.joints) {
    result.joints.push_back(
        {one.joint->name, plan.is_driven(one) ? one.motor : "", name(one.columns.position),
         name(one.columns.command), one.columns.position_by_number, one.columns.command_by_number,
         plan.command_unit == "A" ? one.gain.value : 0.0, plan.command_unit == "A" ? one.gain.why : ""});
  }
  for (std::size_t c = 0; c < used.size(); ++c) {
    if (!used[c] && static_cast<int>(c) != plan.look->time) {
      result.unused.push_back(plan.look->columns[c].name);
    }
  }
  for (const PlannedJoint& one : plan.joints) {
    if (plan.is_held(one)) {
      result.remarks.push_back(
          "Joint " + one.joint->name +
          ": the log has no column of it, and the trials hold it still at zero (`locked`).");
    } else if (!plan.is_driven(one)) {
      result.remarks.push_back(
          "Joint " + one.joint->name +
          ": neither the file nor the log has a drive of it, so the model has no motor there.");
    }
  }
  for (const std::string& sentence : plan.skeleton->left_out) {
    if (!is_taken_by_new_model(sentence)) {
      result.remarks.push_back(sentence);
    }
  }
}

}  // namespace

NewModel new_model(const NewModelWish& wish) {
  refuse_existing(wish.file);
  model::Skeleton skeleton = model::read_skeleton(wish.skeleton);
  if (wish.floating_base && !model::free_base(skeleton)) {
    throw InputError({wish.skeleton, 0, "--floating-base"},
                     "joints that hang it on the world, or several root links",
                     "one root link that no joint leads to");
  }
  std::optional<LogLook> look;
  if (!wish.log.empty()) {
    look = look_at_log(wish.log, wish.topics);
  }
  Plan plan{&skeleton,
            relative_to(folder_of(wish.file), wish.skeleton),
            "",
            look ? &*look : nullptr,
            plan_joints(skeleton),
            wish.floating_base};
  const model::MjcfDrives drives =
      model::is_mjcf(wish.skeleton) ? model::read_mjcf_drives(wish.skeleton) : model::MjcfDrives{};
  add_drives(drives, plan.joints);
  add_transmissions(model::urdf_driven_joints(wish.skeleton), plan.joints);
  if (plan.joints.empty()) {
    throw InputError({wish.skeleton, 0, ""}, "no moving joint", "a skeleton with one");
  }
  plan.command_unit = command_unit_for(wish, plan);
  for (PlannedJoint& one : plan.joints) {
    one.gain.why = assumed_gain();
  }
  if (look) {
    match(plan, wish);
  }
  NewModel result{wish.file, plan.command_unit, {}, {}, {}, {}};
  Made made;
  made.make_parents(fs::absolute(wish.file).lexically_normal());
  replace_file(wish.file,
               [&](const std::string& temporary) { write_all(temporary, wish, plan, result, made); });
  made.keep();
  describe(plan, result);
  return result;
}

nlohmann::json to_json(const NewModel& made) {
  nlohmann::json joints = nlohmann::json::array();
  const auto column = [](const std::string& name) {
    return name.empty() ? nlohmann::json() : nlohmann::json(name);
  };
  for (const NewJoint& one : made.joints) {
    joints.push_back({{"joint", one.joint},
                      {"motor", one.motor},
                      {"position", column(one.position)},
                      {"position_by_number", one.position_by_number},
                      {"command", column(one.command)},
                      {"command_by_number", one.command_by_number},
                      {"torque_constant",
                       one.torque_constant > 0.0 ? nlohmann::json(one.torque_constant) : nlohmann::json()}});
  }
  return {{"file", made.file},     {"command_unit", made.command_unit}, {"joints", joints},
          {"trials", made.trials}, {"unused_columns", made.unused},     {"remarks", made.remarks}};
}

}  // namespace plumbline::api
