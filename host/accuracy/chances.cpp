// SPDX-License-Identifier: Apache-2.0
// The device sums the paths of links, and only sums of cells stay from sample to sample. Cells are places and have no
// errors. The same samples serve every frame.
#include "accuracy/chances.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include "accuracy/input_variation.hpp"
#include "accuracy/measure.hpp"
#include "coverage/chance_map.hpp"
#include "coverage/grid_cells.hpp"
#include "output/totals.hpp"
#include "results/run_choice.hpp"
#include "simulation/batched_frames.hpp"
#include "simulation/receiver_grid.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::accuracy {
namespace {

Config chance_config(const ChanceRequest& request) {
  Config config = varied_config(request.inputs.file, request.inputs.sets);
  if (config.trace.by_spheres())
    throw ConfigError(request.inputs.file +
                      ": the paths of trace.reception = \"sphere\" cannot be summed on the device, which maps of "
                      "samples need; use --set trace.reception=exact");
  config.trace.reuse = false;
  config.trace.discover_every_s = 0;
  if (config.radio.frequencies_hz.size() > 1) config.radio.frequencies_hz.resize(1);
  config.response.bandwidth_hz.reset();
  for (ArrayConfig& array : config.arrays) array.codebook = "none";
  return config;
}

// Tells for each receiver whether it is a cell of a grid.
std::vector<bool> cells_of_grids(const Config& config) {
  std::vector<bool> out;
  for (const RadioEnd& end : config.receivers)
    out.push_back(std::ranges::any_of(config.receiver_grids, [&](const ReceiverGridConfig& grid) {
      return grid_cell(grid.name, end.name).has_value();
    }));
  return out;
}

std::string errors_text(const ChanceStudy& study, const InputRequest& request) {
  const InputErrors& e = request.errors;
  std::vector<std::string> parts;
  const std::array<std::string, input_count> values = {
      fmt::format("{} m", e.position_m), fmt::format("{} m", e.height_m), fmt::format("{}", e.permittivity),
      fmt::format("{} m", e.vehicles_m)};
  for (size_t input = 0; input < input_count; ++input)
    if (study.varied[input]) parts.push_back(fmt::format("{} {}", input_names[input], values[input]));
  return fmt::format("{} samples of the inputs with seed {}; standard deviations: {}", request.samples, request.seed,
                     parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", ")));
}

class ChanceMeasurement {
 public:
  ChanceMeasurement(const ChanceRequest& request, const study::Host& host)
      : request_(request),
        host_(host),
        config_(chance_config(request)),
        thresholds_(coverage::read_thresholds(request.thresholds, "--threshold")),
        grid_(checked_grid()),
        starting_(host.guard()),
        setup_(make_setup(config_, request.inputs.device, false, [this](const RunPlan& plan) { tx_of(plan); })),
        tx_(tx_of(*setup_.plan)),
        frames_(setup_),
        variation_(*setup_.plan, request.inputs.errors, request.inputs.samples, request.inputs.seed,
                   cells_of_grids(setup_.plan->asked)) {
    starting_.reset();
    setup_.frame_watch->set(host.watch);
    frames_.sum_links(true);
  }

  ChanceStudy operator()() {
    const World& world = setup_.plan->world;
    out_.drive = world.clock.frame_count() > 1;
    out_.varied = variation_.varied();
    out_.scene_file = config_.scene.file;
    for (const uint32_t frame : spread_frames(world.clock.frame_count(), request_.inputs.frames)) {
      nominal_ = world.state(frame);
      if (std::optional<coverage::Map> map = measure_frame(frame)) {
        out_.maps.push_back(std::move(*map));
        continue;
      }
      out_.stopped = true;
      break;
    }
    if (samples_run_ > 0) out_.sample_s = all_s_ / static_cast<double>(samples_run_);
    return std::move(out_);
  }

 private:
  // Refuses thresholds of values that the configuration does not give, before the scene is loaded.
  const ReceiverGridConfig& checked_grid() const {
    const ReceiverGridConfig& grid = mapped_grid(config_, request_);
    for (const coverage::Threshold& threshold : thresholds_)
      coverage::check_layer(*threshold.tested, config_.radio, {}, "--threshold");
    return grid;
  }

  std::optional<uint32_t> tx_of(const RunPlan& plan) const {
    return find_end(plan.asked.transmitters, request_.tx, "--tx");
  }

  coverage::ChanceMap empty_map(uint32_t frame) const {
    const Config& asked = setup_.plan->asked;
    coverage::Map map{.grid = grid_.name, .tx = tx_, .frame = frame, .time_s = nominal_.time_s};
    for (const RadioEnd& end : asked.transmitters) map.transmitters.push_back(end.name);
    std::vector<glm::dvec3> places;
    for (const EndState& end : nominal_.receivers) places.push_back(setup_.plan->scene.origin_m + end.position_m);
    std::vector<uint32_t> cell_of = coverage::place_cells({asked.receivers, places, request_.inputs.file}, grid_, map);
    map.thresholds = thresholds_;
    map.notes = {errors_text(out_, request_.inputs)};
    return {std::move(map), std::move(cell_of), asked.radio};
  }

  // Returns nothing if it was interrupted.
  std::optional<coverage::Map> measure_frame(uint32_t frame) {
    try {
      return measure_samples(frame);
    } catch (const FrameStopped&) {
      return std::nullopt;
    }
  }

