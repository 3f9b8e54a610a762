// Sums and maxima over particles of what a body computes for each. A header for .cu files.
#pragma once

#include "backend/reduce.hpp"
#include "fluid/diagnostic_scratch.hpp"

namespace slagflow {

template <class Term>
struct OneTerm {
  static constexpr int terms = 1;
  Term term;
  HOST_DEVICE Terms<1> operator()(Index i) const { return {{static_cast<double>(term(i))}}; }
};

template <int count>
struct KeepTerms {
  double* kept;
  HOST_DEVICE void operator()(const Terms<count>& all) const {
    for (int k = 0; k < count; ++k) kept[k] = all.value[k];
  }
};

// Reduces a body with several terms and waits for them.
template <class Reduction, class Body>
Terms<Body::terms> reduce_terms(Context& context, DiagnosticScratch& scratch, Rows n, const Body& body) {
  static_assert(Body::terms <= DiagnosticScratch::most_terms);
  launch_reduction<Reduction>(context, "diagnostic sum", n, body,
                              KeepTerms<Body::terms>{scratch.result.span().data});
  Terms<Body::terms> all;
  context.copy_to_host(&all, scratch.result.span().data, sizeof all);
  return all;
}

// Sum of term(i) over i in [0, n), by planes where the rows are in planes.
template <class Term>
double total(Context& context, DiagnosticScratch& scratch, Rows n, Term term) {
  return reduce_terms<AddUp>(context, scratch, n, OneTerm<Term>{term}).value[0];
}

// The same of whole numbers; exact up to 2^53.
template <class Term>
std::int64_t count(Context& context, DiagnosticScratch& scratch, Rows n, Term term) {
  return static_cast<std::int64_t>(total(context, scratch, n, term));
}

template <class Term>
double largest(Context& context, DiagnosticScratch& scratch, Rows n, Term term) {
  return reduce_terms<TakeLargest>(context, scratch, n, OneTerm<Term>{term}).value[0];
}

}  // namespace slagflow
