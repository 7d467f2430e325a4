#include "simulator/integrate/integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "simulator/integrate/backend.h"
#include "simulator/integrate/bridge.h"

namespace plumbline::integrate {

namespace {

Options complete(Options options, int states) {
  options.validate();
  Eigen::VectorXd& tolerance = options.absolute_tolerance;
  if (tolerance.size() == 0) tolerance = Eigen::VectorXd::Constant(1, 1e-9);
  if (tolerance.size() == 1) tolerance = Eigen::VectorXd::Constant(states, tolerance[0]);
  if (tolerance.size() != states) {
    throw std::invalid_argument(
        "integrator option absolute_tolerance: found " + std::to_string(tolerance.size()) +
        " values, expected none, one, or one for each of the " + std::to_string(states) + " states");
  }
  return options;
}

std::unique_ptr<Backend> make_backend(Bridge& bridge, const Options& options) {
  switch (options.method) {
    case Method::bdf:
      return make_cvode_backend(bridge, options);
    case Method::rosenbrock:
      return make_rosenbrock_backend(bridge, options);
    case Method::implicit_rk:
    case Method::explicit_rk:
      break;
  }
  return make_arkode_backend(bridge, options);
}

/// Times closer than this are the same to SUNDIALS.
double roundoff(double t) { return 4.0 * std::numeric_limits<double>::epsilon() * std::abs(t); }

std::string in_seconds(double t) {
  std::ostringstream text;
  text.precision(12);
  text << t << " s";
  return text.str();
}

}  // namespace

struct Integrator::Impl {
  Impl(Ode& ode, const Options& given)
      : options(complete(given, ode.size())),
        method(to_string(options.method)),
        bridge(ode, options.method),
        backend(make_backend(bridge, options)) {
    events.reserve(64);
  }

  void record_switches() {
    for (std::size_t i = 0; i < backend->directions().size(); ++i) {
      const int direction = backend->directions()[i];
      if (direction != 0) {
        events.push_back({backend->time(), static_cast<int>(i), direction, backend->state()});
      }
    }
  }

  void forbid_return(double t_end) {
    if (!(t_end >= backend->time() - roundoff(t_end))) fail("cannot go back to t = " + in_seconds(t_end));
  }

  [[noreturn]] void fail(const std::string& reason) { backend->fail(reason); }

  Options options;
  std::string method;
  Bridge bridge;
  std::unique_ptr<Backend> backend;
  std::vector<Event> events;
};

Integrator::Integrator(Ode& ode, const Options& options) : impl_(std::make_unique<Impl>(ode, options)) {}
Integrator::~Integrator() = default;

void Integrator::start(double t, const Eigen::VectorXd& x) {
  if (x.size() != impl_->backend->state().size()) {
    throw std::invalid_argument("Integrator::start: found " + std::to_string(x.size()) +
                                " states, expected " + std::to_string(impl_->backend->state().size()));
  }
  impl_->events.clear();
  impl_->bridge.reset();
  impl_->backend->start(t, x);
}

void Integrator::input_changed(bool keep_history) {
  impl_->bridge.forget();
  impl_->backend->input_changed(keep_history);
}

void Integrator::advance(double t_end) {
  Backend& backend = *impl_->backend;
  impl_->forbid_return(t_end);
  const long allowed = backend.counts().steps + impl_->options.max_steps;
  while (t_end - backend.time() > roundoff(t_end)) {
    if (backend.counts().steps >= allowed) {
      impl_->fail("max_steps = " + std::to_string(impl_->options.max_steps) +
                  " steps do not reach t = " + in_seconds(t_end) + ".");
    }
    if (backend.advance(t_end)) impl_->record_switches();
  }
  backend.set_time(t_end);
}

void Integrator::step(double t_end) {
  Backend& backend = *impl_->backend;
  impl_->forbid_return(t_end);
  if (t_end - backend.time() > roundoff(t_end) && backend.step_once(t_end)) impl_->record_switches();
  if (t_end - backend.time() <= roundoff(t_end)) backend.set_time(t_end);
}

double Integrator::time() const { return impl_->backend->time(); }
const Eigen::VectorXd& Integrator::state() const { return impl_->backend->state(); }
const std::vector<Event>& Integrator::events() const { return impl_->events; }

Summary Integrator::summary() const {
  const Counts counts = impl_->backend->counts();
  Summary summary;
  summary.method = impl_->method;
  summary.steps = counts.steps;
  summary.error_test_failures = counts.error_test_failures;
  summary.rate_evaluations = impl_->bridge.rate_evaluations;
  summary.jacobian_evaluations = counts.jacobian_evaluations;
  summary.restarts = counts.restarts;
  summary.switches_found = static_cast<long>(impl_->events.size());
  summary.largest_projection = impl_->bridge.largest_projection;
  return summary;
}

}  // namespace plumbline::integrate
