// SPDX-License-Identifier: Apache-2.0
// The cost of a residual, with its slope and curvature in the model's value, so that Huber's function and the
// probability of being below a number (Tobin, Econometrica 26, 1958) are treated alike.
#pragma once

namespace wavetracer::calibration {

struct Cost {
  double cost = 0, slope = 0, curvature = 0;  // the last two with respect to the model's value
};

// u: (number - model's value) / s, where s is the standard deviation of the number. Huber's function of u.
Cost normal_cost(double u, double s);

// The negative logarithm of the density of Student's t with 4 degrees of freedom, but for a constant. Fits with
// different s are compared by it: its tails let a few outliers of a fit that is exact elsewhere weigh little.
double tailed_cost(double u);

// The negative logarithm of the probability that the value is below the number.
Cost below_cost(double u, double s);

}  // namespace wavetracer::calibration
