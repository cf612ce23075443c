// SPDX-License-Identifier: Apache-2.0
// The world is solved once. A fit to all points gives the result; a fit without each block of places says how well the
// result predicts places that were not measured.
#include "calibration/calibration.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include "base/stopwatch.hpp"
#include "calibration/agreements_of.hpp"
#include "calibration/chosen_parameters.hpp"
#include "calibration/fit_data.hpp"
#include "calibration/fitted_config.hpp"
#include "calibration/measured_world.hpp"
#include "calibration/prior_samples.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::calibration {
namespace {

constexpr size_t least_points_of_fold = 5;

constexpr int most_rounds = 4;
// Shares of the power that weak paths make together, which are not evaluated: in the search for the best minimum, in
// the next round, and then.
constexpr std::array shares_left_out{2e-2, 1e-3, 1e-4};
constexpr double step_of_places_m = 0.02, step_of_turns_deg = 1e-3;
constexpr double tolerated_db = 0.02;  // the error of a level that comes from paths that keep their power

struct Interrupted {};

// Levels jump where a path appears or vanishes on the way.
Step step_of(Property property) {
  if (!is_of_end(property)) return {};
  const double unit = unit_of_theta(property);
  return is_angle(property) ? Step{step_of_turns_deg / unit} : Step{step_of_places_m / unit, true};
}

double largest_difference_db(const std::vector<Computed>& a, const std::vector<Computed>& b) {
  double out = 0;
  for (size_t i = 0; i < a.size(); ++i)
    if (std::isfinite(a[i].gain_db)) out = std::max(out, std::abs(a[i].gain_db - b[i].gain_db));
  return out;
}

class Calibrating {
 public:
  Calibrating(const Request& request, const study::Host& host) : request_(request), host_(host) {}

  Calibration operator()() {
    read_files();
    host_.tell("finding paths", 0, 1, "frames");
    Stopwatch watch;
    const Config config = config_of_places(request_.config, request_.sets);
    if (!find_paths(config)) return std::move(out_);
    out_.solve_s = watch.lap();
    out_.profile_bin_ns = request_.profile_bin_ns;
    world_->want_profiles(1e-9 * request_.profile_bin_ns, most_bins(out_.files, request_.profile_bin_ns));
    out_.paths = world_->paths();
    out_.device = world_->device();
    out_.warnings = world_->warnings();
    list_points();
    state_problem();
    try {
      fit_all();
    } catch (const Interrupted&) {
      out_.stopped = true;
    } catch (const FrameStopped&) {
      out_.stopped = true;
    }
    if (out_.stopped) return std::move(out_);
    out_.fit_s = watch.lap();
    out_.agreements = agreements_of(out_, folds_ > 0);
    if (const std::string why = held_out_warning(out_.agreements.front()); folds_ > 0 && !why.empty())
      out_.notes.push_back(why);
    out_.frames_solved = world_->frames_solved();
    out_.config = fitted_config(config, inputs(out_.fit.theta), world_->materials().frequency_hz, out_.parameters);
    note_receivers();
    return std::move(out_);
  }

 private:
  // Returns false if it was interrupted.
  bool find_paths(const Config& config) {
    try {
      const std::shared_ptr<void> guard = host_.guard();
      world_.emplace(config, out_.files, request_.device, move_paths(request_.patterns), host_.watch,
                     [this](const NamedRecords& materials, const EndPlaces& ends) { choose(materials, ends); });
    } catch (const FrameStopped&) {
      out_.stopped = true;
    }
    return !out_.stopped;
  }

  // Chooses what is fitted.
  void choose(const NamedRecords& materials, const EndPlaces& ends) {
    if (request_.patterns.empty()) return;
    out_.parameters =
        chosen_parameters(materials, ends, request_.patterns, {request_.prior, request_.errors}, out_.notes);
  }

  void read_files() {
    for (const std::string& file : request_.measured) {
      out_.files.push_back(read_measured(file, {.level = request_.level, .crs = request_.crs}));
      const MeasuredFile& read = out_.files.back();
      if (read.left_out > 0)
        out_.notes.push_back(fmt::format("{}: {} rows {} are left out", file, read.left_out,
                                         read.components > 0 ? "without a level, a position, a delay or an azimuth"
                                                             : "without a level or a position"));
      if (read.components > 0)
        out_.notes.push_back(fmt::format("{}: {} components at {} places", file, read.components, read.points.size()));
      out_.notes.insert(out_.notes.end(), read.notes.begin(), read.notes.end());
      if (!read.unused.empty())
        out_.notes.push_back(fmt::format("{}: these columns are not used: {}", file, fmt::join(read.unused, ", ")));
    }
  }