  // Returns nothing if it was interrupted between two samples.
  std::optional<coverage::Map> measure_samples(uint32_t frame) {
    coverage::ChanceMap map = empty_map(frame);
    const FrameResult nominal = run(frame, std::nullopt);
    map.set_nominal(nominal.summed->links);
    add_warnings(out_.warnings, nominal.warnings);
    if (out_.maps.empty()) out_.nominal_s = nominal.seconds.at("frame");
    for (size_t sample = 0; sample < request_.inputs.samples; ++sample) {
      if (host_.interrupted()) return std::nullopt;
      host_.tell("samples", sample, request_.inputs.samples, "samples");
      const FrameResult result = run(frame, sample);
      map.add_sample(result.summed->links);
      all_s_ += result.seconds.at("frame");
      ++samples_run_;
    }
    return map.finish();
  }

  FrameResult run(uint32_t frame, std::optional<size_t> sample) {
    WorldState state = nominal_;
    std::vector<device::wt_material> materials = variation_.materials();
    if (sample) variation_.apply(*sample, out_.varied, state, materials);
    setup_.finish.set_materials(materials);
    frames_.loop().forget();
    return frames_.run(
        [&](const LinkPart& links) {
          return FrameTask::of_drive({.frame = frame,
                                      .pose = [&state] { return state; },
                                      .names = FrameNames::of(setup_.plan->asked),
                                      .timed = false},
                                     links);
        },
        LinkPart());
  }

  const ChanceRequest& request_;
  const study::Host& host_;
  const Config config_;
  const std::vector<coverage::Threshold> thresholds_;
  const ReceiverGridConfig& grid_;
  std::shared_ptr<void> starting_;  // while the constructor compiles kernels
  Setup setup_;
  const std::optional<uint32_t> tx_;
  BatchedFrames frames_;
  const InputVariation variation_;
  WorldState nominal_;
  double all_s_ = 0;
  uint64_t samples_run_ = 0;
  ChanceStudy out_;
};

// Returns the share of the cells for which the predicate holds, in percent.
template <class Holds>
double percent(const std::vector<coverage::Chances>& cells, const Holds& holds) {
  return 100.0 * static_cast<double>(std::ranges::count_if(cells, holds)) / static_cast<double>(cells.size());
}

double median_deviation_db(const std::vector<coverage::Chances>& cells) {
  std::vector<double> known;
  for (const coverage::Chances& cell : cells)
    if (std::isfinite(cell.path_gain_deviation_db)) known.push_back(cell.path_gain_deviation_db);
  if (known.empty()) return std::nan("");
  std::ranges::sort(known);
  return 0.5 * (known[(known.size() - 1) / 2] + known[known.size() / 2]);
}

}  // namespace

const ReceiverGridConfig& mapped_grid(const Config& config, const ChanceRequest& request) {
  const std::vector<ReceiverGridConfig>& grids = config.receiver_grids;
  const std::string& file = request.inputs.file;
  if (grids.empty())
    throw ConfigError(
        file +
        ": has no [[receiver_grid]], whose cells --threshold needs: add one, or leave --threshold out for "
        "intervals of links");
  if (!request.grid.empty()) return find_grid(grids, request.grid);
  std::vector<std::string> known;
  for (const ReceiverGridConfig& grid : grids) known.push_back(grid.name);
  if (known.size() > 1)
    throw ConfigError(
        fmt::format("{}: has {} grids: name one with --grid, of {}", file, known.size(), fmt::join(known, ", ")));
  return grids.front();
}

ChanceStudy study_chances(const ChanceRequest& request, const study::Host& host) {
  return ChanceMeasurement(request, host)();
}

std::string chances_text(const ChanceStudy& study) {
  constexpr double sure = 0.95;
  std::string text;
  for (const coverage::Map& map : study.maps) {
    const std::vector<coverage::Chances>& cells = map.chances;
    text += fmt::format("{}{} x {} cells of {}, {} samples\n", study.drive ? fmt::format("frame {}: ", map.frame) : "",
                        map.columns, map.rows, map.grid, map.samples);
    for (const coverage::Threshold& threshold : map.thresholds) {
      const auto chance = threshold.layer->chance;
      double sum = 0;
      for (const coverage::Chances& cell : cells) sum += cell.*chance;
      text += fmt::format(
          "  {} of {} {} or more: {:.3g}% of the cells in at least 95% of the samples, {:.3g}% in at least half; the "
          "mean probability is {:.3g}%\n",
          threshold.tested->words, threshold.least, threshold.tested->unit,
          percent(cells, [&](const coverage::Chances& cell) { return cell.*chance >= sure; }),
          percent(cells, [&](const coverage::Chances& cell) { return cell.*chance >= 0.5; }),
          100 * sum / static_cast<double>(cells.size()));
    }
    text += fmt::format(
        "  standard deviation of the path gain: {:.2g} dB in the median cell; {:.3g}% of the cells have no path in any "
        "sample\n",
        median_deviation_db(cells), percent(cells, [](const coverage::Chances& cell) { return cell.samples == 0; }));
  }
  return text + fmt::format("samples       {:.3g} ms each, the first frame {:.3g} ms\n", 1e3 * study.sample_s,
                            1e3 * study.nominal_s);
}

}  // namespace wavetracer::accuracy
