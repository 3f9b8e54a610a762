// Student's distribution, for confidence intervals.
#pragma once

namespace slagflow {

// t with which +- t standard deviations hold 95 %, at a number of degrees of freedom >= 1.
double student_95(int degrees);

}  // namespace slagflow
