#include "validation/predict/reach.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "validation/predict/kept_keys.h"
#include "validation/predict/states_by_parts.h"

namespace plumbline::validation {
namespace {

/// Parts that are tried one after the other where the whole is too long.
constexpr std::array<double, 8> kTried{0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 1.0};

/// Has the search of too many initial states ended above the floor where the next step still promises much?
bool is_lost(const Data& part, const std::vector<Reduced>& reduced) {
  constexpr std::size_t kOneOf = 10;
  const std::vector<int> above = above_floor(part, reduced);
  const auto unsettled = std::count_if(above.begin(), above.end(), [&](int w) {
    const Reduced& one = reduced[static_cast<std::size_t>(w)];
    return one.curved && !is_settled(one, kRoughly);
  });
  return kOneOf * static_cast<std::size_t>(unsettled) > reduced.size();
}

bool is_any_curved(const model::Model& model, const Data& data) {
  PredictorPool pool(model, data);
  bool any = false;
  for (const int w : data.all_windows()) {
    pool.with(w, {}, {}, [&](Predictor& predictor) { any = any || predictor.is_curved(); });
  }
  return any;
}

bool can_be_followed(const model::Model& model, const Data& part, Point& at) {
  const std::vector<FreeParameter> as_it_is;
  PredictorPool pool(model, part);
  InitialStates states(pool, as_it_is, {});
  const bool from_shorter = !at.x0.empty();
  try {
    std::vector<Reduced> reduced = states.settle_all(kRoughly, at);
    if (from_shorter && is_lost(part, reduced)) {
      states.settle_anew(above_floor(part, reduced), kRoughly, at, reduced);
    }
    return !is_lost(part, reduced);
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return false;  // it cannot be integrated so far
  }
}

/// The whole, by way of its parts.
bool can_be_followed_by_parts(const model::Model& model, const Data& data) {
  const std::vector<FreeParameter> as_it_is;
  PredictorPool pool(model, data);
  if (!has_corners(pool, as_it_is, {})) {
    return false;
  }
  try {
    const Point at = grown_states(pool, as_it_is, {});
    return !is_lost(data, InitialStates(pool, as_it_is, {}).reduce_some(data.all_windows(), at));
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// Does the next step promise the floor, or what is close to it, above which it is? A straight line's promise
/// in a window as bent as this is not exact.
bool is_promising(const Data& data, int window, const Reduced& one) {
  constexpr double kPromised = 1.5;
  return is_above_floor(data, window, one.raw_sse) && !is_above_floor(data, window, one.sse, kPromised);
}

/// Of each window the share that can be searched, and where it begins. None for a model without corners.
struct Shares {
  Eigen::VectorXd share;
  std::vector<Eigen::VectorXd> x0;
};

Shares shares_that_can_be_searched(const model::Model& model, const Data& data) {
  constexpr double kLeast = 0.05;
  const std::vector<FreeParameter> as_it_is;
  PredictorPool pool(model, data);
  if (!has_corners(pool, as_it_is, {})) {
    return {};
  }
  Grown grown;
  Point at = grown_states(pool, as_it_is, {}, &grown);
  const std::vector<Reduced> reduced = InitialStates(pool, as_it_is, {}).reduce_some(data.all_windows(), at);
  Eigen::VectorXd shares = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(data.windows.size()));
  for (const int w : data.all_windows()) {
    const auto i = static_cast<std::size_t>(w);
    if (is_promising(data, w, reduced[i])) {
      shares[w] = std::max(kLeast, grown.share[i]);
      at.x0[i] = grown.x0[i];
    }
  }
  return {std::move(shares), std::move(at.x0)};
}

/// The longest of the parts beyond `part` that can be followed, one after the other from where `at` begins;
/// `part` if none can.
double reach_by_steps(const model::Model& model, const Data& data, double part, Point at) {
  constexpr double kMost = 0.5;
  double reached = part;
  while (reached < 1.0 && can_be_followed(model, data.beginnings(longer_part(reached)), at)) {
    reached = longer_part(reached);
  }
  return kMost <= reached && reached < 1.0 && can_be_followed_by_parts(model, data) ? 1.0 : reached;
}

double reach_of(const model::Model& model, const Data& data) {
  Point straight;
  if (!is_any_curved(model, data) || can_be_followed(model, data, straight)) {
    return 1.0;
  }
  return std::max(kTried.front(), reach_by_steps(model, data, 0.0, {}));
}

}  // namespace

Followed follow(const model::Model& model, const Data& data) {
  const Record record = kept(data, key_of("follow", model, data), [&] {
    const Shares shares = shares_that_can_be_searched(model, data);
    return Record().add(shares.share).add(shares.x0);
  });
  RecordReader reader(record);
  const Eigen::VectorXd shares = reader.vector();
  if (shares.size() == 0) {
    return {data, {}};
  }
  return {data.beginnings(std::vector<double>(shares.begin(), shares.end())), reader.vectors()};
}

double longer_part(double share) {
  const auto* next = std::upper_bound(kTried.begin(), kTried.end(), share);
  return next == kTried.end() ? 1.0 : *next;
}

double reach(const model::Model& model, const Data& data) {
  const Record record =
      kept(data, key_of("reach", model, data), [&] { return Record().add(reach_of(model, data)); });
  return RecordReader(record).number();
}

double reach_further(const model::Model& model, const Data& data, double part,
                     const std::vector<Eigen::VectorXd>& x0) {
  ResultKey key = key_of("reach_further", model, data);
  key.numbers.add(part).add(x0);
  const Record record = kept(data, key, [&] {
    return Record().add(reach_by_steps(model, data, part, {{}, x0}));
  });
  return RecordReader(record).number();
}

}  // namespace plumbline::validation
