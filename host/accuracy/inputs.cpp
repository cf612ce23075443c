// SPDX-License-Identifier: Apache-2.0
// One-at-a-time effects use the samples of all inputs, with the others at their nominal values: N samples for each
// input. Sobol's first-order indices of so few samples would have errors of 0.1 to 0.2; these variances have a relative
// error of sqrt(2 / N).
#include "accuracy/inputs.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include "accuracy/latin_hypercube.hpp"
#include "accuracy/measure.hpp"
#include "radio/field_tables.hpp"
#include "radio/links.hpp"
#include "simulation/frame.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::accuracy {
namespace {

constexpr double undefined_share = std::numeric_limits<double>::quiet_NaN();

using Varied = std::array<bool, input_count>;

// Columns of the errors of each end, vehicle and material in a row of the hypercube.
class Dimensions {
 public:
  Dimensions(const World& world, size_t materials)
      : twins_(world.twins.transmitter_of_receiver),
        transmitters_(world.transmitters.ends.size()),
        vehicles_(3 * (transmitters_ + world.receivers.ends.size())),
        materials_(vehicles_ + 2 * world.fleet.instances.size()),
        count_(materials_ + materials) {}

  size_t count() const { return count_; }
  size_t transmitter(size_t i) const { return 3 * i; }
  // A receiver that is also a transmitter is one antenna, and shares its errors.
  size_t receiver(size_t i) const { return 3 * (twins_[i] == no_end ? transmitters_ + i : twins_[i]); }
  size_t vehicle(size_t i) const { return vehicles_ + 2 * i; }
  size_t material(size_t i) const { return materials_ + i; }

 private:
  const std::vector<uint32_t>& twins_;
  size_t transmitters_, vehicles_, materials_, count_;
};

bool is_varied(const Varied& varied, Input input) { return varied[static_cast<size_t>(input)]; }

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
  Config config = load_config(request.file, request.sets);
  if (!config.live_vehicles.empty())
    throw ConfigError(request.file +
                      ": its [[live_vehicle]] tables need a client that sends poses, so nothing can be varied; "
                      "give trajectories instead of them");
  if (config.trace.by_spheres())
    throw ConfigError(request.file +
                      ": trace.reception = \"sphere\" keeps no sequences from sample to sample; "
                      "use --set trace.reception=exact");
  config.trace.reuse = true;
  config.trace.discover_every_s = request.discover_every;  // a sample counts as a second
  config.cache.kind = "none";
  config.output.waypoints = 0;
  return config;
}

class InputMeasurement {
 public:
  InputMeasurement(const InputRequest& request, const study::Host& host)
      : request_(request),
        host_(host),
        config_(study_config(request)),
        setup_(make_setup(config_, request.device, true)),
        frames_(setup_),
        materials_(make_field_tables(setup_.plan->scene, setup_.plan->asked, setup_.plan->world.fleet.models,
                                     setup_.plan->world.fleet.instances)
                       .materials),
        dimensions_(setup_.plan->world, materials_.size()),
        samples_(normal_hypercube(request.samples, dimensions_.count(), request.seed)) {}

  InputStudy operator()() {
    out_.samples = request_.samples;
    out_.varied = varied();
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
  Varied varied() const {
    const auto fixed = [](const EndState& end) { return end.instance == no_instance; };
    const WorldState state = setup_.plan->world.state(0);
    const InputErrors& e = request_.errors;
    return {e.position_m > 0 &&
                (std::ranges::any_of(state.transmitters, fixed) || std::ranges::any_of(state.receivers, fixed)),
            e.height_m > 0, e.permittivity > 0, e.vehicles_m > 0 && !state.instances.empty()};
  }

  // Runs the nominal frame, then samples of all inputs together, then of each input alone. Returns false if it was
  // interrupted.
  bool measure_frame(uint32_t frame) {
    observed_.assign(nominal_.links.size(), {});
    frames_.forget();
    run(frame, nullptr, {}, [](Observed& of, double value) { of.nominal = value; });
    for (size_t sample = 0; sample < samples_.size(); ++sample) {
      if (host_.interrupted()) return false;
      host_.tell("samples", sample, samples_.size(), "samples");
      run(frame, &samples_[sample], out_.varied, [](Observed& of, double value) { of.together.push_back(value); });
    }
    for (size_t input = 0; input < input_count; ++input) {
      if (!out_.varied[input]) continue;
      Varied alone{};
      alone[input] = true;
      for (const std::vector<double>& sample : samples_) {
        if (host_.interrupted()) return false;
        run(frame, &sample, alone, [&](Observed& of, double value) { of.alone[input].push_back(value); });
      }
    }
    add_rows(frame);
    return true;
  }

  template <class Keep>
  void run(uint32_t frame, const std::vector<double>* sample, const Varied& varied, const Keep& keep) {
    WorldState state = nominal_;
    state.time_s = time_s_++;
    std::vector<device::wt_material> materials = materials_;
    if (sample) vary(*sample, varied, state, materials);
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

  void vary(const std::vector<double>& sample, const Varied& varied, WorldState& state,
            std::vector<device::wt_material>& materials) const {
    const InputErrors& errors = request_.errors;
    const auto vehicle_shift = [&](size_t i) {
      const size_t at = dimensions_.vehicle(i);
      return glm::dvec3(sample[at], sample[at + 1], 0) * errors.vehicles_m;
    };
    const auto move = [&](EndState& end, size_t at) {
      const bool fixed = end.instance == no_instance;
      if (fixed && is_varied(varied, Input::position))
        end.position_m += glm::dvec3(sample[at], sample[at + 1], 0) * errors.position_m;
      if (is_varied(varied, Input::height)) end.position_m.z += sample[at + 2] * errors.height_m;
      if (!fixed && is_varied(varied, Input::vehicles)) end.position_m += vehicle_shift(end.instance);
    };
    for (size_t i = 0; i < state.transmitters.size(); ++i) move(state.transmitters[i], dimensions_.transmitter(i));
    for (size_t i = 0; i < state.receivers.size(); ++i) move(state.receivers[i], dimensions_.receiver(i));
    if (is_varied(varied, Input::vehicles))
      for (size_t i = 0; i < state.instances.size(); ++i) state.instances[i].position_m += vehicle_shift(i);
    if (!is_varied(varied, Input::permittivity)) return;
    for (size_t i = 0; i < materials.size(); ++i) {
      const double factor = std::exp(errors.permittivity * sample[dimensions_.material(i)]);
      double* const permittivity = materials[i].permittivity;
      permittivity[0] = 1 + (permittivity[0] - 1) * factor;
      permittivity[1] *= factor;
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
  Setup setup_;
  FrameLoop frames_;
  const std::vector<device::wt_material> materials_;
  const Dimensions dimensions_;
  const std::vector<std::vector<double>> samples_;
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
