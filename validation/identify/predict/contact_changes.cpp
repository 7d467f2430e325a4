#include "validation/identify/predict/contact_changes.h"

namespace plumbline::validation {
namespace {

/// Of all contacts, at a state.
std::vector<bool> closed_at(model::Plant& plant, const double* x) {
  std::vector<bool> closed;
  for (std::size_t f = 0; f < plant.model().feet.size(); ++f) {
    closed.push_back(plant.foot_depth(static_cast<int>(f), x).depth > 0.0);
  }
  for (const model::LinkTouch& one : plant.link_touches(x)) {
    closed.push_back(one.depth > 0.0);
  }
  return closed;
}

}  // namespace

bool do_contacts_change(Predictor& predictor) {
  model::Plant& plant = predictor.plant();
  if (!plant.meets_anything()) {
    return false;
  }
  const Eigen::MatrixXd states = predictor.predicted_states();
  std::vector<bool> before;
  for (Eigen::Index k = 0; k < states.cols(); ++k) {
    std::vector<bool> now = closed_at(plant, states.col(k).data());
    if (k > 0 && now != before) {
      return true;
    }
    before = std::move(now);
  }
  return false;
}

}  // namespace plumbline::validation
