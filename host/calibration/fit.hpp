// SPDX-License-Identifier: Apache-2.0
// Fits parameters of a model to data: robust least squares with priors by the method of Levenberg and Marquardt. It
// knows nothing of radio channels.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace wavetracer::calibration {

// A measured number, in the unit of the model's values.
struct Datum {
  double value = 0;
  bool below = false;                 // it is only known that the number is at most this
  size_t kind = 0;                    // data of one kind have one standard deviation, which the fit finds
  std::optional<size_t> offset = {};  // number of the offset that is added to the model's value
};

// The values of the model at the data for parameters theta, in the order of the data; -inf or NaN where the model has
// none: such data are left out of the fit, or keep their last residual if they had one at its start.
using Model = std::function<std::vector<double>(std::span<const double> theta)>;

// The difference of a parameter by which derivatives are taken. Values of a smooth model are rounded to some 1e-14 of
// theirs, so a small step will do. With a step to both sides the smaller slope counts, as suits a model that jumps here
// and there.
struct Step {
  double size = 1e-6;
  bool both_sides = false;
};

struct Problem {
  std::vector<Datum> data;
  std::vector<double> priors;  // standard deviation of each parameter about 0
  std::vector<Step> steps;     // a step for each parameter; empty: the usual one
  std::vector<bool> first;     // parameters that fit_from_best() fits alone before all; empty: none
  size_t offsets = 0, kinds = 1;
  Model model;
};

struct FitResult {
  std::vector<double> theta, offsets;
  std::vector<double> deviations;   // standard deviation of each kind of data about the model
  std::vector<double> errors;       // standard errors of theta, then of offsets
  std::vector<double> correlation;  // a square for theta, then offsets, row by row
  std::vector<double> told;  // for each parameter the share of its prior variance that the data have removed, 0 to 1
  size_t iterations = 0, used = 0;  // used: data with a value of the model
  // Negative logarithm of the probability, but for a constant, with the deviations that were found and tails that let
  // outliers weigh little (tailed_cost()): fits of the same data can be compared by it.
  double objective = 0;
  bool converged = false;
};

// The model with its derivatives, by differences; results for the last few theta are kept.
class Linearized {
 public:
  explicit Linearized(const Problem& problem) : problem_(problem) {}
  const std::vector<double>& values(const std::vector<double>& theta) { return known(theta).values; }
  // Derivative of each value with respect to each parameter: [parameter][datum]. No value: 0.
  const std::vector<std::vector<double>>& slopes(const std::vector<double>& theta);
  // Does any value depend on the parameter? Known after the first slopes().
  bool depends_on(size_t parameter) const { return !idle_.at(parameter); }
  size_t evaluations() const { return evaluations_; }

 private:
  struct Known {
    std::vector<double> theta, values;
    std::vector<std::vector<double>> slopes;
  };
  Known& known(const std::vector<double>& theta);
  std::vector<double> evaluate(const std::vector<double>& theta);
  std::vector<double> difference(std::vector<double> theta, size_t parameter, double step,
                                 const std::vector<double>& here);
  std::vector<double> slope(const std::vector<double>& theta, size_t parameter, const std::vector<double>& here);

  const Problem& problem_;
  std::vector<bool> idle_;   // parameters on which no value depends; empty until the first slopes are known
  std::vector<Known> kept_;  // the latest last
  size_t evaluations_ = 0;
};

// Fits the data of which `takes` is true. Residuals r of normal data count as Huber's function of r / s, with s of each
// kind from the median of |r|; data that are only known to be below a number count by their probability.
// start: theta of the first step.
FitResult fit(const Problem& problem, Linearized& model, const std::vector<bool>& takes, std::vector<double> start);

// Fits from the first one and the best ones of these starts, three or a 24th of all, and returns the best fit: the
// model may have several minima, as the reflection of a slab has over its permittivity.
FitResult fit_from_best(const Problem& problem, Linearized& model, const std::vector<bool>& takes,
                        const std::vector<std::vector<double>>& starts);

}  // namespace wavetracer::calibration
