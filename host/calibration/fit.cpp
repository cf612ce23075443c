// SPDX-License-Identifier: Apache-2.0
// The deviations s of data are found anew before each step, as in iteratively reweighted least squares.
#include "calibration/fit.hpp"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>
#include "calibration/residual_cost.hpp"
#include "output/median.hpp"

namespace wavetracer::calibration {
namespace {

constexpr double least_deviation = 1e-6;  // data without noise
constexpr double least_gain = 1e-2;       // a smaller gain of the logarithm of the probability means nothing
constexpr size_t most_iterations = 40, kept_results = 4, least_followed = 3, starts_of_followed = 24;

// Returns 0 for an empty list.
double median_or_0(std::vector<double> values) { return values.empty() ? 0 : median(std::move(values)); }

class Fit {
 public:
  // only: the parameters that the fit changes, with the offsets; empty: all.
  Fit(const Problem& problem, Linearized& model, const std::vector<bool>& takes, std::vector<double> start,
      std::vector<bool> only = {})
      : problem_(problem), model_(model), only_(std::move(only)), size_(problem.priors.size() + problem.offsets) {
    out_.theta = std::move(start);
    const std::vector<double>& values = model_.values(out_.theta);
    for (size_t i = 0; i < problem.data.size(); ++i)
      if (takes[i] && std::isfinite(values[i])) used_.push_back(i);
    out_.used = used_.size();
    start_offsets(values);
    last_residuals_.assign(problem.data.size(), 0);
    for (const size_t i : used_) last_residuals_[i] = residual(values, i);
  }

  FitResult operator()() {
    double damping = 1e-3;
    for (; out_.iterations < most_iterations && !out_.converged; ++out_.iterations) {
      find_deviations();
      Eigen::MatrixXd curvature;
      Eigen::VectorXd slope;
      const double now = linearize(curvature, slope);
      out_.converged = !take_step(now, curvature, slope, damping);
    }
    find_objective();
    find_errors();
    return std::move(out_);
  }

  // The objective at the start.
  double at_start() {
    find_objective();
    return out_.objective;
  }

 private:
  bool changes(size_t parameter) const { return only_.empty() || only_[parameter]; }

  double residual(const std::vector<double>& values, size_t i) const {
    const Datum& datum = problem_.data[i];
    return datum.value - values[i] - (datum.offset ? out_.offsets[*datum.offset] : 0);
  }

  // Offsets begin as medians, which no outlier moves.
  void start_offsets(const std::vector<double>& values) {
    out_.offsets.assign(problem_.offsets, 0);
    std::vector<std::vector<double>> of(problem_.offsets);
    for (const size_t i : used_)
      if (const Datum& datum = problem_.data[i]; datum.offset && !datum.below)
        of[*datum.offset].push_back(datum.value - values[i]);
    for (size_t i = 0; i < of.size(); ++i) out_.offsets[i] = median_or_0(std::move(of[i]));
  }

  // 1.4826 times the median of |r| is the deviation of normal residuals; few outliers hardly change it.
  void find_deviations() {
    const std::vector<double>& values = model_.values(out_.theta);
    std::vector<std::vector<double>> of(problem_.kinds);
    for (const size_t i : used_)
      if (!problem_.data[i].below && std::isfinite(values[i]))
        of[problem_.data[i].kind].push_back(std::abs(residual(values, i)));
    out_.deviations.clear();
    for (std::vector<double>& sizes : of)
      out_.deviations.push_back(std::max(least_deviation, 1.4826 * median_or_0(std::move(sizes))));
  }

  void find_objective() {
    find_deviations();
    const std::vector<double>& values = model_.values(out_.theta);
    out_.objective = prior_cost();
    for (const size_t i : used_) {
      const Datum& datum = problem_.data[i];
      const double s = out_.deviations[datum.kind], u = deviations_of(values, i);
      out_.objective += datum.below ? std::min(below_cost(u, s).cost, tailed_cost(u)) : tailed_cost(u) + std::log(s);
    }
  }

  // A datum that has lost its value keeps the residual of the last step at which it had one.
  double deviations_of(const std::vector<double>& values, size_t i) const {
    return (std::isfinite(values[i]) ? residual(values, i) : last_residuals_[i]) /
           out_.deviations[problem_.data[i].kind];
  }

