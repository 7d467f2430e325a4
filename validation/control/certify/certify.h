// From requirements to a certificate's body: every requirement run, reached and judged.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "controllers/driver/json.h"
#include "validation/control/certify/requirements.h"
#include "validation/identify/predict/problem.h"
#include "work/workers.h"

namespace plumbline::validation {

struct Judged {
  std::string name, required, reached;
  bool holds = false;
};

struct CertifyOptions {
  std::string certificate;           ///< path that will be written: files are named relative to its folder
  std::string progress;              ///< path of the ledger
  std::string durations;             ///< file of how long runs took (work/durations.h): read and written
  std::string version;               ///< of the program
  work::Workers* workers = nullptr;  ///< each run is one of their tasks
  const StopFlag* stop = nullptr;    ///< raised: Stopped is thrown, and what is done stays in the ledger
  /// Share that is done, 0 to 1, and how many runs the ledger had.
  std::function<void(double, int)> report;
};

struct Certified {
  std::vector<Judged> judged;
  bool holds = false;
  driver::Json body;       ///< canonical: the same input gives the same bytes
  double step_p999 = 0.0;  ///< s, measured here and now, and therefore not in the body
};

/// On other ranks than the first nothing is judged, and the result is empty. Throws InputError for
/// requirements that do not fit together, Stopped when stopped.
Certified certify(const std::string& requirements, const CertifyOptions& options);

/// The files that a scenario's result hangs on, with what they are: the controller's library, constants and
/// wiring, the scenario, model with skeleton and overlays, requirements, reference data.
struct NamedFile {
  std::string path, role;
};
std::vector<NamedFile> files_of(const Requirements& requirements, const run::LoadedScenario& loaded);

}  // namespace plumbline::validation
