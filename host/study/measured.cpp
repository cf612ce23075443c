// SPDX-License-Identifier: Apache-2.0
// Compares numbers with margins.
// A comparison with a number that is NaN is absent.
#include "study/measured.hpp"
#include <algorithm>
#include <cmath>

namespace wavetracer::study {
namespace {

Answer answer_of(double distance, double noise) {
  if (std::isnan(distance)) return Answer::absent;
  if (std::abs(distance) <= noise && noise > 0) return Answer::undecided;
  return distance > 0 ? Answer::yes : Answer::no;
}

}  // namespace

double margin(const Measured& measured) {
  const double size = std::abs(measured.value);
  if (std::isnan(measured.error)) return unknown_noise * size;
  return std::max(noise_factor * measured.error, least_noise * size);
}

Measured operator*(double factor, const Measured& measured) {
  return {factor * measured.value, std::abs(factor) * measured.error};
}

Measured quotient(const Measured& a, const Measured& b) {
  const double value = a.value / b.value;
  return {value, std::abs(value) * std::hypot(a.value == 0 ? 0 : a.error / a.value, b.error / b.value)};
}

Answer opposite(Answer answer) {
  if (answer == Answer::no) return Answer::yes;
  return answer == Answer::yes || answer == Answer::beyond ? Answer::no : answer;
}

Answer all_of(const std::vector<Answer>& answers) {
  return answers.empty() ? Answer::absent : std::ranges::min(answers);
}

Answer above(const Measured& measured, double bound) { return answer_of(measured.value - bound, margin(measured)); }
Answer below(const Measured& measured, double bound) { return answer_of(bound - measured.value, margin(measured)); }

Answer between(const Measured& measured, double low, double high) {
  const double inside = std::min(measured.value - low, high - measured.value);
  // Exact numbers may be on a bound.
  return margin(measured) == 0 && inside == 0 ? Answer::yes : answer_of(inside, margin(measured));
}

Answer less(const Measured& a, const Measured& b) {
  const double size = std::max(std::abs(a.value), std::abs(b.value)),
               unknown = std::hypot(std::isnan(a.error) ? unknown_noise * a.value : noise_factor * a.error,
                                    std::isnan(b.error) ? unknown_noise * b.value : noise_factor * b.error);
  return answer_of(b.value - a.value, std::max(unknown, least_noise * size));
}

Answer reaches(const Measured& factor, double claimed) {
  const Answer answer = above(factor, claimed);
  if (answer != Answer::yes) return answer;
  return above(factor, exceeding * claimed) == Answer::yes ? Answer::beyond : Answer::yes;
}

double error_of_mean(std::vector<double> values) {
  RunningMean mean;
  for (const double value : values) mean.add(value);
  return mean.standard_error();
}

double error_of_median(std::vector<double> values) { return median_noise * error_of_mean(std::move(values)); }

std::vector<double> relative_errors(const std::vector<std::vector<double>>& samples) {
  std::vector<RunningMean> shares(samples.size());
  const size_t rounds = samples.empty() ? 0 : samples.front().size();
  for (size_t k = 0; k < rounds; ++k) {
    double sum = 0;
    for (const std::vector<double>& of_subject : samples) sum += of_subject[k];
    for (size_t i = 0; i < samples.size(); ++i) shares[i].add(samples[i][k] / sum);
  }
  std::vector<double> out;
  for (const RunningMean& share : shares) out.push_back(share.standard_error() / share.mean());
  return out;
}

}  // namespace wavetracer::study
