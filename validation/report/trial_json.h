// One trial as the page draws it.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "validation/identify/compare/compare.h"
#include "validation/identify/diagnose/diagnose.h"
#include "validation/report/thin.h"

namespace plumbline::validation {

/// A model that is drawn, and what it predicts.
struct Drawn {
  const Stage* stage = nullptr;
  Comparison comparison;
  std::vector<Eigen::MatrixXd> predicted;  ///< by trial: samples x channels
};

struct DrawingOptions {
  Eigen::Index points = 6000;       ///< most points of one curve
  Eigen::Index least_points = 300;  ///< however many curves there are
  Eigen::Index all_points = 2500000;
  Eigen::Index detail = 1500;  ///< most points of a window in detail
  std::size_t worst = 12;      ///< windows of each drawn model that are in detail, and one of each trial
};

/// By trial, the windows that are drawn in detail: the worst of every drawn model.
std::vector<std::vector<Span>> detailed_spans(const Data& data, const std::vector<Drawn>& drawn,
                                              const DrawingOptions& options);

/// Points of a curve, so that all curves of the page together stay within the options.
Eigen::Index points_of_curve(const Data& data, std::size_t drawn, const DrawingOptions& options);

/// Layout: docs/formats.md, "The data of a report".
nlohmann::json trial_json(const Data& data, std::size_t trial, const std::vector<Drawn>& drawn,
                          const std::vector<Block>& blocks);

}  // namespace plumbline::validation
