#include "solvers/residual.hpp"
#include "solvers/solver.hpp"

namespace slagflow {

namespace {

HOST_DEVICE inline Vec3 preconditioned(Quad r, Quad diagonal) {
  return {r.x / diagonal.x, r.y / diagonal.y, r.z / diagonal.z};
}

// r.z of the start.
struct StartProduct {
  Span<const Quad> diagonal, r;
  Span<double> product;
  HOST_DEVICE void operator()(Index i) const {
    product[i] = dot(to_double(xyz(r[i])), to_double(preconditioned(r[i], diagonal[i])));
  }
};

// p = z + beta p
struct NewDirection {
  Span<const Quad> diagonal, r;
  Span<Quad> p;
  Real beta;  // 0: p is not read
  HOST_DEVICE void operator()(Index i) const {
    const Vec3 z = preconditioned(r[i], diagonal[i]);
    p[i] = quad(beta == 0 ? z : z + beta * xyz(p[i]), 0);
  }
};

// A p and p.A p
struct Multiply {
  LinearSystem system;
  Span<const Quad> p;
  Span<Quad> product;
  Span<double> scalar;
  HOST_DEVICE void operator()(Index i) const {
    const Vec3 value = system.apply(i, p);
    product[i] = quad(value, 0);
    scalar[i] = dot(to_double(xyz(p[i])), to_double(value));
  }
};

// u += alpha p, r -= alpha A p; r.r and r.z of the new residual
struct Advance {
  Span<const Quad> diagonal, p, product;
  Span<Quad> u, r;
  Span<double> squared, weighted;
  Real alpha;
  HOST_DEVICE void operator()(Index i) const {
    u[i] = quad(xyz(u[i]) + alpha * xyz(p[i]), 0);
    const Vec3 value = xyz(r[i]) - alpha * xyz(product[i]);
    r[i] = quad(value, 0);
    squared[i] = dot(to_double(value), to_double(value));
    weighted[i] = dot(to_double(value), to_double(preconditioned(r[i], diagonal[i])));
  }
};

// Iterates from the residual at hand until the recursive residual is small enough.
void iterate(Context& context, const LinearSystem& system, const SolveLimits& limits, Buffer<Quad>& u,
             SolverWorkspace& work, SolveResult& result) {
  const Index n = system.size;
  const auto r = work.residual.span(), p = work.direction.span();
  launch(context, "r.z", n, StartProduct{system.diagonal, r, work.other.span()});
  double rz = sum(context, work.other.span());
  Real beta = 0;
  while (result.iterations < limits.max_iterations) {
    launch(context, "direction", n, NewDirection{system.diagonal, r, p, beta});
    launch(context, "multiply", n, Multiply{system, p, work.product.span(), work.other.span()});
    const double curvature = sum(context, work.other.span());
    if (!(curvature > 0)) return;  // breakdown: not a number, or nothing left to gain
    const auto alpha = static_cast<Real>(rz / curvature);
    launch(context, "advance", n,
           Advance{system.diagonal, p, work.product.span(), u.span(), r, work.squared.span(),
                   work.other.span(), alpha});
    const double rz_next = sum(context, work.other.span());
    result.residual = std::sqrt(sum(context, work.squared.span()));
    ++result.iterations;
    if (result.residual <= limits.residual) return;
    beta = static_cast<Real>(rz_next / rz);
    rz = rz_next;
  }
}

}  // namespace

SolveResult conjugate_gradient(Context& context, const LinearSystem& system, const SolveLimits& limits,
                               Buffer<Quad>& u, SolverWorkspace& work) {
  constexpr int restarts = 3;
  constexpr int drift_matters =
      10;  // iterations from which the recursive residual may differ from the true one
  const Index n = system.size;
  work.direction.resize(n), work.product.resize(n), work.other.resize(n);
  SolveResult result;
  work.squared.resize(n);
  result.residual = start_residual(context, system, limits, u.span(), work.residual, work.squared);
  for (int start = 0; start < restarts && result.residual > limits.residual; ++start) {
    const int before = result.iterations;
    iterate(context, system, limits, u, work, result);
    if (result.iterations - before < drift_matters && result.residual <= limits.residual) break;
    result.residual = residual_norm(context, system, u.span(), work.residual, work.squared);
    if (result.iterations >= limits.max_iterations) break;
  }
  result.converged = result.residual <= 2 * limits.residual;
  return result;
}

}  // namespace slagflow
