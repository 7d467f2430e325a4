// Certificates of MABEL's hopping for tests: nothing was proven, and nobody trusts their key.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "controllers/driver/certificate.h"
#include "controllers/driver/signature.h"
#include "simulator/run/scenario.h"
#include "tests/driver/processes.h"
#include "validation/control/certify/drive_part.h"
#include "validation/control/certify/lasting.h"
#include "validation/control/certify/requirements.h"

namespace plumbline::driver {

/// Limits are those of one short run.
class Rehearsal {
 public:
  explicit Rehearsal(const std::string& folder)
      : folder_(folder),
        keys_(new_key()),
        requirements_(validation::read_requirements(PLUMBLINE_ROOT "/robots/mabel/certify/hopping.yaml")),
        loaded_(run::read_scenario(requirements_.scenario)) {
    validation::complete_drive(requirements_, loaded_);
    validation::LastingOptions options;
    options.cycles = 10;
    const validation::LastingRun run =
        validation::last(loaded_, validation::read_gait(loaded_).value(), requirements_.drive, options);
    validation::take_limits(requirements_.drive, run.extremes, requirements_.speed_times,
                            requirements_.rest_times, requirements_.slew_times);
    std::ofstream(key()) << keys_.public_pem;
  }

  std::string model() const { return loaded_.model.file; }
  std::string scenario() const { return requirements_.scenario; }
  std::string key() const { return folder_ + "/key.pub"; }
  const run::LoadedScenario& loaded() const { return loaded_; }
  const Plan& plan() const { return requirements_.drive; }

  /// Of the controller as it is, with patience for a computer that has other work.
  std::string whole() const {
    Plan plan = requirements_.drive;
    plan.silence = plan.answer = plan.controller_time = 10.0;
    plan.late = 1000;
    plan.library = loaded_.controller->library.path();
    return written(plan);
  }

#ifdef FAULTY_CONTROLLER
  /// Of faulty_hopping with a fault at a step.
  std::string faulty(int fault, double step) const {
    Plan plan = requirements_.drive;
    plan.library = FAULTY_CONTROLLER;
    plan.constant_names.insert(plan.constant_names.end(), {"fault", "fault_step"});
    plan.constants.insert(plan.constants.end(), {static_cast<double>(fault), step});
    if (fault == 8) plan.answer = 1e-3;  // a step of 3 ms is late, and yet no overrun
    return written(plan);
  }
#endif

 private:
  std::string written(Plan& plan) const {
    plan.library = std::filesystem::absolute(plan.library).string();
    plan.library_sha256 = sha256_of_file(plan.library);
    Json body;
    body["format"] = "plumbline-certificate/1";
    body["title"] = "rehearsal; nothing was proven";
    body["model"] = std::filesystem::absolute(loaded_.model.file).string();
    body["valid_until"] = "2099-12-31";
    body["files"] = Json::Array();
    body["controller"] = validation::controller_json(plan);
    body["drive"] = validation::drive_json(plan);
    std::string file = folder_ + "/rehearsal.cert";
    std::ofstream(file) << signed_certificate(body, keys_.private_pem);
    return file;
  }

  std::string folder_;
  KeyPair keys_;
  validation::Requirements requirements_;
  run::LoadedScenario loaded_;
};

/// Until the file has the text; throws std::runtime_error after half a minute.
inline void wait_for(const std::string& file, const std::string& text) {
  for (int k = 0; k < 1500; ++k) {
    std::ifstream in(file);
    const std::string all{std::istreambuf_iterator<char>(in), {}};
    if (all.find(text) != std::string::npos) return;
    usleep(20000);
  }
  throw std::runtime_error(file + ": does not say " + text);
}

}  // namespace plumbline::driver
