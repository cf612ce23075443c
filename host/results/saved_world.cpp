// SPDX-License-Identifier: Apache-2.0
// The configuration's paths must be absolute, as runs write them.
// Vehicles are matched by their id, because a run of a part of the frames lists the same vehicles.
#include "results/saved_world.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include "base/hash.hpp"
#include "config/retired_keys.hpp"
#include "imports/road_network.hpp"
#include "scene/ground.hpp"
#include "scene/load.hpp"
#include "simulation/world.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// Files that no longer exist are reported by their readers.
void warn_changed(const SavedRun& run, std::vector<std::string>& warnings) {
  for (const InputFile& input : run.inputs()) {
    const auto now = hash_of_file(input.file);
    if (now && (now->bytes != input.bytes || now->hash != input.hash))
      warnings.push_back(fmt::format(
          "{} ({}) has changed since the run: pictures and exports that use it differ from the world of the run",
          input.file, input.name));
  }
}

// Puts lanes of a flat network on the ground that vehicles drive on.
void drape(std::vector<Street>& streets, const Scene& scene) {
  constexpr double step_m = 5;
  const Ground ground(scene);
  for (Street& street : streets) {
    std::vector<glm::dvec3> draped;
    const auto add = [&](glm::dvec3 p) {
      p.z += ground.height_m(glm::dvec2(p)).value_or(0);
      draped.push_back(p);
    };
    for (size_t i = 0; i < street.centre_m.size(); ++i) {
      const glm::dvec3& from = street.centre_m[i];
      add(from);
      if (i + 1 == street.centre_m.size()) break;
      const glm::dvec3& to = street.centre_m[i + 1];
      const double pieces = std::clamp(std::ceil(glm::distance(from, to) / step_m), 1.0, 10000.0);
      for (double k = 1; k < pieces; ++k) add(glm::mix(from, to, k / pieces));
    }
    street.centre_m = std::move(draped);
  }
}

}  // namespace

SavedWorld load_saved_world(const SavedRun& run, bool with_wedges) {
  SavedWorld out;
  out.instance_model.assign(run.instances().size(), no_instance);
  const auto attempt = [&out](const std::string& what, const auto& action) {
    try {
      action();
      return true;
    } catch (const Error& e) {
      out.warnings.push_back(fmt::format("{}: {}", what, e.what()));
      return false;
    }
  };
  if (!attempt("the run's configuration cannot be used", [&] {
        out.config = parse_config(run.config_text(), run.file().string(), config::without_retired_keys());
      }))
    return out;
  warn_changed(run, out.warnings);
  Config config = out.config;
  config.trace.diffraction = config.trace.diffraction || with_wedges;
  if (!attempt("the scene cannot be shown", [&] { out.scene = load_scene(config); })) return out;
  attempt("streets are not shown", [&] {
    out.streets = known_streets(out.config);
    if (from_ground(config.trajectories.above) && !out.streets.empty()) drape(out.streets, out.scene);
  });
  if (run.instances().empty()) return out;
  attempt("vehicles are shown without their bodies", [&] {
    const World world = make_world(out.config, out.scene);
    std::map<std::string, uint32_t> model_of;
    for (const Instance& instance : world.fleet.instances) model_of.emplace(instance.id, instance.model);
    out.models = world.fleet.models;
    for (size_t i = 0; i < run.instances().size(); ++i)
      if (const auto found = model_of.find(run.instances()[i].id); found != model_of.end())
        out.instance_model[i] = found->second;
  });
  return out;
}

}  // namespace wavetracer
