// SPDX-License-Identifier: Apache-2.0
// The two simulations solve frames alternately, so that other load of the machine affects both.
#include "continuous.hpp"

#include <fmt/format.h>

#include <numeric>
#include <vector>

#include "json_line.hpp"
#include "path_recall.hpp"
#include "timing.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::bench {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

void measure_continuous(const std::string& name, const Config& config, double discover_every_s,
                        const std::string& device, const std::string& command) {
  Simulation all(config, device);
  Config changed = config;
  changed.trace.discover_every_s = discover_every_s;
  Simulation spared(changed, device);
  for (Simulation* simulation : {&all, &spared}) {  // allocates buffers, lets drivers finish compiling
    simulation->profile_every(16);                  // as in runs
    simulation->run_frame(0);
    simulation->run_frame(1);
    simulation->forget();
  }
  std::vector<double> all_s, spared_s, between_s, lost;
  LateCounts late;
  for (uint32_t frame = 0; frame < all.frame_count(); ++frame) {
    const FrameResult expected = all.run_frame(frame), found = spared.run_frame(frame);
    late.add(found.late);
    if (frame == 0) continue;  // cold in both
    all_s.push_back(expected.seconds.at("frame"));
    spared_s.push_back(found.seconds.at("frame"));
    if (found.counts.rays > 0) continue;
    between_s.push_back(found.seconds.at("frame"));
    lost.push_back(1 - path_recall(expected.paths, found.paths).power);
  }
  Result line;
  line.bench = "drive";
  line.name = name;
  line.device = spared.device().name;
  line.value = mean(spared_s);
  line.unit = "s per frame";
  line.better = Better::lower;
  line.baseline = "all frames launch rays";
  line.baseline_value = mean(all_s);
  line.error = mean(lost);
  const double worst = *std::max_element(lost.begin(), lost.end());
  line.detail = fmt::format(
      "{} frames of 1 ms, rays every {} s; a frame without rays {:.4g} s (median); "
      "the worst lacks {:.2g} of the power; "
      "late by the run itself: {} paths, {:.2g} of the power, at most {:.2g}",
      spared_s.size(), discover_every_s, median(between_s), worst, late.paths, late.power_share(), late.largest_share);
  line.extra = {{"between_s", median(between_s)},
                {"worst_lost", worst},
                {"late_power_share", late.power_share()},
                {"late_largest_share", late.largest_share}};
  print(line, command);
}

}  // namespace wavetracer::bench
