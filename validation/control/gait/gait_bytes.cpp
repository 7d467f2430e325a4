#include "validation/control/gait/gait_bytes.h"

namespace plumbline::validation {
namespace {

void add(const Cycle& cycle, work::Bytes& bytes) {
  bytes.add(cycle.begin).add(cycle.end).add(static_cast<double>(cycle.foot)).add(cycle.values);
  bytes.add(static_cast<double>(cycle.curves.size()));
  for (const Eigen::VectorXd& curve : cycle.curves) {
    bytes.add(curve.data(), static_cast<std::size_t>(curve.size()));
  }
}

Cycle cycle_from(work::BytesReader& reader) {
  Cycle cycle;
  cycle.begin = reader.number();
  cycle.end = reader.number();
  cycle.foot = static_cast<int>(reader.number());
  cycle.values = reader.numbers();
  cycle.curves.resize(static_cast<std::size_t>(reader.number()));
  for (Eigen::VectorXd& curve : cycle.curves) {
    const std::vector<double> numbers = reader.numbers();
    curve = Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
  }
  return cycle;
}

}  // namespace

void add(const GaitRun& run, work::Bytes& bytes) {
  bytes.add(run.run.time).add(run.run.fell ? 1.0 : 0.0).add(run.run.end);
  bytes.add(static_cast<double>(run.run.fault)).add(run.run.energy_error).add(run.run.energy_exchanged);
  bytes.add(static_cast<double>(run.cycles.size()));
  for (const Cycle& cycle : run.cycles) {
    add(cycle, bytes);
  }
}

GaitRun gait_run_from(work::BytesReader& reader) {
  GaitRun run;
  run.run.time = reader.number();
  run.run.fell = reader.number() != 0.0;
  run.run.end = reader.text();
  run.run.fault = static_cast<int>(reader.number());
  run.run.energy_error = reader.number();
  run.run.energy_exchanged = reader.number();
  run.cycles.resize(static_cast<std::size_t>(reader.number()));
  for (Cycle& cycle : run.cycles) {
    cycle = cycle_from(reader);
  }
  return run;
}

}  // namespace plumbline::validation
