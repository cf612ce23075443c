// SPDX-License-Identifier: Apache-2.0
// Each frame starts without results of earlier ones, because its paths should depend on the setting alone; but it is
// timed on a warm device. Where sequences are reused, the ten frames before launch every direction once
// (trace.refresh_rays by default).
#include "accuracy/measure.hpp"
#include <algorithm>
#include <memory>
#include "output/median.hpp"
#include "output/totals.hpp"

namespace wavetracer::accuracy {
namespace {

constexpr uint32_t lead_frames = 10;
constexpr double slow_frame_s = 2;  // a slower frame is not repeated: starting the device is only a small part of it

class Meter {
 public:
  explicit Meter(Measured& out) : out_(out) {}

  void time(const FrameResult& result) { seconds_.push_back(result.seconds.at("frame")); }

  void keep(FrameResult&& result) {
    out_.paths += result.paths.size();
    out_.links += result.world.links.size();
    add_warnings(out_.warnings, result.warnings);
    out_.frames.push_back(std::move(result.paths));
    out_.frame_s = median(seconds_);
  }

 private:
  Measured& out_;
  std::vector<double> seconds_;
};

// Returns false if it was interrupted.
bool measure_cold(Simulation& simulation, Meter& meter, const std::vector<uint32_t>& frames, const How& how) {
  bool warm = false;
  for (const uint32_t frame : frames) {
    FrameResult result;
    for (uint32_t timed = 0; timed < how.repeats;) {
      if (how.host.interrupted()) return false;
      simulation.forget();
      simulation.give_back(result);
      result = simulation.run_frame(frame);
      const bool slow = result.seconds.at("frame") > slow_frame_s;
      if (warm || slow) {
        meter.time(result);
        timed = slow ? how.repeats : timed + 1;
      }
      warm = true;
    }
    meter.keep(std::move(result));
  }
  return true;
}

bool measure_reuse(Simulation& simulation, Meter& meter, const std::vector<uint32_t>& frames, const How& how) {
  std::optional<uint32_t> last;  // the last frame that was solved
  for (const uint32_t frame : frames) {
    const uint32_t lead = frame < lead_frames ? 0 : frame - lead_frames;
    const bool goes_on = last && *last + 1 >= lead;
    if (!goes_on) simulation.forget();
    for (uint32_t next = goes_on ? *last + 1 : lead; next <= frame; ++next) {
      if (how.host.interrupted()) return false;
      FrameResult result = simulation.run_frame(next);
      if (goes_on || next > lead || next == frame) meter.time(result);
      if (next == frame)
        meter.keep(std::move(result));
      else
        simulation.give_back(result);
    }
    last = frame;
  }
  return true;
}

}  // namespace

std::vector<uint32_t> spread_frames(uint64_t of, uint32_t count) {
  const uint64_t parts = std::min<uint64_t>(of, count);
  std::vector<uint32_t> frames;
  for (uint64_t part = 0; part < parts; ++part)
    frames.push_back(static_cast<uint32_t>((2 * part + 1) * of / (2 * parts)));
  return frames;
}

std::optional<Measured> measure(const Config& config, const Setting& setting, const How& how) {
  Simulation simulation = [&] {
    const std::shared_ptr<void> guard = how.host.guard(how.keep);
    Config measured = config;
    measured.radars.clear();  // they are made of paths and have none of their own
    return Simulation(measured, how.device);
  }();
  simulation.observe(how.host.watch);
  Measured out;
  out.device = simulation.device();
  out.edge_rays = simulation.edge_rays();
  out.world_frames = simulation.frame_count();
  if (!setting.needs.empty()) {
    const Feature& feature = simulation.features().at(setting.needs);
    out.refusal = feature.on ? "" : feature.reason;
    if (!feature.on) return out;
  }
  Meter meter(out);
  const std::vector<uint32_t> frames = spread_frames(simulation.frame_count(), how.frames);
  try {
    const bool whole =
        setting.leads ? measure_reuse(simulation, meter, frames, how) : measure_cold(simulation, meter, frames, how);
    if (!whole) return std::nullopt;
  } catch (const FrameStopped&) {
    return std::nullopt;
  }
  return out;
}

}  // namespace wavetracer::accuracy