  Cost cost_of(const std::vector<double>& values, size_t i) const {
    const Datum& datum = problem_.data[i];
    const bool lost = !std::isfinite(values[i]);
    const double s = out_.deviations[datum.kind], u = deviations_of(values, i);
    const Cost cost = datum.below ? below_cost(u, s) : normal_cost(u, s);
    return lost ? Cost{cost.cost, 0, 0} : cost;
  }

  double prior_cost() const {
    double sum = 0;
    for (size_t p = 0; p < out_.theta.size(); ++p) sum += 0.5 * std::pow(out_.theta[p] / problem_.priors[p], 2);
    return sum;
  }

  double cost() {
    double sum = prior_cost();
    const std::vector<double>& values = model_.values(out_.theta);
    for (const size_t i : used_) sum += cost_of(values, i).cost;
    return sum;
  }

  // Returns the cost, and its slope and approximate curvature (Gauss and Newton) in theta and offsets.
  double linearize(Eigen::MatrixXd& curvature, Eigen::VectorXd& slope) {
    const std::vector<std::vector<double>>& slopes = model_.slopes(out_.theta);
    const std::vector<double>& values = model_.values(out_.theta);
    const auto size = static_cast<Eigen::Index>(size_);
    curvature = Eigen::MatrixXd::Zero(size, size);
    slope = Eigen::VectorXd::Zero(size);
    double sum = prior_cost();
    Eigen::VectorXd row(size);
    for (const size_t i : used_) {
      if (std::isfinite(values[i])) last_residuals_[i] = residual(values, i);
      row.setZero();
      for (size_t p = 0; p < slopes.size(); ++p)
        if (changes(p)) row[static_cast<Eigen::Index>(p)] = slopes[p][i];
      if (const auto offset = problem_.data[i].offset) row[static_cast<Eigen::Index>(slopes.size() + *offset)] = 1;
      const Cost cost = cost_of(values, i);
      sum += cost.cost;
      slope += cost.slope * row;
      curvature.selfadjointView<Eigen::Lower>().rankUpdate(row, cost.curvature);
    }
    for (size_t p = 0; p < out_.theta.size(); ++p) {
      const auto at = static_cast<Eigen::Index>(p);
      const double weight = 1 / (problem_.priors[p] * problem_.priors[p]);
      if (changes(p)) slope[at] += weight * out_.theta[p];
      curvature(at, at) += weight;
    }
    for (auto at = static_cast<Eigen::Index>(out_.theta.size()); at < size; ++at)
      if (curvature(at, at) == 0) curvature(at, at) = 1;  // no datum has this offset, which stays 0
    curvature.triangularView<Eigen::StrictlyUpper>() = curvature.transpose();
    return sum;
  }

  // Goes to a place of lower cost, with more and more damping. Returns false if there is none, or if it is hardly
  // lower.
  bool take_step(double now, const Eigen::MatrixXd& curvature, const Eigen::VectorXd& slope, double& damping) {
    const std::vector<double> theta = out_.theta, offsets = out_.offsets;
    for (int tries = 0; tries < 12; ++tries) {
      Eigen::MatrixXd damped = curvature;
      damped.diagonal() *= 1 + damping;
      Eigen::VectorXd step = damped.ldlt().solve(-slope);
      double longest = 0;
      for (size_t p = 0; p < theta.size(); ++p)
        longest = std::max(longest, std::abs(step[static_cast<Eigen::Index>(p)]));
      if (longest > 1) step /= longest;  // no property changes by more than a factor of e at once
      for (size_t p = 0; p < theta.size(); ++p) out_.theta[p] = theta[p] + step[static_cast<Eigen::Index>(p)];
      for (size_t k = 0; k < offsets.size(); ++k)
        out_.offsets[k] = offsets[k] + step[static_cast<Eigen::Index>(theta.size() + k)];
      const double then = cost();
      if (then <= now) {
        damping = std::max(1e-9, damping / 10);
        return now - then > least_gain;
      }
      damping *= 10;
    }
    out_.theta = theta;
    out_.offsets = offsets;
    return false;
  }

