#include "validation/identify/predict/carried_states.h"

#include <algorithm>
#include <string>

namespace plumbline::validation {
namespace {

struct States {
  std::vector<std::string> names;
  int positions = 0;
};

States states_of(PredictorPool& pool, int window) {
  States found;
  pool.with(window, {}, {}, [&](Predictor& predictor) {
    found = {predictor.plant().state_names(), predictor.plant().positions()};
  });
  return found;
}

}  // namespace

std::vector<Eigen::VectorXd> carried_states(const model::Model& from, const model::Model& to,
                                            const Data& data, const std::vector<Eigen::VectorXd>& x0) {
  PredictorPool before(from, data);
  PredictorPool behind(to, data);
  std::vector<Eigen::VectorXd> carried(x0.size());
  parallel_for(static_cast<int>(x0.size()), data.threads, [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    const auto [known, known_positions] = states_of(before, w);
    const auto [wanted, wanted_positions] = states_of(behind, w);
    if (known == wanted) {
      carried[i] = x0[i];
      return;
    }
    if (known_positions != wanted_positions) {
      return;
    }
    behind.with(w, {}, {},
                [&](Predictor& predictor) { carried[i] = predictor.initial_state(data.windows[i]); });
    for (std::size_t s = 0; s < wanted.size(); ++s) {
      const auto at = std::find(known.begin(), known.end(), wanted[s]);
      if (at != known.end()) {
        carried[i][static_cast<Eigen::Index>(s)] = x0[i][at - known.begin()];
      }
    }
  });
  return carried;
}

}  // namespace plumbline::validation