  void list_points() {
    const std::vector<glm::dvec3> places = world_->places();
    const std::vector<std::string> transmitters = world_->transmitters();
    std::vector<double> x, y;
    for (size_t file = 0; file < out_.files.size(); ++file)
      for (size_t point = 0; point < out_.files[file].points.size(); ++point) {
        const size_t i = out_.points.size();
        out_.points.push_back({.file = file,
                               .point = point,
                               .tx = transmitters[i],
                               .place_m = places[i],
                               .measured_db = out_.files[file].points[point].level_db});
        x.push_back(places[i].x);
        y.push_back(places[i].y);
      }
    folds_ = std::min<size_t>(request_.folds, out_.points.size() / least_points_of_fold);
    if (folds_ < 2) folds_ = 0;
    if (folds_ != request_.folds && request_.folds > 1)
      out_.notes.push_back(fmt::format("{} points are too few for {} blocks, so {} are held out", out_.points.size(),
                                       request_.folds, folds_ == 0 ? "none" : std::to_string(folds_)));
    if (folds_ == 0) return;
    const std::vector<unsigned> blocks = spatial_blocks(x, y, static_cast<unsigned>(folds_));
    for (size_t i = 0; i < blocks.size(); ++i) out_.points[i].fold = blocks[i];
  }

  void state_problem() {
    FitData fitted = fit_data(request_, out_);
    problem_.data = std::move(fitted.data);
    problem_.kinds = kinds_of_data();
    shapes_ = std::move(fitted.shapes);
    out_.offset_names = std::move(fitted.offset_names);
    out_.notes.insert(out_.notes.end(), fitted.notes.begin(), fitted.notes.end());
    problem_.offsets = out_.offset_names.size();
    // Materials that are fitted with antennas in wrong places are led far away.
    if (out_.parameters.size() > materials_count() && materials_count() > 0)
      for (const Parameter& parameter : out_.parameters) problem_.first.push_back(is_of_end(parameter.property));
    for (const Parameter& parameter : out_.parameters) {
      problem_.priors.push_back(parameter.prior);
      problem_.steps.push_back(step_of(parameter.property));
    }
    problem_.model = [this](std::span<const double> theta) { return values(theta); };
  }

  std::vector<Computed> computed(std::span<const double> theta) {
    if (host_.interrupted()) throw Interrupted{};
    return world_->values(inputs(theta));
  }

  std::vector<double> values(std::span<const double> theta) {
    const std::vector<Computed> points = computed(theta);
    std::vector<double> out;
    for (const Computed& point : points) out.push_back(point.gain_db);
    for (const ShapeDatum& datum : shapes_) out.push_back(shape_db(points[datum.point], datum));
    return out;
  }

  double offset_of(size_t point, const std::vector<double>& offsets) const {
    const std::optional<size_t> offset = problem_.data[point].offset;
    return offset ? offsets[*offset] : 0;
  }

  // Weak paths are not evaluated while a fit goes on. If they have gained weight, it goes on with other ones.
  void fit_all() {
    const std::vector<double> start(problem_.priors.size(), 0);
    const std::vector<bool> takes(problem_.data.size(), true);
    const std::vector<Computed> before = world_->weigh(inputs(start), share_left_out(0));
    if (std::ranges::none_of(before, [](const Computed& point) { return std::isfinite(point.gain_db); }))
      throw RuntimeError(fmt::format(
          "none of the {} measured places has a path: look at their coordinates, and at [trace] of the configuration",
          before.size()));
    out_.fit.theta = start;
    std::vector<Computed> after;
    for (int round = 0; round < most_rounds; ++round) {
      tell_fit(0);
      model_.emplace(problem_);
      out_.fit = round == 0 ? fit_from_best(problem_, *model_, takes, starts())
                            : fit(problem_, *model_, takes, out_.fit.theta);
      evaluations_before_ += model_->evaluations();
      const std::vector<Computed> approximate = world_->values(inputs(out_.fit.theta));
      after = world_->weigh(inputs(out_.fit.theta), share_left_out(static_cast<size_t>(round) + 1));
      if (round > 0 && largest_difference_db(approximate, after) < tolerated_db) break;
    }
    note_fit();
    for (size_t i = 0; i < out_.points.size(); ++i) {
      out_.points[i].before = before[i];
      out_.points[i].after = after[i];
      out_.points[i].offset_db = offset_of(i, out_.fit.offsets);
    }
    out_.paths_that_matter = world_->paths_that_matter();
    if (folds_ > 0) world_->weigh(inputs(out_.fit.theta), share_left_out(1));  // 0.004 dB do not matter there
    model_.emplace(problem_);
    for (size_t fold = 0; fold < folds_; ++fold) {
      tell_fit(1 + fold);
      hold_out(fold);
    }
    out_.evaluations = evaluations_before_ + model_->evaluations();
  }

