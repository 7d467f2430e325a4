#include "simulator/integrate/handles.h"

#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <stdexcept>

namespace plumbline::integrate {

Context make_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) throw std::runtime_error("SUNDIALS: no context");
  return Context(context);
}

Vector view(Eigen::VectorXd& storage, const Context& context) {
  Vector vector(N_VMake_Serial(storage.size(), storage.data(), context.get()));
  if (!vector) throw std::runtime_error("SUNDIALS: no vector");
  return vector;
}

DenseSolver::DenseSolver(N_Vector like, int size, const Context& context)
    : matrix(SUNDenseMatrix(size, size, context.get())),
      solver(SUNLinSol_Dense(like, matrix.get(), context.get())) {
  if (!matrix || !solver) {
    throw std::runtime_error("SUNDIALS: no dense linear solver (is another copy linked first?)");
  }
}

}  // namespace plumbline::integrate
