// How far a model can be followed: over how long windows.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/identify/predict/problem.h"

namespace plumbline::validation {

/// Windows as far as a model can be followed, and where they begin.
struct Followed {
  Data data;
  std::vector<Eigen::VectorXd> x0;  ///< empty for a model without stops or play
  double length = 0.0;              ///< of the segments, s; predict.window: whole windows
};

/// The windows of `data` as far as the model can be followed. Through contact, stops and play what a wrong
/// model predicts departs from the measurements without a way back: over whole windows the search of the
/// initial states ends above the floor and, in more than a tenth of them, does not settle or expands errors
/// (Predictor::expansion) so much that slopes promise what no step keeps. Then they are followed in segments
/// (segments_of), a sixteenth of PredictOptions::window long, or half of that where too many are lost there,
/// too. Of a whole window whose initial state's next step promises the floor while no step leads there only
/// the beginning that was at the floor is used: what is behind it depends on where it begins more finely than
/// can be searched, and no model can be held against it. A window that the model misses without such a
/// promise stays as it is: that is evidence. A segment whose search does not
/// settle, or whose error is more than three times the ninth decile of all, is left out.
Followed follow(const model::Model& model, const Data& data);

/// The first twentieth of each window alone: for a model that misses so much that where its segments end says
/// nothing of where the next ones begin.
Followed follow_beginnings(const model::Model& model, const Data& data);

/// The same at a length that is known: that of an earlier Followed.
Followed follow_at(const model::Model& model, const Data& data, double length);

/// The same of `data` from where `shorter` segments of it begin: these, searched anew with the present model,
/// or segments of twice the length if the model can be followed so far, or `in_any_case`. A segment that
/// goes astray (is_astray, of the mean square of the worst of its halves) stays in its halves; where more
/// than a quarter do, the model does.
Followed follow_further(const model::Model& model, const Data& data, const Followed& shorter,
                        bool in_any_case);

/// Are these whole windows?
bool is_whole(const Followed& followed);

/// Do both begin and end with the same samples of one trial?
bool is_same(const Window& one, const Window& other);

/// How many windows of the length are not followed from their beginning to their end.
std::size_t not_followed(const Data& data, const Followed& followed);

/// Are these more than most_lost()?
bool are_too_many_lost(const Data& data, const Followed& followed);

}  // namespace plumbline::validation
