// Runge-Kutta methods: ARKODE's ARKStep, explicit or diagonally implicit.
#include <arkode/arkode_arkstep.h>

#include <cstdlib>
#include <string>

#include "simulator/integrate/handles.h"
#include "simulator/integrate/one_step_backend.h"
#include "simulator/integrate/step_control.h"

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

class ArkodeBackend : public OneStepBackend {
 public:
  ArkodeBackend(Bridge& bridge, const Options& options);

  void start(double t, const Eigen::VectorXd& x) override;
  Counts counts() const override;
  int worst_state() const override;

 protected:
  void step(double t_stop) override;
  void steps(double t_stop) override;
  void moved() override;

 private:
  static int choose_step(N_Vector y, realtype t, realtype h1, realtype h2, realtype h3, realtype e1,
                         realtype e2, realtype e3, int q, int p, realtype* next, void* self);
  void configure();
  void configure_implicit();
  void set_method();
  void require(int flag);
  void evolve(double t_stop, int task);

  Context context_ = make_context();
  Vector vector_, tolerance_view_;
  Eigen::VectorXd tolerance_;
  std::unique_ptr<DenseSolver> dense_;
  std::unique_ptr<void, FreeArkode> memory_;
  int order_ = 0;
  StepControl control_;
  bool fresh_ = true;      // no step since the start
  bool stepping_ = false;  // the first one is being tried
};

bool explicit_method(const Options& options) { return options.method == Method::explicit_rk; }

ArkodeBackend::ArkodeBackend(Bridge& bridge, const Options& options)
    : OneStepBackend(bridge, options),
      vector_(view(x_, context_)),
      tolerance_(options.absolute_tolerance),
      memory_(ARKStepCreate(explicit_method(options) ? Bridge::rate : nullptr,
                            explicit_method(options) ? nullptr : Bridge::rate, 0.0, vector_.get(),
                            context_.get())) {
  tolerance_view_ = view(tolerance_, context_);
  configure();
  if (!explicit_method(options_)) configure_implicit();
}

void ArkodeBackend::configure() {
  void* memory = memory_.get();
  require(ARKStepSetErrHandlerFn(memory, Bridge::message, &bridge_));
  require(ARKStepSetUserData(memory, &bridge_));
  if (options_.weight == Weight::reach) {
    bridge_.set_tolerances(options_.relative_tolerance, tolerance_);
    require(ARKStepWFtolerances(memory, Bridge::weights));
  } else {
    require(ARKStepSVtolerances(memory, options_.relative_tolerance, tolerance_view_.get()));
  }
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
  fail(bridge_.reason(name.get()));
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
  forget_switches();
  fresh_ = true;
  stepping_ = false;
}

void ArkodeBackend::moved() { require(ARKStepReset(memory_.get(), t_, vector_.get())); }

void ArkodeBackend::evolve(double t_stop, int task) {
  control_.set_stop(t_, t_stop);
  require(ARKStepSetStopTime(memory_.get(), t_stop));
  stepping_ = true;
  const int flag = ARKStepEvolve(memory_.get(), t_stop, vector_.get(), &t_, task);
  if (flag != ARK_TOO_MUCH_WORK) require(flag);
  fresh_ = false;
}

void ArkodeBackend::step(double t_stop) { evolve(t_stop, ARK_ONE_STEP); }

void ArkodeBackend::steps(double t_stop) { evolve(t_stop, ARK_NORMAL); }

int ArkodeBackend::worst_state() const {
  if (fresh_ && !stepping_) return -1;
  return largest_estimate(memory_.get(), ARKStepGetEstLocalErrors, ARKStepGetErrWeights, context_);
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
