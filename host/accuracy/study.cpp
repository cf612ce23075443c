// SPDX-License-Identifier: Apache-2.0
// The user's own settings are measured first, because mistakes and a scene without links show there; then axis by axis.
// Only the paths of the own settings and of one reference at a time are kept.
#include "accuracy/study.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <new>
#include "base/digits.hpp"
#include "base/times.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::accuracy {
namespace {

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

study::PathError mean_error(const Measured& reference, const Measured& measured) {
  study::PathErrorMean mean;
  for (size_t i = 0; i < reference.frames.size(); ++i)
    mean.add(study::path_error(reference.frames[i], measured.frames[i]));
  return mean.mean();
}

class Measurement {
 public:
  Measurement(const Request& request, const study::Host& host, const std::function<void(const Study&)>& keep)
      : request_(request), host_(host), keep_(keep), own_(load_config(request.file, request.sets)) {
    if (!own_.live_vehicles.empty())
      throw ConfigError(request.file +
                        ": its [[live_vehicle]] tables need a client that sends poses, so no frame can be measured; "
                        "give trajectories instead of them");
    if (own_.trace.floor_db)
      throw ConfigError(request.file +
                        ": the lists of other settings have paths of every gain, but trace.floor_db leaves weak ones "
                        "out of this one: remove trace.floor_db, and give trace.max_depth the depth of the paths");
  }

  Study operator()() {
    out_.config_file = request_.file;
    out_.scene = own_.scene.file.empty() ? "city " + own_.scene.generate : own_.scene.file;
    out_.repeats = request_.repeats;
    if (!measure_own()) return out_;
    Config decided = own_;
    if (measured_own_.edge_rays > 0) decided.trace.edge_rays = measured_own_.edge_rays;
    const std::vector<Axis> all = axes(decided, out_.drive, request_.rays, request_.certify);
    for (const Axis& axis : all) out_.planned += axis.settings.size() + 1;
    for (const Axis& axis : all)
      if (!measure_axis(axis)) return out_;
    check_paths();
    return out_;
  }

 private:
  Config config_of(const Setting& setting) const {
    std::vector<std::string> sets = request_.sets;
    sets.insert(sets.end(), setting.keys.begin(), setting.keys.end());
    return load_config(request_.file, sets);
  }

  How how() const {
    How out{request_.device, request_.frames, request_.repeats, host_};
    if (keep_ && !out_.rows.empty()) out.keep = [this] { keep_(out_); };
    return out;
  }

  bool measure_own() {
    host_.say("measuring your own settings first");
    host_.tell("your own settings", 0, 1, "settings");
    std::optional<Measured> measured = measure(own_, {}, how());
    if (!measured) return false;
    measured_own_ = std::move(*measured);
    out_.device = measured_own_.device;
    out_.frames = measured_own_.frames.size();
    out_.links = measured_own_.links;
    out_.drive = measured_own_.world_frames > 1;
    if (out_.links == 0)
      throw ConfigError(
          fmt::format("{}: none of the {} measured frames has a link, so there is nothing to compare; "
                      "look at [links], and at where and when transmitters and receivers are there",
                      request_.file, out_.frames));
    return true;
  }

  bool is_own(const Config& config, const Setting& setting) const {
    return !setting.leads && resolved_config(config) == resolved_config(own_);
  }

  // Returns nothing if it was interrupted; a refusal if the configuration or the device cannot do it.
  std::optional<Measured> try_measure(const Setting& setting, bool& own) const {
    Measured refused;
    try {
      const Config config = config_of(setting);
      own = is_own(config, setting);
      if (own) return measured_own_;
      return measure(config, setting, how());
    } catch (const Error& e) {
      refused.refusal = one_line(e.what());
    } catch (const std::bad_alloc&) {
      refused.refusal = "out of memory";
    }
    return refused;
  }

  // Reports progress before a setting is measured: how many of all are done.
  void tell(const Setting& setting) const {
    host_.tell(setting.axis + " " + setting.name, out_.rows.size(), out_.planned, "settings");
  }

  void add(const Setting& setting, const Measured& measured, const Measured& reference, bool is_reference, bool own) {
    Row row{.setting = setting,
            .reference = is_reference,
            .own = own,
            .error = {},
            .refusal = measured.refusal,
            .warnings = measured.warnings};
    if (row.measured()) {
      row.frame_s = measured.frame_s;
      row.paths = measured.paths;
      if (reference.refusal.empty()) row.error = mean_error(reference, measured);
    }
    out_.rows.push_back(row);
    host_.say(fmt::format("{} of {}: {} {}{}", out_.rows.size(), out_.planned, setting.axis, setting.name,
                          row.measured()
                              ? fmt::format(", {} per frame, {} paths", duration_text(row.frame_s), grouped(row.paths))
                              : ": not measured: " + row.refusal));
  }

  bool measure_axis(const Axis& axis) {
    bool own = false;
    tell(axis.reference);
    const std::optional<Measured> reference = try_measure(axis.reference, own);
    if (!reference) return false;
    const bool nothing_to_switch_off = !axis.reference.needs.empty() && !reference->refusal.empty();
    if (nothing_to_switch_off) out_.planned -= axis.settings.size();
    add(axis.reference, *reference, *reference, true, own);
    if (nothing_to_switch_off) return true;
    for (const Setting& setting : axis.settings) {
      own = false;
      tell(setting);
      const std::optional<Measured> measured = try_measure(setting, own);
      if (!measured) return false;
      add(setting, *measured, *reference, false, own);
    }
    return true;
  }

  void check_paths() const {
    for (const Row& row : out_.rows)
      if (row.reference && row.paths > 0) return;
    throw ConfigError(fmt::format(
        "{}: none of the {} links has a path at any setting, not even with every mechanism that the scene needs, "
        "so there is nothing to compare; look at where the antennas stand",
        request_.file, out_.links));
  }

  const Request& request_;
  const study::Host& host_;
  const std::function<void(const Study&)>& keep_;
  const Config own_;
  Measured measured_own_;
  Study out_;
};

}  // namespace

Study study(const Request& request, const study::Host& host, const std::function<void(const Study&)>& keep) {
  return Measurement(request, host, keep)();
}

}  // namespace wavetracer::accuracy
