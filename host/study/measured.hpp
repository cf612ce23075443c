// SPDX-License-Identifier: Apache-2.0
// Measured numbers with their noise, and comparisons that answer only as far as the noise lets them.
// Noise is a standard error. A difference counts from twice of it on, and from a hundredth of the value: repeats of one
// run do not show what another run of the program would add.
#pragma once
#include <vector>
#include "study/statistics.hpp"

namespace wavetracer::study {

struct Measured {
  double value = undefined;  // NaN: it was not measured
  double error = undefined;  // standard error of `value`, in its unit; NaN: it is not known
};

constexpr double noise_factor = 2;
constexpr double least_noise = 0.01;  // relative to the value
constexpr double unknown_noise =
    0.05;  // stands for noise_factor times an error that is not known, relative to the value
// A claim is exceeded if a measured factor or share is beyond this times the claimed one.
constexpr double exceeding = 1.1;

// Returns how far the true value may be from the measured one, in the unit of the value.
double margin(const Measured& measured);
Measured operator*(double factor, const Measured& measured);
// Returns a / b; errors count as independent. b must not be 0.
Measured quotient(const Measured& a, const Measured& b);

// The answer to a condition on measured numbers.
enum class Answer {
  absent,     // a number was not measured
  no,         // it does not hold
  undecided,  // the difference is within the noise
  yes,        // it holds
  beyond      // it holds, and exceeds the claimed number by a tenth of it at least
};

Answer opposite(Answer answer);
// Returns the answer of "all of these": no if one is no, undecided if one is undecided; absent if one is absent or
// there is none.
Answer all_of(const std::vector<Answer>& answers);

Answer above(const Measured& measured, double bound);
Answer below(const Measured& measured, double bound);
// The bounds belong to the interval.
Answer between(const Measured& measured, double low, double high);
// Answers whether a is less than b. Exact zeros are equal, so that the answer is no.
Answer less(const Measured& a, const Measured& b);
// Answers whether a factor is at least the claimed one, which is positive; beyond from `exceeding` times it on.
Answer reaches(const Measured& factor, double claimed);

// The standard error of a median over that of a mean, for a normal distribution: the root of pi / 2.
constexpr double median_noise = 1.2533141373155;

// Return standard errors of the mean of `values` and of their median; NaN for fewer than two.
double error_of_mean(std::vector<double> values);
double error_of_median(std::vector<double> values);

// samples[i][k]: what subject i took in round k; all subjects have the same number of rounds. Returns for each subject
// the relative standard error of its mean, after what all subjects have in common in a round is taken out: frames of a
// drive differ, and a slow phase of the machine affects all. NaN for fewer than two rounds.
std::vector<double> relative_errors(const std::vector<std::vector<double>>& samples);

}  // namespace wavetracer::study
