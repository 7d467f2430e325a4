#include "simulator/model/loop_closure.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"

namespace plumbline::model {
namespace {

constexpr double kRank = 1e-8;     // of the largest singular value: rows of lengths over radians
constexpr double kClosed = 1e-12;  // of the loops' size
constexpr double kTurn = 1.5;      // rad or m, how far positions are drawn from
constexpr int kLooks = 6;          // positions at which it is asked what a loop can hold

[[noreturn]] void refuse(const Loop& loop, const std::string& found, const std::string& expected) {
  throw InputError({loop.file, loop.line, "loops: " + loop.name}, found, expected);
}

int rank_of(const Eigen::MatrixXd& J) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(J.transpose());
  qr.setThreshold(kRank);
  return static_cast<int>(qr.rank());
}

}  // namespace

LoopClosure::LoopClosure(const Model& model, std::vector<Loop> loops, const Eigen::MatrixXd& S,
                         const Eigen::VectorXd& q0)
    : loops_(std::move(loops)),
      S_(S),
      q0_(q0),
      mechanism_(model.skeleton),
      rows_(model.skeleton, loops_, mechanism_) {
  leave_out_what_always_holds();
  find_home(model);
  refuse_redundant();
}

// A kept row is a combination of one loop's rows.
const Loop& LoopClosure::loop_of(int row) const {
  Eigen::Index column = 0;
  rows_.kept().row(row).cwiseAbs().maxCoeff(&column);
  return loops_[static_cast<std::size_t>(rows_.loop_of(static_cast<int>(column)))];
}

void LoopClosure::place(const Eigen::VectorXd& z) {
  q_.noalias() = S_ * z;
  q_ += q0_;
  v_.setZero(q_.size());
  mechanism_.evaluate(q_, v_, M_, h_);
}

const Eigen::VectorXd& LoopClosure::errors(const Eigen::VectorXd& z) {
  place(z);
  rows_.errors(mechanism_.tree(), errors_);
  return errors_;
}

const Eigen::MatrixXd& LoopClosure::jacobian(const Eigen::VectorXd& z) {
  place(z);
  rows_.jacobian(mechanism_.tree(), static_cast<int>(S_.rows()), tree_J_);
  J_.noalias() = tree_J_ * S_;
  return J_;
}

// A linear congruential generator (Knuth's MMIX): what matters is that positions are generic.
Eigen::VectorXd LoopClosure::somewhere(double reach) {
  Eigen::VectorXd z(S_.cols());
  for (double& one : z) {
    draws_ = draws_ * 6364136223846793005ULL + 1442695040888963407ULL;
    one = reach * (2.0 * static_cast<double>(draws_ >> 11U) / 9007199254740992.0 - 1.0);
  }
  return z;
}

