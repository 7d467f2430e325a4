// Simbody's own integrators on the same rates.
#pragma once

#include <string>

#include "tests/benchmark/replay.h"

namespace plumbline::benchmarks {

enum class Peer { runge_kutta_merson, cpodes_bdf };

std::string to_string(Peer peer);

/// The hop by one of Simbody's integrators. They need a SimTK::System: here one without bodies, whose
/// auxiliary variables z are the plant's states and whose zdot is Plant::rate. (The plant's own way of
/// eliminating rigid ratios has no counterpart among Simbody's mobilizers without constraints.) So the
/// equations and the cost of one evaluation are the same, and what is compared is the integrators. Simbody's
/// error control is absolute, with a weight for each variable: here one over the variable's largest magnitude
/// in `reference`, which our methods do not know. At every sample the command jumps, the integrator is told
/// so, and CPodes begins anew. Throws std::exception when the integrator gives up or takes longer than
/// `patience` seconds.
Course simulate(const Replay& hop, model::Plant& plant, Peer peer, double accuracy, const Course& reference,
                double patience);

}  // namespace plumbline::benchmarks
