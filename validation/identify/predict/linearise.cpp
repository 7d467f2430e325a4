// Residuals of a window with all their derivatives.
#include <algorithm>
#include <cmath>

#include "simulator/model/inertial_tangent.h"
#include "validation/identify/predict/clock_slopes.h"
#include "validation/identify/predict/plate_slopes.h"
#include "validation/identify/predict/sensitivity.h"
#include "validation/identify/predict/windows.h"

namespace plumbline::validation {
namespace {

std::vector<model::ParameterId> ids_of(const std::vector<FreeParameter>& parameters) {
  std::vector<model::ParameterId> ids;
  ids.reserve(parameters.size());
  for (const FreeParameter& parameter : parameters) {
    ids.push_back(parameter.id);
  }
  return ids;
}

/// By how much each parameter is moved for its slope: relative to its value, but a value next to nothing must
/// not make the step vanish in it.
Eigen::VectorXd steps_of_slopes(const model::Plant& plant, const std::vector<FreeParameter>& parameters) {
  constexpr double kNothing = 1e-3;
  Eigen::VectorXd steps(static_cast<Eigen::Index>(parameters.size()));
  for (Eigen::Index p = 0; p < steps.size(); ++p) {
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
    const double here = plant.value(parameter.id);
    const double reference = std::isfinite(here) ? std::abs(here) : 0.0;
    steps[p] = 1e-6 * (reference > kNothing * parameter.typical ? reference : parameter.typical);
    if (here + steps[p] > parameter.upper) {
      steps[p] = -steps[p];
    }
  }
  return steps;
}

/// Slopes of the sensors by states, then parameters, as those of a sample's channels in floors.
void write_rows(const Eigen::MatrixXd& slopes, const std::vector<int>& sensor_of_channel,
                const Eigen::VectorXd& floors, Eigen::Index first, Linearisation& out) {
  for (Eigen::Index c = 0; c < floors.size(); ++c) {
    const int s = sensor_of_channel[static_cast<std::size_t>(c)];
    out.Jx.row(first + c) = slopes.row(s).head(out.Jx.cols()) / floors[c];
    out.Jp.row(first + c) = slopes.row(s).tail(out.Jp.cols()) / floors[c];
  }
}

}  // namespace

// Linearisation over a piece, which is in sample k of the window: at the middle of its states, under the
// sample's mean command. The rigid parts are those of the sample's first piece. Held longer they seem to tell
// apart what the data cannot (OwnParameters.IntervalsHoldTheTruthAsOftenAsTheySay).
void Predictor::tangent_at(const Window& window, Eigen::Index k, const Piece& piece,
                           const std::vector<model::ParameterId>& ids, const Eigen::VectorXd& steps,
                           Eigen::MatrixXd& A, Eigen::MatrixXd& B) {
  Eigen::VectorXd command(plant_.motors());
  Eigen::VectorXd slope(plant_.motors());
  commands_->mean(window.first + k, command.data(), slope.data());
  const Eigen::VectorXd middle = 0.5 * (states_.col(piece.from) + states_.col(piece.to));
  // A hair less than the piece: a force may jump at its ends, which is not this piece's matter.
  const Eigen::VectorXd change = (1.0 - 1e-6) * (states_.col(piece.to) - states_.col(piece.from));
  const bool is_first = piece.from == node_of(k);
  plant_.tangent({middle.data(), change.data(), command.data(), slope.data(), length_of(piece), trial_.period,
                  is_behind_jump(piece.from)},
                 ids, steps, is_first, A, B);
  clock_slopes(plant_, command_samples_, window.first + k, trial_.period, middle, command, ids, B);
}

// Along the predicted motion, piece by piece (pieces_of). A compliant ground's force begins and ends at zero,
// so that nothing jumps at touchdown and lift-off.
Linearisation Predictor::linearise(const Window& window, const Eigen::VectorXd& x0,
                                   const std::vector<FreeParameter>& parameters) {
  constexpr int kPartsAfterJump = 4;  // it throws the deviations far along what is stiff behind it
  if (options_.differences) {
    return linearise_by_differences(window, x0, parameters);
  }
  for (const FreeParameter& parameter : parameters) {
    if (!parameter.also.empty()) {
      return linearise_tied(window, x0, parameters);
    }
  }
  Linearisation out;
  out.r = residual(window, x0);
  const Eigen::Index nx = plant_.states();
  const auto np = static_cast<Eigen::Index>(parameters.size());
  const std::vector<model::ParameterId> ids = ids_of(parameters);
  const Eigen::VectorXd steps = steps_of_slopes(plant_, parameters);
  out.Jx.setZero(out.r.size(), nx);
  out.Jp.setZero(out.r.size(), np);
  Sensitivity sensitivity(Eigen::MatrixXd::Identity(nx, nx + np));
  Eigen::MatrixXd& S = sensitivity.S();
  if (plant_.has_loops()) {
    const Eigen::Index moving = 2 * plant_.positions();
    S.topLeftCorner(moving, moving) = plant_.closing_slope(states_.col(0).data());
  }
  const std::vector<int> carried = plant_.carried_states();
  if (!carried.empty()) {
    S.rightCols(np) = hidden_slopes(window, ids, steps);
  }
  for (const int i : carried) {
    S(i, i) = 0.0;  // it follows the measured motion, not the window's start
  }
  Eigen::MatrixXd A(nx, nx);
  Eigen::MatrixXd B;
  Eigen::MatrixXd C;
  Eigen::MatrixXd D;
  const bool with_inertial = model::is_any_inertial(plant_.model(), ids);
  Eigen::VectorXd readings(plant_.sensors());
  const std::vector<Crossing> crossings = crossings_of(window);
  PlateSlopes plates(plant_, ids, steps);
  Eigen::MatrixXd forces;
  if (plates.any()) {
    forces = plates.at(states_.col(0), S);
  }
  for (Eigen::Index k = 0; k < window.count; ++k) {
    const Eigen::Index node = node_of(k);
    const double* command = command_of_reading(window, k);
    plant_.output_jacobian(states_.col(node).data(), C, command);
    plant_.output_tangent(states_.col(node).data(), ids, steps, D);
    if (with_inertial) {
      read_sensors(window, k, readings);
      model::add_inertial_tangent(plant_, readings, ids, steps, D);
    }
    Eigen::MatrixXd slopes = C * S.topRows(C.cols());
    slopes.rightCols(np) += D;
    if (accelerometers_ && window.count > 1) {
      if (k == 0) {
        tangent_at(window, k, pieces_of(k, crossings).front(), ids, steps, A, B);
      }
      const Eigen::MatrixXd map = plant_.acceleration_map(states_.col(node).data());
      const Eigen::Index nz = plant_.positions();
      slopes += map * (A.middleRows(nz, nz) * S);
      slopes.rightCols(np) += map * B.middleRows(nz, nz);
    }
    turn_slopes(out.r, k, slopes);
    if (plates.any()) {
      slopes += forces;  // a sensor's row is zero in one of the two
    }
    write_rows(slopes, sensor_of_channel_, floors_, k * channels(), out);
    if (k == held_from_) {
      break;
    }
    plates.begin();
    for (const Piece& piece : pieces_of(k, crossings)) {
      jump_slopes(piece.from, ids, steps, S);
      tangent_at(window, k, piece, ids, steps, A, B);
      sensitivity.step(length_of(piece), A, B, is_behind_jump(piece.from) ? kPartsAfterJump : 1);
      if (plates.any()) {
        plates.add(length_of(piece), 0.5 * (states_.col(piece.from) + states_.col(piece.to)),
                   sensitivity.mean());
      }
      timing_slopes(window, crossings, piece.from, sensitivity.before(), S, ids, out);
    }
    if (plates.any()) {
      forces = plates.mean();
    }
  }
  return out;
}

double Predictor::expansion(const Window& window, const Eigen::MatrixXd& Jx) const {
  const Eigen::VectorXd deviations = from_channels_.deviations();
  const Eigen::MatrixXd moved = Jx.leftCols(deviations.size()) * deviations.asDiagonal();
  double most = 0.0;
  for (Eigen::Index k = 0; k < window.count; ++k) {
    for (const Eigen::Index c : position_channels_) {
      most = std::max(most, moved.row(k * channels() + c).cwiseAbs().maxCoeff());
    }
  }
  return most;
}

// Each of the tied parameters by itself; their columns add up.
Linearisation Predictor::linearise_tied(const Window& window, const Eigen::VectorXd& x0,
                                        const std::vector<FreeParameter>& parameters) {
  std::vector<FreeParameter> apart;
  std::vector<Eigen::Index> owner;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    FreeParameter one = parameters[p];
    std::vector<model::ParameterId> ids{one.id};
    ids.insert(ids.end(), one.also.begin(), one.also.end());
    one.also.clear();
    for (const model::ParameterId& id : ids) {
      one.id = id;
      apart.push_back(one);
      owner.push_back(static_cast<Eigen::Index>(p));
    }
  }
  Linearisation out = linearise(window, x0, apart);
  Eigen::MatrixXd together =
      Eigen::MatrixXd::Zero(out.Jp.rows(), static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t k = 0; k < owner.size(); ++k) {
    together.col(owner[k]) += out.Jp.col(static_cast<Eigen::Index>(k));
  }
  out.Jp = together;
  return out;
}

