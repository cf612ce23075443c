// SPDX-License-Identifier: Apache-2.0
// One-at-a-time effects use the samples of all inputs, with the others at their nominal values: N samples for each
// input. Sobol's first-order indices of so few samples would have errors of 0.1 to 0.2; these variances have a relative
// error of sqrt(2 / N).
#include "accuracy/inputs.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include "accuracy/input_variation.hpp"
#include "accuracy/measure.hpp"
#include "radio/links.hpp"
#include "simulation/frame.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::accuracy {
namespace {

constexpr double undefined_share = std::numeric_limits<double>::quiet_NaN();

double percentile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return undefined_share;
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<size_t>(at);
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double variance(const std::vector<double>& values) {
  if (values.size() < 2) return undefined_share;
  double mean = 0, sum = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum / static_cast<double>(values.size() - 1);
}

// One figure of one link: nominal, over all samples, and over those of each input alone.
struct Observed {
  double nominal = undefined_share;
  std::vector<double> together;
  std::array<std::vector<double>, input_count> alone;

  InputInterval interval() const {
    std::vector<double> sorted = together;
    std::sort(sorted.begin(), sorted.end());
    return {nominal, percentile(sorted, 0.05), percentile(sorted, 0.5), percentile(sorted, 0.95)};
  }
  void shares(const Varied& varied, std::array<double, input_count>& share, double& explained) const {
    double sum = 0;
    for (size_t i = 0; i < input_count; ++i) {
      share[i] = varied[i] ? variance(alone[i]) : 0;
      sum += share[i];
    }
    for (double& each : share) each = sum > 0 ? each / sum : undefined_share;
    explained = sum / variance(together);
    if (!std::isfinite(explained)) explained = undefined_share;
  }
};

struct LinkObserved {
  Observed gain_db, delay_spread_ns;
};

Config study_config(const InputRequest& request) {
  Config config = varied_config(request.file, request.sets);
  if (config.trace.by_spheres())
    throw ConfigError(request.file +
                      ": trace.reception = \"sphere\" keeps no sequences from sample to sample; "
                      "use --set trace.reception=exact");
  config.trace.reuse = true;
  config.trace.discover_every_s = request.discover_every;  // a sample counts as a second
  return config;
}

class InputMeasurement {
 public:
  InputMeasurement(const InputRequest& request, const study::Host& host)
      : request_(request),
        host_(host),
        config_(study_config(request)),
        starting_(host.guard()),
        setup_(make_setup(config_, request.device, true)),
        frames_(setup_),
        variation_(*setup_.plan, request.errors, request.samples, request.seed,
                   std::vector<bool>(setup_.plan->world.receivers.ends.size(), false)) {
    starting_.reset();
    setup_.frame_watch->set(host.watch);
  }

  InputStudy operator()() {
    out_.samples = request_.samples;
    out_.varied = variation_.varied();
    uint64_t links = 0;
    for (const uint32_t frame : spread_frames(setup_.plan->world.clock.frame_count(), request_.frames)) {
      nominal_ = setup_.plan->world.state(frame);
      links += nominal_.links.size();
      if (!measure_frame(frame)) {
        out_.stopped = true;
        break;
      }
    }
    if (links == 0)
      throw ConfigError(
          fmt::format("{}: none of the frames has a link, so there is nothing to vary; look at [links], "
                      "and at where and when transmitters and receivers are there",
                      request_.file));
    if (out_.frames_run > 0) out_.sample_s = all_s_ / static_cast<double>(out_.frames_run);
    return std::move(out_);
  }

 private:
  // Returns false if it was interrupted.
  bool measure_frame(uint32_t frame) {
    try {
      return measure_samples(frame);
    } catch (const FrameStopped&) {
      return false;
    }
  }

