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

template <class A, class B>
struct PairOfTerms {
  static constexpr int terms = 2;
  A a;
  B b;
  HOST_DEVICE Terms<2> operator()(Index i) const {
    return {{static_cast<double>(a(i)), static_cast<double>(b(i))}};
  }
};

template <int count>
struct KeepTerms {
  double* kept;
  HOST_DEVICE void operator()(const Terms<count>& all) const {
    for (int k = 0; k < count; ++k) kept[k] = all.value[k];
  }
};

// Reduces a body with several terms; use(result) follows in sums.read(). Where on the device the result is.
template <class Reduction, class Body, class Use>
const double* gather_terms(GatheredSums& sums, Rows n, const Body& body, Use use) {
  constexpr int count = Body::terms;
  double* const place = sums.place(count, [use](const double* values) {
    Terms<count> all;
    for (int k = 0; k < count; ++k) all.value[k] = values[k];
    use(all);
  });
  launch_reduction<Reduction>(sums.context, "diagnostic sum", n, body, KeepTerms<count>{place});
  return place;
}

// Sum of term(i) over i in [0, n), by planes where the rows are in planes: use(sum) follows.
template <class Term, class Use>
void gather_total(GatheredSums& sums, Rows n, Term term, Use use) {
  gather_terms<AddUp>(sums, n, OneTerm<Term>{term}, [use](const Terms<1>& all) { use(all.value[0]); });
}

// The same of whole numbers; exact up to 2^53.
template <class Term, class Use>
void gather_count(GatheredSums& sums, Rows n, Term term, Use use) {
  gather_total(sums, n, term, [use](double all) { use(static_cast<std::int64_t>(all)); });
}

// These wait for their result.
template <class Term>
double total(Context& context, DiagnosticScratch& scratch, Rows n, Term term) {
  GatheredSums sums(context, scratch);
  double result = 0;
  gather_total(sums, n, term, [&](double all) { result = all; });
  sums.read();
  return result;
}

template <class Term>
std::int64_t count(Context& context, DiagnosticScratch& scratch, Rows n, Term term) {
  return static_cast<std::int64_t>(total(context, scratch, n, term));
}

template <class Term>
double largest(Context& context, DiagnosticScratch& scratch, Rows n, Term term) {
  GatheredSums sums(context, scratch);
  double result = 0;
  gather_terms<TakeLargest>(sums, n, OneTerm<Term>{term},
                            [&](const Terms<1>& all) { result = all.value[0]; });
  sums.read();
  return result;
}

}  // namespace slagflow
