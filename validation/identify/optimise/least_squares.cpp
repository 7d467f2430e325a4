#include "validation/identify/optimise/least_squares.h"

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>
#include <stdexcept>

namespace plumbline::validation {
namespace {

using Ipopt::Index;
using Ipopt::Number;

const char* words(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return "solved";
    case Ipopt::Solved_To_Acceptable_Level:
      return "solved to an acceptable level";
    case Ipopt::Infeasible_Problem_Detected:
      return "the constraints cannot be met from here";
    case Ipopt::Maximum_Iterations_Exceeded:
      return "too many iterations";
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return "steps became too small";
    case Ipopt::Restoration_Failed:
      return "no way back to the constraints";
    default:
      return "IPOPT gave up";
  }
}

/// In scaled unknowns.
class Problem : public Ipopt::TNLP {
 public:
  explicit Problem(const LeastSquares& p)
      : p_(p), n_(static_cast<int>(p.start.size())), m_(p.equalities + p.inequalities) {
    result.x = p.start;
    result.solved = false;
    if (!p.evaluate(p.start, result.values)) {
      throw std::runtime_error("the optimisation's start has no value");
    }
  }

  bool get_nlp_info(Index& n, Index& m, Index& nonzeros, Index& hessian, IndexStyleEnum& style) override {
    n = n_;
    m = m_;
    nonzeros = n_ * m_;
    hessian = n_ * (n_ + 1) / 2;
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Index, Number* lower, Number* upper, Index, Number* from, Number* to) override {
    for (int i = 0; i < n_; ++i) {
      lower[i] = p_.lower[i] / p_.scale[i];
      upper[i] = p_.upper[i] / p_.scale[i];
    }
    for (int i = 0; i < m_; ++i) {
      from[i] = 0.0;
      to[i] = i < p_.equalities ? 0.0 : 2e19;
    }
    return true;
  }
  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    for (int i = 0; i < n_; ++i) {
      x[i] = p_.start[i] / p_.scale[i];
    }
    return true;
  }
  bool eval_f(Index, const Number* x, bool, Number& f) override {
    if (!at(x)) {
      return false;
    }
    f = 0.5 * values_.residuals.squaredNorm();
    return true;
  }
  bool eval_grad_f(Index, const Number* x, bool, Number* gradient) override {
    if (!slopes(x)) {
      return false;
    }
    Eigen::Map<Eigen::VectorXd>(gradient, n_) = residual_slopes_.transpose() * values_.residuals;
    return true;
  }
  bool eval_g(Index, const Number* x, bool, Index, Number* g) override {
    if (!at(x)) {
      return false;
    }
    Eigen::Map<Eigen::VectorXd>(g, m_) << values_.equalities, values_.inequalities;
    return true;
  }
  bool eval_jac_g(Index, const Number* x, bool, Index, Index, Index* row, Index* column,
                  Number* value) override {
    if (value == nullptr) {
      for (int i = 0; i < m_ * n_; ++i) {
        row[i] = i / n_;
        column[i] = i % n_;
      }
      return true;
    }
    if (!slopes(x)) {
      return false;
    }
    for (int i = 0; i < m_ * n_; ++i) {
      value[i] = constraint_slopes_(i / n_, i % n_);
    }
    return true;
  }
  bool eval_h(Index, const Number* x, bool, Number factor, Index, const Number*, bool, Index, Index* row,
              Index* column, Number* value) override {
    if (value != nullptr && !slopes(x)) {
      return false;
    }
    const Eigen::MatrixXd normal = value == nullptr
                                       ? Eigen::MatrixXd()
                                       : Eigen::MatrixXd(residual_slopes_.transpose() * residual_slopes_);
    for (int i = 0, k = 0; i < n_; ++i) {
      for (int j = 0; j <= i; ++j, ++k) {
        if (value == nullptr) {
          row[k] = i;
          column[k] = j;
        } else {
          value[k] = factor * (normal(i, j) + (i == j ? p_.damping : 0.0));
        }
      }
    }
    return true;
  }
  void finalize_solution(Ipopt::SolverReturn status, Index, const Number* x, const Number*, const Number*,
                         Index, const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    if (at(x) && (status == Ipopt::SUCCESS || best_.size() == 0)) {
      best_ = x_;
    }
    if (best_.size() > 0 && at(best_.data())) {
      result.x = unscaled(best_);
      result.values = values_;
      result.feasible = is_feasible(values_);
    }
  }