  // Runs the nominal frame, then samples of all inputs together, then of each input alone. Returns false if it was
  // interrupted.
  bool measure_samples(uint32_t frame) {
    observed_.assign(nominal_.links.size(), {});
    frames_.forget();
    const auto varied = static_cast<uint64_t>(std::ranges::count(out_.varied, true));
    const uint64_t all = request_.samples * (1 + varied);
    uint64_t done = 0;
    run(frame, std::nullopt, {}, [](Observed& of, double value) { of.nominal = value; });
    for (size_t sample = 0; sample < request_.samples; ++sample) {
      if (host_.interrupted()) return false;
      host_.tell("samples", done++, all, "samples");
      run(frame, sample, out_.varied, [](Observed& of, double value) { of.together.push_back(value); });
    }
    for (size_t input = 0; input < input_count; ++input) {
      if (!out_.varied[input]) continue;
      Varied alone{};
      alone[input] = true;
      for (size_t sample = 0; sample < request_.samples; ++sample) {
        if (host_.interrupted()) return false;
        host_.tell("samples", done++, all, "samples");
        run(frame, sample, alone, [&](Observed& of, double value) { of.alone[input].push_back(value); });
      }
    }
    add_rows(frame);
    return true;
  }

  template <class Keep>
  void run(uint32_t frame, std::optional<size_t> sample, const Varied& varied, const Keep& keep) {
    WorldState state = nominal_;
    state.time_s = time_s_++;
    std::vector<device::wt_material> materials = variation_.materials();
    if (sample) variation_.apply(*sample, varied, state, materials);
    setup_.finish.set_materials(materials);
    const FrameResult result = frames_.run(FrameTask::of_drive(
        {.frame = frame, .pose = [&] { return state; }, .names = FrameNames::of(setup_.plan->asked), .timed = false}));
    const double seconds = result.seconds.at("frame");
    if (sample) {
      ++out_.frames_run;
      out_.frames_with_rays += result.counts.rays > 0;
      all_s_ += seconds;
    } else if (out_.rows.empty()) {
      out_.nominal_s = seconds;
    }
    out_.late.add(result.late);
    const std::vector<LinkFigures> figures =
        link_figures(result.paths, frame, state.links, setup_.plan->asked.radio.frequency_hz);
    for (size_t i = 0; i < figures.size(); ++i) {
      if (figures[i].paths == 0 || !std::isfinite(figures[i].path_gain_db)) continue;
      keep(observed_[i].gain_db, figures[i].path_gain_db);
      keep(observed_[i].delay_spread_ns, 1e9 * figures[i].rms_delay_spread_s);
    }
  }

  void add_rows(uint32_t frame) {
    for (size_t i = 0; i < observed_.size(); ++i) {
      const Link link = nominal_.links[i];
      const LinkObserved& seen = observed_[i];
      InputRow row{.frame = frame,
                   .tx = setup_.plan->asked.transmitters[link.tx].name,
                   .rx = setup_.plan->asked.receivers[link.rx].name,
                   .samples = static_cast<uint32_t>(seen.gain_db.together.size()),
                   .gain_db = seen.gain_db.interval(),
                   .delay_spread_ns = seen.delay_spread_ns.interval()};
      seen.gain_db.shares(out_.varied, row.gain_share, row.gain_explained);
      seen.delay_spread_ns.shares(out_.varied, row.delay_spread_share, row.delay_spread_explained);
      out_.rows.push_back(std::move(row));
    }
  }

  const InputRequest& request_;
  const study::Host& host_;
  const Config config_;
  std::shared_ptr<void> starting_;  // while the constructor compiles kernels
  Setup setup_;
  FrameLoop frames_;
  const InputVariation variation_;
  WorldState nominal_;
  std::vector<LinkObserved> observed_;  // links of the current frame
  double time_s_ = 0, all_s_ = 0;
  InputStudy out_;
};

}  // namespace

InputStudy study_inputs(const InputRequest& request, const study::Host& host) {
  return InputMeasurement(request, host)();
}

}  // namespace wavetracer::accuracy
