#include "controllers/blocks/virtual_constraints.h"

#include <algorithm>
#include <cstddef>

namespace plumbline::controllers {
namespace {

// de Casteljau's scheme on the differences gives the derivatives: B' = 5 sum (a_{k+1} - a_k) B4_k.
double casteljau(const double* alpha, int degree, double s) noexcept {
  double a[6];
  std::copy(alpha, alpha + degree + 1, a);
  for (int level = degree; level > 0; --level) {
    for (int k = 0; k < level; ++k) a[k] += s * (a[k + 1] - a[k]);
  }
  return a[0];
}

void add_curve(const std::string& name, const char* unit, Curve& curve, std::vector<GaitNumber>& numbers) {
  for (std::size_t k = 0; k < curve.alpha.size(); ++k) {
    numbers.push_back({name + "_" + std::to_string(k), unit, &curve.alpha[k]});
  }
}

}  // namespace

std::vector<GaitNumber> numbers_of(WalkingGait& gait) {
  std::vector<GaitNumber> numbers{
      {"theta_begin", "rad", &gait.theta_begin}, {"theta_mc", "rad", &gait.theta_mc},
      {"theta_sc", "rad", &gait.theta_sc},       {"theta_si", "rad", &gait.theta_si},
      {"theta_end", "rad", &gait.theta_end},     {"spring_switch", "rad", &gait.spring_switch}};
  add_curve("torso", "rad", gait.torso, numbers);
  add_curve("swing_angle", "rad", gait.swing_angle, numbers);
  add_curve("swing_shape", "rad", gait.swing_shape, numbers);
  add_curve("shape_mc", "rad", gait.shape_mc, numbers);
  add_curve("shape_si", "rad", gait.shape_si, numbers);
  const char* const motors[] = {"stance_angle", "stance_shape", "swing_angle", "swing_shape"};
  const char* const phases[] = {"mc", "sc", "si", "sd"};
  for (std::size_t motor = 0; motor < 4; ++motor) {
    for (std::size_t phase = 0; phase < 4; ++phase) {
      add_curve(std::string("u_") + motors[motor] + "_" + phases[phase], "N m", gait.torque[motor][phase],
                numbers);
    }
  }
  return numbers;
}

void place_curves(WalkingGait& gait) noexcept {
  const auto place = [](Curve& curve, double begin, double end) {
    curve.begin = begin;
    curve.end = end;
  };
  place(gait.torso, gait.theta_begin, gait.theta_si);
  place(gait.swing_angle, gait.theta_begin, gait.theta_end);
  place(gait.swing_shape, gait.theta_begin, gait.theta_end);
  place(gait.shape_mc, gait.theta_begin, gait.theta_mc);
  place(gait.shape_si, gait.theta_sc, gait.theta_si);
  const double ends[] = {gait.theta_begin, gait.theta_mc, gait.theta_sc, gait.theta_si, gait.theta_end};
  for (auto& motor : gait.torque) {
    for (std::size_t phase = 0; phase < 4; ++phase) place(motor[phase], ends[phase], ends[phase + 1]);
  }
}

CurvePoint evaluate(const Curve& curve, double theta, bool go_on) noexcept {
  const double length = curve.end - curve.begin;
  const double raw = (theta - curve.begin) / length;
  const double s = std::clamp(raw, 0.0, 1.0);
  double first[5], second[4];
  for (int k = 0; k < 5; ++k) {
    first[k] =
        5.0 * (curve.alpha[static_cast<std::size_t>(k) + 1] - curve.alpha[static_cast<std::size_t>(k)]);
  }
  for (int k = 0; k < 4; ++k) second[k] = 4.0 * (first[k + 1] - first[k]);
  CurvePoint point{casteljau(curve.alpha.data(), 5, s), casteljau(first, 4, s) / length,
                   casteljau(second, 3, s) / (length * length)};
  if (raw != s) {
    point.curvature = 0.0;
    if (go_on) {
      point.value += (raw - s) * length * point.slope;
    } else {
      point.slope = 0.0;
    }
  }
  return point;
}

std::array<CurvePoint, 4> wanted(const WalkingGait& gait, WalkPhase phase, double theta) noexcept {
  std::array<CurvePoint, 4> h{};
  switch (phase) {
    case WalkPhase::motor_compress:
      h[kStanceShape] = evaluate(gait.shape_mc, theta, gait.go_on);
      break;
    case WalkPhase::spring_compress:
      h[kStanceShape].value = gait.shape_mc.alpha[5];
      break;
    case WalkPhase::spring_inject:
      h[kStanceShape] = evaluate(gait.shape_si, theta, gait.go_on);
      break;
    case WalkPhase::spring_decompress:
      h[kStanceShape].value = gait.shape_si.alpha[5];
      break;
  }
  h[kSwingAngle] = evaluate(gait.swing_angle, theta, gait.go_on);
  h[kSwingShape] = evaluate(gait.swing_shape, theta, gait.go_on);
  if (phase == WalkPhase::spring_decompress) {
    h[kTorso].value = gait.torso.alpha[5];
  } else {
    h[kTorso] = evaluate(gait.torso, theta, gait.go_on);
  }
  return h;
}

std::array<double, 4> feedforward(const WalkingGait& gait, WalkPhase phase, double theta) noexcept {
  std::array<double, 4> u{};
  for (std::size_t motor = 0; motor < 4; ++motor) {
    u[motor] = evaluate(gait.torque[motor][static_cast<std::size_t>(phase)], theta, false).value;
  }
  return u;
}

WalkPhase next_phase(const WalkingGait& gait, WalkPhase phase, double theta, double spring,
                     double spring_rate, double latest_sc) noexcept {
  if (phase == WalkPhase::motor_compress && theta >= gait.theta_mc) return WalkPhase::spring_compress;
  if (phase == WalkPhase::spring_compress &&
      ((spring <= gait.spring_switch && spring_rate < 0.0) || theta >= gait.theta_mc + latest_sc)) {
    return WalkPhase::spring_inject;
  }
  if (phase == WalkPhase::spring_inject && theta >= gait.theta_si) return WalkPhase::spring_decompress;
  return phase;
}

}  // namespace plumbline::controllers
