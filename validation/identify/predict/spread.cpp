#include "validation/identify/predict/spread.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "validation/identify/predict/work_ahead.h"
#include "work/workers.h"

namespace plumbline::validation {
namespace {

/// Below it windows take less than it costs to hand them out: samples times `cost`. A pendulum's recordings
/// of some seconds have 2e4, and 3 ms a window; a robot with ten coordinates has a hundred times that.
constexpr double kEnough = 1e6;

constexpr char kDone = 'd', kFailed = 'f';

bool is_enough(const Data& data, int count, const SharedItems& spread) {
  double samples = 0.0;
  for (const Window& window : data.windows) {
    samples += static_cast<double>(window.count);
  }
  const double share =
      static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(data.windows.size(), 1));
  return samples * share * spread.cost > kEnough;
}

std::string bytes_of(const Record& record) {
  const std::vector<double>& numbers = record.numbers();
  return kDone + std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
}

Record record_of(const std::string& bytes) {
  std::vector<double> numbers((bytes.size() - 1) / sizeof(double));
  std::memcpy(numbers.data(), bytes.data() + 1, numbers.size() * sizeof(double));
  return Record(std::move(numbers));
}

void add(const Eigen::MatrixXd& matrix, Record& record) {
  record.add(static_cast<double>(matrix.rows()));
  record.add(Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(matrix.data(), matrix.size())));
}

Eigen::MatrixXd matrix_from(RecordReader& reader) {
  const auto rows = static_cast<Eigen::Index>(reader.number());
  const Eigen::VectorXd numbers = reader.vector();
  if (numbers.size() == 0) {
    return Eigen::MatrixXd::Zero(rows, 0);
  }
  return Eigen::Map<const Eigen::MatrixXd>(numbers.data(), rows, numbers.size() / rows);
}

}  // namespace

void for_each_item(const Data& data, int count, const SharedItems& spread) {
  if (ranks_of(data) == 1 || count < 2 || !is_enough(data, count, spread)) {
    parallel_for(count, data.threads, spread.work);
    return;
  }
  std::vector<work::Task> tasks;
  for (int i = 0; i < count; ++i) {
    tasks.push_back({spread.name, [&spread, i]() -> std::string {
                       try {
                         spread.work(i);
                       } catch (const Stopped&) {
                         throw;
                       } catch (const std::runtime_error& error) {
                         return kFailed + std::string(error.what());
                       }
                       return bytes_of(spread.result(i));
                     }});
  }
  work::Watch watch;
  watch.stop = data.stop != nullptr ? &data.stop->raised : nullptr;
  const work::Results results = data.kept->workers()->run(tasks, watch);
  if (results.stopped) {
    throw Stopped();
  }
  for (const std::string& bytes : results.bytes) {
    if (bytes.front() == kFailed) {
      throw std::runtime_error(bytes.substr(1));
    }
  }
  for (int i = 0; i < count; ++i) {
    spread.take(i, record_of(results.bytes[static_cast<std::size_t>(i)]));
  }
}

double cost_of(const model::Model& model, double trajectories) {
  const auto coordinates = static_cast<double>(model.coordinates.size());
  return trajectories * coordinates * coordinates;
}

SharedItems spread_of(const std::string& name, const model::Model& model, std::size_t moving,
                      const std::function<void(int item)>& work, std::vector<Reduced>& all) {
  const auto result = [&all](int i) {
    Record record;
    add(all[static_cast<std::size_t>(i)], record);
    return record;
  };
  const auto take = [&all](int i, const Record& record) {
    RecordReader reader(record);
    all[static_cast<std::size_t>(i)] = reduced_from(reader);
  };
  constexpr double kStates = 8.0;  // of a robot with a few joints
  return {name, cost_of(model, kStates + static_cast<double>(moving)), work, result, take};
}

void add(const Reduced& reduced, Record& record) {
  add(reduced.H, record);
  record.add(reduced.g).add(reduced.sse).add(reduced.raw_sse).add(reduced.curved ? 1.0 : 0.0);
  record.add(reduced.expansion).add(reduced.square).add(reduced.x_shift);
  add(reduced.x_slope, record);
  add(reduced.x_H, record);
  add(reduced.channel_slopes, record);
}

Reduced reduced_from(RecordReader& reader) {
  Reduced reduced;
  reduced.H = matrix_from(reader);
  reduced.g = reader.vector();
  reduced.sse = reader.number();
  reduced.raw_sse = reader.number();
  reduced.curved = reader.number() != 0.0;
  reduced.expansion = reader.number();
  reduced.square = reader.vector();
  reduced.x_shift = reader.vector();
  reduced.x_slope = matrix_from(reader);
  reduced.x_H = matrix_from(reader);
  reduced.channel_slopes = matrix_from(reader);
  return reduced;
}

}  // namespace plumbline::validation