  Inputs inputs(std::span<const double> theta) const {
    return {with_parameters(world_->materials(), out_.parameters, theta),
            with_parameters(world_->ends(), out_.parameters, theta)};
  }

  bool moves() const { return std::ranges::any_of(out_.parameters, moves_paths, &Parameter::property); }

  // Paths elsewhere are others, so no weak ones are known where ends move. Bins of profiles are weak themselves.
  double share_left_out(size_t round) const {
    if (request_.profile_bin_ns > 0) round = shares_left_out.size();
    return moves() ? 0 : shares_left_out[std::min(round, shares_left_out.size() - 1)];
  }

  // The parameters of materials, which come first.
  size_t materials_count() const {
    return static_cast<size_t>(std::ranges::count(
        out_.parameters, false, [](const Parameter& parameter) { return is_of_end(parameter.property); }));
  }

  // The configuration itself, and a sample of the priors of materials: levels have many minima over these alone.
  std::vector<std::vector<double>> starts() const {
    const size_t all = problem_.priors.size(), count = materials_count();
    std::vector<std::vector<double>> out{std::vector<double>(all, 0)};
    if (count == 0) return out;
    for (std::vector<double>& row : prior_samples(world_->materials(), std::span(out_.parameters).first(count))) {
      row.resize(all, 0);
      out.push_back(std::move(row));
    }
    return out;
  }

  void tell_fit(size_t number) const { host_.tell("fitting", number, 1 + folds_, "fits"); }

  void note_fit() {
    for (size_t p = 0; p < out_.parameters.size(); ++p)
      if (!model_->depends_on(p))
        out_.notes.push_back(
            fmt::format("{} keeps its value: no measured path depends on it", out_.parameters[p].name()));
    if (!out_.fit.converged)
      out_.notes.push_back(fmt::format("the fit did not converge in {} steps", out_.fit.iterations));
  }

  // Says where the height of all receivers is, which need not have a key.
  void note_receivers() {
    const auto found = std::ranges::find(out_.parameters, std::string(all_receivers), &Parameter::owner);
    if (found == out_.parameters.end()) return;
    const double rise_m = found->value(out_.fit.theta[static_cast<size_t>(found - out_.parameters.begin())]);
    for (const MeasuredFile& file : out_.files)
      out_.notes.push_back(
          file.has_z ? fmt::format("{}: add {:.4g} m to the heights of this file, which fitted.toml cannot have",
                                   file.file, rise_m)
                     : fmt::format("{}: its places have the height of the [[receiver]] of fitted.toml", file.file));
  }

  // The fit to all other blocks starts from that to all points, which is near.
  void hold_out(size_t fold) {
    std::vector<bool> takes;
    for (const FittedPoint& point : out_.points) takes.push_back(point.fold != fold);
    for (const ShapeDatum& datum : shapes_) takes.push_back(out_.points[datum.point].fold != fold);
    const FitResult fitted = fit(problem_, *model_, takes, out_.fit.theta);
    const std::vector<Computed> predicted = computed(fitted.theta);
    for (size_t i = 0; i < out_.points.size(); ++i)
      if (out_.points[i].fold == fold) {
        out_.points[i].held_out = predicted[i];
        out_.points[i].offset_held_out_db = offset_of(i, fitted.offsets);
      }
  }

  const Request& request_;
  const study::Host& host_;
  std::optional<MeasuredWorld> world_;
  Problem problem_;
  std::vector<ShapeDatum> shapes_;  // the data after the levels
  size_t folds_ = 0, evaluations_before_ = 0;
  std::optional<Linearized> model_;
  Calibration out_;
};

}  // namespace

Calibration calibrate(const Request& request, const study::Host& host) { return Calibrating(request, host)(); }

}  // namespace wavetracer::calibration
