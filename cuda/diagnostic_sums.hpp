// Sums and maxima over particles of what a body computes for each. A header for .cu files.
#pragma once

#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "diagnostics.hpp"

namespace slagflow {

template <class Term, class T>
struct StoreTerm {
  Term term;
  Span<T> result;
  HOST_DEVICE void operator()(Index i) const { result[i] = static_cast<T>(term(i)); }
};

// Sum of term(i), a double, over i in [0, n).
template <class Term>
double total(Context& context, DiagnosticScratch& scratch, Index n, Term term) {
  scratch.sums.resize(n);
  launch(context, "diagnostic sum", n, StoreTerm<Term, double>{term, scratch.sums.span()});
  return sum(context, scratch.sums.span());
}

// The same of whole numbers; exact up to 2^53.
template <class Term>
std::int64_t count(Context& context, DiagnosticScratch& scratch, Index n, Term term) {
  return static_cast<std::int64_t>(total(context, scratch, n, term));
}

template <class Term>
double largest(Context& context, DiagnosticScratch& scratch, Index n, Term term) {
  constexpr double lowest = -1e30;
  scratch.maxima.resize(n);
  launch(context, "diagnostic maximum", n, StoreTerm<Term, Real>{term, scratch.maxima.span()});
  return maximum(context, scratch.maxima.span(), lowest);
}

}  // namespace slagflow
