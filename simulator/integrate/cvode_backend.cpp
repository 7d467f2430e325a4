// Backward differentiation formulas: CVODE with dense Newton iteration.
#include <cvode/cvode.h>
#include <cvode/cvode_proj.h>

#include <cstdlib>
#include <string>

#include "simulator/integrate/backend.h"
#include "simulator/integrate/handles.h"

namespace plumbline::integrate {

namespace {

struct FreeCvode {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

class CvodeBackend : public Backend {
 public:
  CvodeBackend(Bridge& bridge, const Options& options);

  void start(double t, const Eigen::VectorXd& x) override;
  void input_changed(bool keep_history) override;
  bool advance(double t_stop) override { return evolve_or_restart(t_stop, CV_NORMAL); }
  bool step_once(double t_stop) override { return evolve_or_restart(t_stop, CV_ONE_STEP); }
  Counts counts() const override;
  int worst_state() const override;

 private:
  void configure();
  void begin_anew();
  void restart();
  int evolve(double t_stop, int task);
  bool evolve_or_restart(double t_stop, int task);
  void require(int flag);
  Counts counts_since_restart() const;

  Context context_ = make_context();
  Vector vector_, tolerance_view_;
  Eigen::VectorXd tolerance_;
  DenseSolver dense_;
  std::unique_ptr<void, FreeCvode> memory_;
  Counts earlier_;           // until the last restart
  bool fresh_ = true;        // no step since the last restart
  bool stepping_ = false;    // some step has been tried since the start
  double first_step_ = 0.0;  // behind the last restart
};

CvodeBackend::CvodeBackend(Bridge& bridge, const Options& options)
    : Backend(bridge, options),
      vector_(view(x_, context_)),
      tolerance_(options.absolute_tolerance),
      dense_(vector_.get(), static_cast<int>(x_.size()), context_),
      memory_(CVodeCreate(CV_BDF, context_.get())) {
  tolerance_view_ = view(tolerance_, context_);
  configure();
}

void CvodeBackend::configure() {
  void* memory = memory_.get();
  require(CVodeSetErrHandlerFn(memory, Bridge::message, &bridge_));
  require(CVodeInit(memory, Bridge::rate, 0.0, vector_.get()));
  require(CVodeSetUserData(memory, &bridge_));
  if (options_.weight == Weight::reach) {
    bridge_.set_tolerances(options_.relative_tolerance, tolerance_);
    require(CVodeWFtolerances(memory, Bridge::weights));
  } else {
    require(CVodeSVtolerances(memory, options_.relative_tolerance, tolerance_view_.get()));
  }
  require(CVodeSetLinearSolver(memory, dense_.solver.get(), dense_.matrix.get()));
  if (bridge_.ode().has_jacobian()) require(CVodeSetJacFn(memory, Bridge::jacobian));
  if (bridge_.ode().has_projection()) {
    require(CVodeSetProjFn(memory, Bridge::project_correction));
    // The whole error is tested, not its part along the manifold alone: on the pendulum of tests/integrate
    // the cost is the same, the projections are a hundred times smaller, and the error falls with each
    // tolerance.
    require(CVodeSetProjErrEst(memory, 0));
  }
  if (!directions_.empty()) {
    require(CVodeRootInit(memory, static_cast<int>(directions_.size()), Bridge::switches));
    require(CVodeSetNoInactiveRootWarn(memory));
  }
  if (options_.order > 0) require(CVodeSetMaxOrd(memory, options_.order));
  if (options_.max_step > 0.0) require(CVodeSetMaxStep(memory, options_.max_step));
  require(CVodeSetMaxNumSteps(memory, options_.max_steps));
}

void CvodeBackend::require(int flag) {
  if (flag >= 0) return;
  const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(flag), &std::free);
  fail(bridge_.reason(name.get()));
}

void CvodeBackend::begin_anew() {
  require(CVodeReInit(memory_.get(), t_, vector_.get()));
  fresh_ = true;
}

void CvodeBackend::start(double t, const Eigen::VectorXd& x) {
  t_ = t;
  x_ = x;
  earlier_ = {};
  stepping_ = false;
  first_step_ = 0.0;
  require(CVodeSetInitStep(memory_.get(), 0.0));
  begin_anew();
}

void CvodeBackend::restart() {
  const Counts total = counts();
  // The first order step that did well behind the last restart: better than to search for one again.
  if (!fresh_) require(CVodeGetActualInitStep(memory_.get(), &first_step_));
  require(CVodeSetInitStep(memory_.get(), first_step_));
  earlier_ = total;
  ++earlier_.restarts;
  begin_anew();
}

void CvodeBackend::input_changed(bool keep_history) {
  if (!keep_history && !fresh_) restart();
}

int CvodeBackend::evolve(double t_stop, int task) {
  require(CVodeSetStopTime(memory_.get(), t_stop));
  stepping_ = true;
  return CVode(memory_.get(), t_stop, vector_.get(), &t_, task);
}

bool CvodeBackend::evolve_or_restart(double t_stop, int task) {
  int flag = evolve(t_stop, task);
  if ((flag == CV_ERR_FAILURE || flag == CV_CONV_FAILURE) && !fresh_) {
    // An input can jump so far that no step from the old history passes.
    restart();
    flag = evolve(t_stop, task);
  }
  if (flag != CV_TOO_MUCH_WORK) require(flag);
  fresh_ = false;
  if (flag != CV_ROOT_RETURN) return false;
  require(CVodeGetRootInfo(memory_.get(), directions_.data()));
  restart();
  return true;
}

int CvodeBackend::worst_state() const {
  if (fresh_ && !stepping_) return -1;
  return largest_estimate(memory_.get(), CVodeGetEstLocalErrors, CVodeGetErrWeights, context_);
}

Counts CvodeBackend::counts_since_restart() const {
  Counts counts;
  if (fresh_) return counts;
  CVodeGetNumSteps(memory_.get(), &counts.steps);
  CVodeGetNumErrTestFails(memory_.get(), &counts.error_test_failures);
  CVodeGetNumJacEvals(memory_.get(), &counts.jacobian_evaluations);
  return counts;
}

Counts CvodeBackend::counts() const {
  const Counts now = counts_since_restart();
  Counts sum = earlier_;
  sum.steps += now.steps;
  sum.error_test_failures += now.error_test_failures;
  sum.jacobian_evaluations += now.jacobian_evaluations;
  return sum;
}

}  // namespace

std::unique_ptr<Backend> make_cvode_backend(Bridge& bridge, const Options& options) {
  return std::make_unique<CvodeBackend>(bridge, options);
}

}  // namespace plumbline::integrate
