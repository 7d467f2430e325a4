// Fits values of a model to a trial:  fit_example MODEL TRIAL PARAMETERS, for example
//     fit_example ../pendulum/model.yaml ../pendulum/steps '*damping*'
#include <cstdio>
#include <exception>

#include "simulator/trace/error.h"
#include "validation/api/fitting.h"
#include "validation/api/loading.h"

namespace {

void fit(const char* model, const char* trial, const char* parameters) {
  using namespace plumbline;
  api::Sources sources;
  sources.model = model;
  sources.trials = {trial};
  const validation::StopFlag never;  // raised from another thread it would end the work cleanly
  const api::Loaded loaded = api::load(sources, &never);
  const validation::Fit result =
      api::fit(loaded, {parameters}, {}, [](const std::string& /*what*/, double /*share*/) {});
  for (const validation::FittedParameter& one : result.parameters) {
    std::printf("%s = %.6g (%.6g to %.6g) %s, before %.6g\n", one.label.c_str(), one.after, one.lower,
                one.upper, one.unit.c_str(), one.before);
  }
  std::printf("error of the train trials: %.4g floors before, %.4g after\n", result.before.train,
              result.after.train);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: fit_example MODEL TRIAL PARAMETERS\n");
    return 2;
  }
  try {
    fit(argv[1], argv[2], argv[3]);
  } catch (const plumbline::InputError& error) {  // one line with file, line and key
    std::fprintf(stderr, "fit_example: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fit_example: %s\n", error.what());
    return 1;
  }
  return 0;
}
