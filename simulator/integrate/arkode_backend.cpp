// Runge-Kutta methods: ARKODE's ARKStep, explicit or diagonally implicit.
#include <arkode/arkode_arkstep.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "simulator/integrate/backend.h"
#include "simulator/integrate/handles.h"
#include "simulator/integrate/step_control.h"
#include "simulator/integrate/switch_search.h"

namespace plumbline::integrate {

namespace {

struct FreeArkode {
  void operator()(void* memory) const { ARKStepFree(&memory); }
};

constexpr double kSafety = 1.0 - 1e-15;  // ARKODE wants less than 1; the step control has its own

/// The methods, by order from 2. Chosen among ARKODE's by the work for a given error (tests/benchmark).
ARKODE_ERKTableID explicit_table(int order) {
  constexpr ARKODE_ERKTableID tables[] = {ARKODE_HEUN_EULER_2_1_2, ARKODE_BOGACKI_SHAMPINE_4_2_3,
                                          ARKODE_ZONNEVELD_5_3_4, ARKODE_CASH_KARP_6_4_5};
  return tables[order - 2];
}

ARKODE_DIRKTableID implicit_table(int order) {
  constexpr ARKODE_DIRKTableID tables[] = {ARKODE_TRBDF2_3_3_2, ARKODE_ESDIRK325L2SA_5_2_3,
                                           ARKODE_ESDIRK436L2SA_6_3_4, ARKODE_ESDIRK547L2SA_7_4_5};
  return tables[order - 2];
}

class ArkodeBackend : public Backend {
 public:
  ArkodeBackend(Bridge& bridge, const Options& options);

  void start(double t, const Eigen::VectorXd& x) override;
  void input_changed(bool keep_history) override;
  bool advance(double t_stop) override;
  Counts counts() const override;

 private:
  static int choose_step(N_Vector y, realtype t, realtype h1, realtype h2, realtype h3, realtype e1,
                         realtype e2, realtype e3, int q, int p, realtype* next, void* self);
  void configure();
  void configure_implicit();
  void set_method();
  void require(int flag);
  void evolve(double t_stop, int task);
  void go_to(double t, const Eigen::VectorXd& x, double t_stop);
  void reset();
  void locate(double t_before, double t_after);

  Context context_ = make_context();
  Vector vector_, tolerance_view_;
  Eigen::VectorXd tolerance_;
  std::unique_ptr<DenseSolver> dense_;
  std::unique_ptr<void, FreeArkode> memory_;
  int order_ = 0;
  StepControl control_;
  long restarts_ = 0;
  bool fresh_ = true;            // no step since the start
  bool switches_known_ = false;  // g_ belongs to the present state
  Eigen::VectorXd x_before_, g_, g_before_;
};

/// How closely a switch found within a step of size h to time t is located.
double time_tolerance(double t, double h) {
  return std::max(1e-11 * h, 256.0 * std::numeric_limits<double>::epsilon() * (std::abs(t) + h));
}

bool explicit_method(const Options& options) { return options.method == Method::explicit_rk; }

ArkodeBackend::ArkodeBackend(Bridge& bridge, const Options& options)
    : Backend(bridge, options),
      vector_(view(x_, context_)),
      tolerance_(options.absolute_tolerance),
      memory_(ARKStepCreate(explicit_method(options) ? Bridge::rate : nullptr,
                            explicit_method(options) ? nullptr : Bridge::rate, 0.0, vector_.get(),
                            context_.get())),
      x_before_(x_),
      g_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(directions_.size()))),
      g_before_(g_) {
  tolerance_view_ = view(tolerance_, context_);
  configure();
  if (!explicit_method(options_)) configure_implicit();
}

