// A motion that is known in closed form, as a trial.
#pragma once

#include <cmath>

#include "validation/identify/trial/trial.h"

namespace plumbline::validation {

/// q = a1 sin(w1 t) + a2 sin(w2 t + 1), 6 s at 1 ms.
struct KnownMotion {
  Eigen::VectorXd time, q, v, a;

  KnownMotion(double a1, double f1, double a2, double f2) {
    const double w1 = 2.0 * 3.14159265358979323846 * f1;
    const double w2 = 2.0 * 3.14159265358979323846 * f2;
    time = Eigen::VectorXd::LinSpaced(6000, 0.0, 5.999);
    const Eigen::ArrayXd p1 = w1 * time.array();
    const Eigen::ArrayXd p2 = w2 * time.array() + 1.0;
    q = a1 * p1.sin() + a2 * p2.sin();
    v = a1 * w1 * p1.cos() + a2 * w2 * p2.cos();
    a = -a1 * w1 * w1 * p1.sin() - a2 * w2 * w2 * p2.sin();
  }

  Trial trial(const std::string& sensor, const Eigen::VectorXd& measured,
              const Eigen::VectorXd& command) const {
    Trial trial;
    trial.file = "motion/trial.yaml";
    trial.name = "motion";
    trial.period = 1e-3;
    trial.time = time;
    trial.measured.push_back({sensor, "position", "m", measured});
    trial.commands.push_back({"drive", "vir", "V", command});
    return trial;
  }
};

}  // namespace plumbline::validation