// Combinations of a loop's rows that no joint can change: the way out of the plane of a planar mechanism.
// They are closed or they never are.
void LoopClosure::leave_out_what_always_holds() {
  constexpr double kNever = 1e-6;  // of the loops' size: coordinates of points are rounded
  std::vector<Eigen::VectorXd> z;
  std::vector<Eigen::MatrixXd> J;
  for (int look = 0; look < kLooks; ++look) {
    z.push_back(somewhere(kTurn));
    J.push_back(jacobian(z.back()));
  }
  const Eigen::VectorXd apart = errors(z.front());
  const int all = rows_.all();
  Eigen::MatrixXd kept = Eigen::MatrixXd::Zero(all, all);
  int count = 0;
  for (int first = 0; first < all;) {
    int rows = 1;
    while (first + rows < all && rows_.loop_of(first + rows) == rows_.loop_of(first)) {
      ++rows;
    }
    const Loop& loop = loops_[static_cast<std::size_t>(rows_.loop_of(first))];
    Eigen::MatrixXd stacked(rows, kLooks * S_.cols());
    for (int look = 0; look < kLooks; ++look) {
      stacked.middleCols(look * S_.cols(), S_.cols()) =
          J[static_cast<std::size_t>(look)].middleRows(first, rows);
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(stacked, Eigen::ComputeThinU);
    const double most = svd.singularValues().size() > 0 ? svd.singularValues()[0] : 0.0;
    const int before = count;
    for (int i = 0; i < rows; ++i) {
      const Eigen::VectorXd along = svd.matrixU().col(i);
      if (svd.singularValues()[i] > kRank * std::max(most, rows_.length())) {
        kept.row(count++).segment(first, rows) = along.transpose();
        continue;
      }
      const double gap = std::abs(along.dot(apart.segment(first, rows)));
      if (gap > kNever * rows_.length()) {
        refuse(loop, "ends that stay " + number_text(gap, 3) + " m apart, whatever the joints do",
               "points, axes and a length that some position of the joints brings together");
      }
    }
    if (count == before) {
      refuse(loop, "a loop between links that cannot move against each other",
             "links with joints between them");
    }
    first += rows;
  }
  rows_.keep(kept.topRows(count));
}

void LoopClosure::find_home(const Model& model) {
  constexpr int kTries = 60;
  const Eigen::Index n = S_.cols();
  Eigen::MatrixXd C(static_cast<Eigen::Index>(model.loops_near.size()), n);
  Eigen::VectorXd y(C.rows());
  for (Eigen::Index i = 0; i < C.rows(); ++i) {
    const Lock& near = model.loops_near[static_cast<std::size_t>(i)];
    Eigen::Index index = 0;
    for (const Joint& joint : model.skeleton.joints) {
      if (joint.name == near.at) {
        break;
      }
      index += joint.type == JointType::fixed ? 0 : 1;
    }
    C.row(i) = S_.row(index);
    y[i] = near.value - q0_[index];
  }
  const Eigen::VectorXd begin =
      C.rows() > 0 ? Eigen::VectorXd(C.completeOrthogonalDecomposition().solve(y)) : Eigen::VectorXd::Zero(n);
  const Eigen::MatrixXd free(0, n);
  double least = -1.0;
  Eigen::VectorXd closest;
  for (int i = 0; i < kTries; ++i) {
    home_ = begin;
    if (i > 0) {
      home_ += somewhere(kTurn * std::min(1.0, 0.1 * i));
    }
    const bool closed = close(free, {}, home_);
    const double gap = errors(home_).cwiseAbs().maxCoeff();
    if (closed && rank_of(jacobian(home_)) == size()) {
      return;
    }
    if (least < 0.0 || gap < least) {
      least = gap;
      closest = home_;
    }
  }
  home_ = closest;
  if (is_closed(home_)) {
    return;  // whatever is wrong, it is not that: see refuse_redundant
  }
  const Eigen::VectorXd all = rows_.kept().transpose() * errors(home_);
  Eigen::Index worst = 0;
  all.cwiseAbs().maxCoeff(&worst);
  refuse(loops_[static_cast<std::size_t>(rows_.loop_of(static_cast<int>(worst)))],
         "ends that no position of the joints was found to bring nearer than " + number_text(least, 3) + " m",
         "a loop that can be closed; `near` states positions of joints to begin from");
}

// The first loop whose rows depend on those before it.
void LoopClosure::refuse_redundant() {
  const Eigen::MatrixXd J = jacobian(home_);
  if (rank_of(J) == size()) {
    return;
  }
  int end = 0;
  for (const Loop& loop : loops_) {
    while (end < size() && &loop_of(end) == &loop) {
      ++end;
    }
    if (rank_of(J.topRows(end)) < end) {
      refuse(loop, "a loop that holds again what joints, locks or other loops hold already",
             "loops that are independent: a connect or a rod in place of a hinge or a weld leaves more free");
    }
  }
}

// exact: towards phi = 0 alone, by the shortest way.
Eigen::VectorXd LoopClosure::step(const Eigen::MatrixXd& C, const Eigen::VectorXd& miss,
                                  const Eigen::VectorXd& z, bool exact) {
  const Eigen::VectorXd off = errors(z);
  const Eigen::MatrixXd& J = jacobian(z);
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> onto;
  onto.setThreshold(kRank);
  onto.compute(J);
  Eigen::VectorXd move = -onto.solve(off);
  if (exact || C.rows() == 0 || onto.rank() == z.size()) {
    return move;
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(J.transpose());
  const Eigen::MatrixXd Q = qr.householderQ();
  const Eigen::MatrixXd along = Q.rightCols(z.size() - onto.rank());
  move += along * (C * along).eval().completeOrthogonalDecomposition().solve(-(miss + C * move));
  return move;
}

bool LoopClosure::close(const Eigen::MatrixXd& C, const Eigen::VectorXd& y, Eigen::VectorXd& z) {
  constexpr int kSteps = 60;
  constexpr int kPolish = 3;
  constexpr double kLongest = 0.3;  // rad or m
  constexpr double kStill = 1e-11;
  for (int i = 0; i < kSteps; ++i) {
    Eigen::VectorXd move = step(C, C.rows() > 0 ? Eigen::VectorXd(C * z - y) : y, z, false);
    const double longest = move.cwiseAbs().maxCoeff();
    if (!std::isfinite(longest)) {
      return false;
    }
    z += longest > kLongest ? Eigen::VectorXd(move * (kLongest / longest)) : move;
    if (longest < kStill * (1.0 + z.cwiseAbs().maxCoeff())) {
      break;
    }
  }
  for (int i = 0; i < kPolish; ++i) {
    const double before = errors(z).cwiseAbs().maxCoeff();
    const Eigen::VectorXd there = z + step(C, y, z, true);
    if (!(errors(there).cwiseAbs().maxCoeff() < before)) {
      break;
    }
    z = there;
  }
  return is_closed(z);
}

bool LoopClosure::is_closed(const Eigen::VectorXd& z) {
  return errors(z).cwiseAbs().maxCoeff() <= kClosed * rows_.length();
}

Eigen::VectorXd LoopClosure::velocities(const Eigen::MatrixXd& C, const Eigen::VectorXd& y,
                                        const Eigen::VectorXd& z) {
  const Eigen::MatrixXd& J = jacobian(z);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(J.transpose());
  const Eigen::MatrixXd Q = qr.householderQ();
  const Eigen::MatrixXd along = Q.rightCols(z.size() - J.rows());
  if (C.rows() == 0 || along.cols() == 0) {
    return Eigen::VectorXd::Zero(z.size());
  }
  return along * (C * along).eval().completeOrthogonalDecomposition().solve(y);
}

}  // namespace plumbline::model
