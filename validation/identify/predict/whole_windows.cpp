#include "validation/identify/predict/whole_windows.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "validation/identify/predict/kept_keys.h"
#include "validation/identify/predict/states_by_parts.h"

namespace plumbline::validation {
namespace {

/// Above the floor: has the search ended where the next step still promises much, or expand errors so much
/// that what the model misses is far beyond what a linearisation holds for?
bool is_lost(const Data& data, int window, const Reduced& one) {
  constexpr double kExpansion = 30.0;
  return one.curved && is_above_floor(data, window, one.raw_sse) &&
         (!is_settled(one, kRoughly) || one.expansion > kExpansion);
}

bool is_any_curved(const model::Model& model, const Data& data) {
  PredictorPool pool(model, data);
  bool any = false;
  for (const int w : data.all_windows()) {
    pool.with(w, {}, {}, [&](Predictor& predictor) { any = any || predictor.is_curved(); });
  }
  return any;
}

/// Settled from the measurements, is it lost? Throws std::runtime_error where it cannot be integrated.
bool ends_lost(PredictorPool& pool, int window) {
  const std::vector<FreeParameter> as_it_is;
  const Eigen::VectorXd none;
  StateSearch search(pool, window, as_it_is, none, none);
  Eigen::VectorXd start;
  pool.with(window, as_it_is, none, [&](Predictor& predictor) {
    start = predictor.search_start(pool.data().windows[static_cast<std::size_t>(window)]);
  });
  Settled at = search.from(start);
  if (!std::isfinite(at.reduced.raw_sse)) {
    throw std::runtime_error("a window cannot be integrated");
  }
  search.settle(kRoughly, at);
  return is_lost(pool.data(), window, at.reduced);
}

/// No more windows are tried than show that it does not.
bool settles_whole(const model::Model& model, const Data& data) {
  constexpr std::size_t kOneOf = 10;
  PredictorPool pool(model, data);
  std::atomic<std::size_t> lost{0};
  const auto are_too_many = [&] { return kOneOf * lost > data.windows.size(); };
  try {
    parallel_for(static_cast<int>(data.windows.size()), data.threads, [&](int w) {
      if (!are_too_many() && ends_lost(pool, w)) {
        ++lost;
      }
    });
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return false;
  }
  return !are_too_many();
}

/// Does the next step promise the floor, or what is close to it, above which it is? A straight line's promise
/// in a window as bent as this is not exact. Where the step promises nothing, the window is followed to its
/// end, and what is left there is evidence.
bool is_promising(const Data& data, int window, const Reduced& one) {
  constexpr double kPromised = 1.5;
  return is_above_floor(data, window, one.raw_sse) && !is_settled(one, kRoughly) &&
         !is_above_floor(data, window, one.sse, kPromised);
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

}  // namespace

bool can_be_followed_whole(const model::Model& model, const Data& data) {
  const auto settles = [&] { return !is_any_curved(model, data) || settles_whole(model, data); };
  const Record whole =
      kept(data, key_of("can_be_followed", model, data), [&] { return Record().add(settles() ? 1.0 : 0.0); });
  return RecordReader(whole).number() != 0.0;
}

Followed follow_whole(const model::Model& model, const Data& data) {
  const Record record = kept(data, key_of("follow", model, data), [&] {
    const Shares shares = shares_that_can_be_searched(model, data);
    return Record().add(shares.share).add(shares.x0);
  });
  RecordReader reader(record);
  const Eigen::VectorXd shares = reader.vector();
  if (shares.size() == 0) {
    return {data, {}, data.predict.window};
  }
  return {data.beginnings(std::vector<double>(shares.begin(), shares.end())), reader.vectors(),
          data.predict.window};
}

}  // namespace plumbline::validation
