// What the sensors read along a predicted motion where that needs more than the state: the commands of
// accelerometers, and measured orientations, which have no difference of their own.
#include <Eigen/LU>

#include "simulator/model/rotation_vector.h"
#include "simulator/trace/error.h"
#include "validation/identify/predict/windows.h"

namespace plumbline::validation {

/// The command that held until the sample, null where no sensor asks for it.
const double* Predictor::command_of_reading(const Window& window, Eigen::Index sample) {
  if (!accelerometers_) {
    return nullptr;
  }
  reading_command_.resize(plant_.motors());
  const Eigen::Index k = window.first + sample;
  commands_->at(k > 0 ? k - 1 : 0, k > 0 ? commands_->breaks().size() - 1 : 0, reading_command_.data());
  return reading_command_.data();
}

// Measured less predicted is to be the turn from the one to the other: the predicted rotation vector is that
// of the measured orientation less this turn.
void Predictor::read_sensors(const Window& window, Eigen::Index sample, Eigen::VectorXd& y) {
  plant_.outputs(states_.col(node_of(sample)).data(), y.data(), command_of_reading(window, sample));
  for (const int c : orientation_channels_) {
    const int s = sensor_of_channel_[static_cast<std::size_t>(c)];
    Eigen::Vector3d measured;
    for (int axis = 0; axis < 3; ++axis) {
      measured[axis] = trial_.measured[static_cast<std::size_t>(c + axis)].values[window.first + sample];
    }
    y.segment<3>(s) = measured - model::turn_between(y.segment<3>(s), measured);
  }
}

// With e = log(R' R_measured), the residual, and R exp([d]) in the place of R: de = -J(-e)^-1 d, J the right
// Jacobian. `residual` is in units of the floors.
void Predictor::turn_slopes(const Eigen::VectorXd& residual, Eigen::Index sample,
                            Eigen::MatrixXd& slopes) const {
  for (const int c : orientation_channels_) {
    const Eigen::Vector3d e =
        residual.segment<3>(sample * channels() + c).cwiseProduct(floors_.segment<3>(c));
    const int s = sensor_of_channel_[static_cast<std::size_t>(c)];
    slopes.middleRows<3>(s) = model::right_jacobian(-e).inverse() * slopes.middleRows<3>(s).eval();
  }
}

void Predictor::find_point_sensors() {
  for (int c = 0; c < channels(); ++c) {
    const int s = sensor_of_channel_[static_cast<std::size_t>(c)];
    const model::Sensor& sensor = plant_.model().sensors[static_cast<std::size_t>(s)];
    accelerometers_ = accelerometers_ || sensor.reading == model::PointReading::accelerometer;
    if (sensor.reading != model::PointReading::orientation) {
      continue;
    }
    const int first = c - sensor.axis;
    const bool whole = first >= 0 && first + 2 < channels() &&
                       sensor_of_channel_[static_cast<std::size_t>(first)] == s - sensor.axis;
    if (!whole) {
      throw InputError({trial_.file, 0, "measured"}, "a component of orientation " + sensor.group + " alone",
                       "all three, x, y and z, one behind the other");
    }
    if (sensor.axis == 0) {
      orientation_channels_.push_back(c);
    }
  }
}

}  // namespace plumbline::validation