void ArkodeBackend::configure() {
  void* memory = memory_.get();
  require(ARKStepSetErrHandlerFn(memory, Bridge::message, &bridge_));
  require(ARKStepSetUserData(memory, &bridge_));
  require(ARKStepSVtolerances(memory, options_.relative_tolerance, tolerance_view_.get()));
  set_method();
  // States are wanted at the ends of steps only: no dense output, and no rates evaluated for it.
  require(ARKStepSetInterpolantType(memory, ARK_INTERP_LAGRANGE));
  require(ARKStepSetInterpolantDegree(memory, 0));
  if (bridge_.ode().has_projection()) require(ARKStepSetPostprocessStepFn(memory, Bridge::project_state));
  if (options_.max_step > 0.0) require(ARKStepSetMaxStep(memory, options_.max_step));
  require(ARKStepSetMaxNumSteps(memory, options_.max_steps));
  if (options_.fixed_step > 0.0) {
    require(ARKStepSetFixedStep(memory, options_.fixed_step));
    return;
  }
  require(ARKStepSetAdaptivityFn(memory, choose_step, this));
  require(ARKStepSetErrorBias(memory, 1.0));
  require(ARKStepSetSafetyFactor(memory, kSafety));
  require(ARKStepSetMaxGrowth(memory, 1e12));
  require(ARKStepSetFixedStepBounds(memory, 1.0, 1.0));
  require(ARKStepSetMaxErrTestFails(memory, 30));
}

void ArkodeBackend::set_method() {
  const bool is_explicit = explicit_method(options_);
  const int order = options_.order > 0 ? options_.order : is_explicit ? 5 : 4;
  require(ARKStepSetTableNum(memory_.get(), is_explicit ? ARKODE_DIRK_NONE : implicit_table(order),
                             is_explicit ? explicit_table(order) : ARKODE_ERK_NONE));
  order_ = order;
}

void ArkodeBackend::configure_implicit() {
  void* memory = memory_.get();
  dense_ = std::make_unique<DenseSolver>(vector_.get(), static_cast<int>(x_.size()), context_);
  require(ARKStepSetLinearSolver(memory, dense_->solver.get(), dense_->matrix.get()));
  if (bridge_.ode().has_jacobian()) require(ARKStepSetJacFn(memory, Bridge::jacobian));
  // The rate at a solved stage follows from the stage's equation: one evaluation less for each stage.
  require(ARKStepSetDeduceImplicitRhs(memory, 1));
  constexpr int bootstrap = 4;  // predicts the stages with the rate at the step's beginning
  require(ARKStepSetPredictorMethod(memory, bootstrap));
  // The deduced rates carry the iteration's error, divided by the step: ARKODE's default (0.1 of the
  // tolerance) then costs more accuracy than its few saved iterations are worth. Measured: tests/integrate,
  // Tolerance.
  require(ARKStepSetNonlinConvCoef(memory, 0.01));
  const bool fixed = options_.fixed_step > 0.0;  // then there is no smaller step to fall back to
  require(ARKStepSetMaxNonlinIters(memory, fixed ? 50 : 5));
  if (fixed) require(ARKStepSetNonlinCRDown(memory, 0.9));
  // To factorise again costs less, for few states, than a slower iteration.
  require(ARKStepSetDeltaGammaMax(memory, 1e-9));
}

void ArkodeBackend::require(int flag) {
  if (flag >= 0) return;
  const std::unique_ptr<char, decltype(&std::free)> name(ARKStepGetReturnFlagName(flag), &std::free);
  bridge_.fail(to_string(options_.method), t_, bridge_.reason(name.get()));
}

int ArkodeBackend::choose_step(N_Vector /*y*/, realtype t, realtype h1, realtype /*h2*/, realtype /*h3*/,
                               realtype e1, realtype /*e2*/, realtype /*e3*/, int /*q*/, int /*p*/,
                               realtype* next, void* self) {
  *next = static_cast<ArkodeBackend*>(self)->control_.next(t, h1, e1) / kSafety;
  return 0;
}

void ArkodeBackend::start(double t, const Eigen::VectorXd& x) {
  t_ = t;
  x_ = x;
  const bool is_explicit = explicit_method(options_);
  require(ARKStepReInit(memory_.get(), is_explicit ? Bridge::rate : nullptr,
                        is_explicit ? nullptr : Bridge::rate, t_, vector_.get()));
  // The embedded method has one order less; its local error has the method's order.
  control_ = StepControl(order_);
  restarts_ = 0;
  fresh_ = true;
  switches_known_ = false;
}

