// The same work for each of many windows: on threads, or on the ranks among which work is shared.
#pragma once

#include <functional>
#include <string>

#include "validation/identify/predict/estimate.h"
#include "validation/identify/predict/kept_results.h"

namespace plumbline::validation {

/// What is done for each item, and how its result travels.
struct SharedItems {
  std::string name;                                          ///< for the record of durations
  double cost = 1.0;                                         ///< of a sample (cost_of)
  std::function<void(int item)> work;                        ///< leaves its result where the caller wants it
  std::function<Record(int item)> result;                    ///< that result
  std::function<void(int item, const Record& result)> take;  ///< puts a result there
};

/// Does the work of items 0 to count - 1. With one rank: on the data's threads (parallel_for). With several,
/// where there is enough of it: each item by one of them, and all ranks take all results. Throws what the
/// work throws: of several items that fail the first one's message, as std::runtime_error.
void for_each_item(const Data& data, int count, const SharedItems& spread);

/// About what so many trajectories cost a sample: each takes products of matrices of the model's coordinates.
double cost_of(const model::Model& model, double trajectories);

/// Work that fills `all`, which must outlive it; a trajectory for each of the `moving` parameters and each
/// state.
SharedItems spread_of(const std::string& name, const model::Model& model, std::size_t moving,
                      const std::function<void(int item)>& work, std::vector<Reduced>& all);

/// A window's normal equations as numbers.
void add(const Reduced& reduced, Record& record);
Reduced reduced_from(RecordReader& reader);

}  // namespace plumbline::validation