  LeastSquaresResult result;

 private:
  Eigen::VectorXd unscaled(const Eigen::VectorXd& x) const { return x.cwiseProduct(p_.scale); }

  bool at(const Number* x) {
    const Eigen::Map<const Eigen::VectorXd> here(x, n_);
    if (known_ && here == x_) {
      return true;
    }
    x_ = here;
    slopes_known_ = false;
    known_ = p_.evaluate(unscaled(x_), values_);
    if (known_) {
      keep();
    }
    return known_;
  }

  bool is_feasible(const LeastSquares::Values& values) const {
    const double off = p_.equalities > 0 ? values.equalities.cwiseAbs().maxCoeff() : 0.0;
    const double beyond = p_.inequalities > 0 ? -values.inequalities.minCoeff() : 0.0;
    return off <= p_.feasible && beyond <= p_.feasible;
  }

  /// The best point so far that keeps the constraints.
  void keep() {
    const double objective = values_.residuals.squaredNorm();
    if (is_feasible(values_) && objective < best_objective_) {
      best_objective_ = objective;
      best_ = x_;
    }
  }

  bool slopes(const Number* x) {
    if (!at(x)) {
      return false;
    }
    if (slopes_known_) {
      return true;
    }
    residual_slopes_.resize(p_.residuals, n_);
    constraint_slopes_.resize(m_, n_);
    LeastSquares::Values ahead, behind;
    for (int i = 0; i < n_; ++i) {
      Eigen::VectorXd moved = x_;
      moved[i] += p_.difference;
      bool known = p_.evaluate(unscaled(moved), ahead);
      moved[i] -= 2.0 * p_.difference;
      known = known && p_.evaluate(unscaled(moved), behind);
      if (!known) {
        return false;
      }
      const double step = 2.0 * p_.difference;
      residual_slopes_.col(i) = (ahead.residuals - behind.residuals) / step;
      constraint_slopes_.col(i).head(p_.equalities) = (ahead.equalities - behind.equalities) / step;
      constraint_slopes_.col(i).tail(p_.inequalities) = (ahead.inequalities - behind.inequalities) / step;
    }
    slopes_known_ = true;
    return true;
  }

  const LeastSquares& p_;
  int n_, m_;
  bool known_ = false, slopes_known_ = false;
  double best_objective_ = std::numeric_limits<double>::infinity();
  Eigen::VectorXd x_, best_;
  LeastSquares::Values values_;
  Eigen::MatrixXd residual_slopes_, constraint_slopes_;
};

}  // namespace

LeastSquaresResult solve(const LeastSquares& p) {
  Ipopt::SmartPtr<Problem> problem = new Problem(p);
  Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = IpoptApplicationFactory();
  ipopt->Options()->SetIntegerValue("print_level", p.print_level);
  ipopt->Options()->SetStringValue("sb", "yes");
  ipopt->Options()->SetNumericValue("tol", p.tolerance);
  ipopt->Options()->SetIntegerValue("max_iter", p.iterations);
  ipopt->Options()->SetNumericValue("bound_relax_factor", 0.0);
  if (ipopt->Initialize() != Ipopt::Solve_Succeeded) {
    throw std::runtime_error("IPOPT does not start");
  }
  const Ipopt::ApplicationReturnStatus status = ipopt->OptimizeTNLP(problem);
  problem->result.solved = status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level;
  problem->result.status = words(status);
  if (Ipopt::IsValid(ipopt->Statistics())) {
    problem->result.iterations = ipopt->Statistics()->IterationCount();
  }
  return problem->result;
}

}  // namespace plumbline::validation