  void find_errors() {
    Eigen::MatrixXd curvature;
    Eigen::VectorXd slope;
    linearize(curvature, slope);
    const auto size = static_cast<Eigen::Index>(size_);
    const Eigen::MatrixXd covariance = curvature.ldlt().solve(Eigen::MatrixXd::Identity(size, size));
    out_.errors.resize(size_);
    out_.correlation.resize(size_ * size_);
    for (size_t i = 0; i < size_; ++i) {
      const auto a = static_cast<Eigen::Index>(i);
      out_.errors[i] = std::sqrt(std::max(0.0, covariance(a, a)));
      for (size_t j = 0; j < size_; ++j) {
        const auto b = static_cast<Eigen::Index>(j);
        out_.correlation[i * size_ + j] = covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
      }
    }
    for (size_t p = 0; p < out_.theta.size(); ++p)
      out_.told.push_back(std::clamp(1 - std::pow(out_.errors[p] / problem_.priors[p], 2), 0.0, 1.0));
  }

  const Problem& problem_;
  Linearized& model_;
  const std::vector<bool> only_;
  const size_t size_;
  std::vector<size_t> used_;  // data that are fitted and had a value at the start
  std::vector<double> last_residuals_;
  FitResult out_;
};

}  // namespace

std::vector<double> Linearized::evaluate(const std::vector<double>& theta) {
  ++evaluations_;
  return problem_.model(theta);
}

Linearized::Known& Linearized::known(const std::vector<double>& theta) {
  const auto found = std::ranges::find(kept_, theta, &Known::theta);
  if (found != kept_.end()) return *found;
  // The first one, at the start, serves every fit.
  if (kept_.size() > kept_results) kept_.erase(kept_.begin() + 1);
  kept_.push_back({theta, evaluate(theta), {}});
  return kept_.back();
}

std::vector<double> Linearized::difference(std::vector<double> theta, size_t parameter, double step,
                                           const std::vector<double>& here) {
  theta[parameter] += step;
  std::vector<double> out = evaluate(theta);
  for (size_t i = 0; i < out.size(); ++i) {
    out[i] = (out[i] - here[i]) / step;
    if (!std::isfinite(out[i])) out[i] = 0;
  }
  return out;
}

std::vector<double> Linearized::slope(const std::vector<double>& theta, size_t parameter,
                                      const std::vector<double>& here) {
  const Step step = problem_.steps.empty() ? Step() : problem_.steps[parameter];
  std::vector<double> out = difference(theta, parameter, step.size, here);
  if (!step.both_sides) return out;
  const std::vector<double> back = difference(theta, parameter, -step.size, here);
  for (size_t i = 0; i < out.size(); ++i)
    if (std::abs(back[i]) < std::abs(out[i])) out[i] = back[i];
  return out;
}

const std::vector<std::vector<double>>& Linearized::slopes(const std::vector<double>& theta) {
  Known& here = known(theta);
  if (!here.slopes.empty() || theta.empty()) return here.slopes;
  const bool first = idle_.empty();
  for (size_t p = 0; p < theta.size(); ++p) {
    const bool idle = !first && idle_[p];
    here.slopes.push_back(idle ? std::vector<double>(here.values.size(), 0) : slope(theta, p, here.values));
    if (first) idle_.push_back(std::ranges::all_of(here.slopes[p], [](double s) { return s == 0; }));
  }
  return here.slopes;
}

FitResult fit(const Problem& problem, Linearized& model, const std::vector<bool>& takes, std::vector<double> start) {
  return Fit(problem, model, takes, std::move(start))();
}

FitResult fit_from_best(const Problem& problem, Linearized& model, const std::vector<bool>& takes,
                        const std::vector<std::vector<double>>& starts) {
  std::vector<std::pair<double, size_t>> best;
  for (size_t i = 0; i < starts.size(); ++i) best.emplace_back(Fit(problem, model, takes, starts[i]).at_start(), i);
  std::ranges::sort(best);
  std::vector<size_t> followed{0};
  const size_t count = std::max(least_followed, starts.size() / starts_of_followed);
  for (size_t i = 0; i < best.size() && i < count; ++i)
    if (best[i].second != 0) followed.push_back(best[i].second);
  FitResult out;
  for (const size_t start : followed) {
    const std::vector<double> from =
        problem.first.empty() ? starts[start] : Fit(problem, model, takes, starts[start], problem.first)().theta;
    FitResult found = fit(problem, model, takes, from);
    if (start == 0 || found.objective < out.objective) out = std::move(found);
  }
  return out;
}

}  // namespace wavetracer::calibration