// Every step begins with the rate at its own beginning: nothing old is kept that a new input would falsify.
void ArkodeBackend::input_changed(bool /*keep_history*/) {}

void ArkodeBackend::reset() { require(ARKStepReset(memory_.get(), t_, vector_.get())); }

void ArkodeBackend::evolve(double t_stop, int task) {
  control_.set_stop(t_, t_stop);
  require(ARKStepSetStopTime(memory_.get(), t_stop));
  const int flag = ARKStepEvolve(memory_.get(), t_stop, vector_.get(), &t_, task);
  if (flag != ARK_TOO_MUCH_WORK) require(flag);
  fresh_ = false;
}

bool ArkodeBackend::advance(double t_stop) {
  if (directions_.empty()) {
    evolve(t_stop, ARK_NORMAL);
    return false;
  }
  if (!switches_known_) bridge_.switches_at(t_, x_, g_);
  const double t_before = t_;
  x_before_ = x_;
  g_before_ = g_;
  evolve(t_stop, ARK_ONE_STEP);
  bridge_.switches_at(t_, x_, g_);
  switches_known_ = true;
  const bool found = any_changes_sign(g_before_, g_);
  if (found) locate(t_before, t_);
  return found;
}

void ArkodeBackend::go_to(double t, const Eigen::VectorXd& x, double t_stop) {
  t_ = t;
  x_ = x;
  reset();
  while (t_ < t_stop) evolve(t_stop, ARK_NORMAL);
}

// The interpolant says where the switch is to about its own error; each integration to that place measures
// the error there, and so moves the next guess by a factor h^3 closer.
void ArkodeBackend::locate(double t_before, double t_after) {
  Eigen::VectorXd x_behind = x_;
  const Eigen::VectorXd x_after = x_;
  Eigen::VectorXd f_before(x_.size()), f_after(x_.size()), x_model(x_.size()), g_model(g_.size());
  Eigen::VectorXd defect = Eigen::VectorXd::Zero(g_.size());
  bridge_.rate_at(t_before, x_before_, f_before);
  bridge_.rate_at(t_after, x_after, f_after);
  const CubicHermite model(t_before, x_before_, f_before, t_after, x_after, f_after);
  const auto model_switches = [&](double t) -> const Eigen::VectorXd& {
    model.at(t, x_model);
    bridge_.switches_at(t, x_model, g_model);
    return g_model;
  };
  SwitchBracket bracket(t_before, g_before_, t_after, g_);
  const double tolerance = time_tolerance(t_after, bracket.width());
  for (int trial = 0; bracket.width() > tolerance; ++trial) {
    SwitchBracket search = bracket;
    while (search.width() > 0.25 * tolerance) {
      const double t = search.guess();
      search.narrow(t, model_switches(t) + defect);
    }
    if (bracket.hi() - search.hi() <= tolerance) break;
    // The model is no help where it does not converge: then halve.
    const double guess = trial < 8 ? search.hi() + 0.5 * tolerance : 0.5 * (bracket.lo() + bracket.hi());
    go_to(t_before, x_before_, guess);
    bridge_.switches_at(t_, x_, g_);
    defect = g_ - model_switches(t_);
    bracket.narrow(t_, g_);
    if (bracket.hi() == t_) x_behind = x_;
  }
  t_ = bracket.hi();
  x_ = x_behind;
  bridge_.switches_at(t_, x_, g_);
  bracket.directions(directions_);
  reset();
  ++restarts_;
}

Counts ArkodeBackend::counts() const {
  Counts counts;
  counts.restarts = restarts_;
  if (fresh_) return counts;
  ARKStepGetNumSteps(memory_.get(), &counts.steps);
  ARKStepGetNumErrTestFails(memory_.get(), &counts.error_test_failures);
  if (dense_) ARKStepGetNumJacEvals(memory_.get(), &counts.jacobian_evaluations);
  return counts;
}

}  // namespace

std::unique_ptr<Backend> make_arkode_backend(Bridge& bridge, const Options& options) {
  return std::make_unique<ArkodeBackend>(bridge, options);
}

}  // namespace plumbline::integrate
