// SUNDIALS' objects, freed when they go out of scope.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <Eigen/Core>
#include <memory>

namespace plumbline::integrate {

struct FreeContext {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct FreeVector {
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
struct FreeMatrix {
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
};
struct FreeSolver {
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
};

using Context = std::unique_ptr<_SUNContext, FreeContext>;
using Vector = std::unique_ptr<_generic_N_Vector, FreeVector>;
using Matrix = std::unique_ptr<_generic_SUNMatrix, FreeMatrix>;
using Solver = std::unique_ptr<_generic_SUNLinearSolver, FreeSolver>;

Context make_context();
/// An N_Vector whose numbers are those of `storage`.
Vector view(Eigen::VectorXd& storage, const Context& context);

/// A dense matrix and the solver that factorises it.
struct DenseSolver {
  DenseSolver(N_Vector like, int size, const Context& context);
  Matrix matrix;
  Solver solver;
};

}  // namespace plumbline::integrate