namespace {

/// May a parameter have this value in a plant that was built with another? A law with states of its own must
/// not become null, or cease to be: its states would come or go.
bool can_be_set(const model::Plant& plant, model::ParameterId id, double value) {
  const effects::Law& law = *plant.model().effects[static_cast<std::size_t>(id.effect)].law;
  effects::Values values;
  for (int p = 0; p < static_cast<int>(law.declaration().parameters.size()); ++p) {
    values.push_back(plant.value({id.effect, p}));
  }
  const bool was_null = law.is_null(values.data());
  values[static_cast<std::size_t>(id.parameter)] = value;
  return law.state_count() == 0 || law.is_null(values.data()) == was_null;
}

}  // namespace

// Central differences for parameters, whose influence may be small beside the integrator's error; one-sided
// ones for states. Steps are small against a contact's depth (1 mm) and long against that error.
Linearisation Predictor::linearise_by_differences(const Window& window, const Eigen::VectorXd& x0,
                                                  const std::vector<FreeParameter>& parameters) {
  constexpr double kPositionStep = 1e-5;
  constexpr double kVelocityStep = 1e-3;
  constexpr double kShareOfParameter = 0.05;
  Linearisation out;
  out.r = residual(window, x0);
  const Eigen::Index nx = plant_.states();
  const Eigen::Index nz = plant_.positions();
  out.Jx = Eigen::MatrixXd::Zero(out.r.size(), nx);
  out.Jp.resize(out.r.size(), static_cast<Eigen::Index>(parameters.size()));
  const std::vector<int> carried = plant_.carried_states();
  Eigen::VectorXd moved = x0;
  for (Eigen::Index i = 0; i < nx; ++i) {
    if (std::find(carried.begin(), carried.end(), static_cast<int>(i)) != carried.end()) {
      continue;  // it follows the measured motion, not the window's start
    }
    const double step = i >= nz && i < 2 * nz ? kVelocityStep : kPositionStep;
    moved[i] = x0[i] + step;
    out.Jx.col(i) = (out.r - residual(window, moved)) / step;
    moved[i] = x0[i];
  }
  for (Eigen::Index p = 0; p < out.Jp.cols(); ++p) {
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
    const double here = plant_.value(parameter.id);
    const double step = kShareOfParameter * (here != 0.0 ? std::abs(here) : parameter.typical);
    double up = std::min(here + step, parameter.upper);
    double down = std::max(here - step, parameter.lower);
    up = can_be_set(plant_, parameter.id, up) ? up : here;
    down = can_be_set(plant_, parameter.id, down) ? down : here;
    if (!(up > down)) {
      out.Jp.col(p).setZero();
      continue;
    }
    parameter.set(plant_, up);
    const Eigen::VectorXd above = residual(window, x0);
    parameter.set(plant_, down);
    out.Jp.col(p) = (residual(window, x0) - above) / (up - down);
    parameter.set(plant_, here);
  }
  return out;
}

}  // namespace plumbline::validation
