// SPDX-License-Identifier: Apache-2.0
// Checks of [[target_model]], [[target_part]] and [[target]]: keys that go with one kind, lists of the right length,
// names that nothing has, and what targets do not go with.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/spelling.hpp"
#include "config/contradictions.hpp"
#include "config/value_text.hpp"

namespace wavetracer::config {
namespace {

void check_lobes(const TargetModelConfig& model, const std::string& key, size_t points,
                 std::vector<Contradiction>& out) {
  for (size_t i = 0; i < model.lobes.size(); ++i) {
    const auto& [of, azimuth, azimuth_width, zenith, zenith_width, peak, range] = model.lobes[i];
    const auto refuse = [&](const std::string& what) {
      out.push_back(
          {{key + ".lobes"}, fmt::format("target_model.lobes[{}] of {} {}", i, toml_string(model.name), what)});
    };
    if (of < 0 || of != std::floor(of) || of >= static_cast<double>(points))
      refuse(fmt::format("belongs to point {:g}, but its points are 0 to {}", of, points - 1));
    if (azimuth_width < 0 || zenith_width < 0) refuse("has a negative width: give 0 where all angles are alike");
    if (zenith < 0 || zenith > 180) refuse(fmt::format("has the zenith {:g}, which is from 0 to 180 degrees", zenith));
    if (range < 0) refuse("falls by a negative range: give by how many dB it falls at most");
  }
}

void check_custom(const TargetModelConfig& model, const std::string& key, std::vector<Contradiction>& out) {
  const std::string name = toml_string(model.name);
  const size_t points = std::max<size_t>(model.points_m.size(), 1);
  if (model.rcs_dbsm.empty() == model.lobes.empty())
    out.push_back({{key, key + ".rcs_dbsm", key + ".lobes"},
                   fmt::format("[[target_model]] {} has kind = \"custom\" and {} rcs_dbsm {} lobes: give one of them",
                               name, model.lobes.empty() ? "neither" : "both", model.lobes.empty() ? "nor" : "and")});
  if (model.rcs_dbsm.size() > 1 && model.rcs_dbsm.size() != points)
    out.push_back(
        {{key + ".rcs_dbsm"},
         fmt::format("[[target_model]] {} has {} numbers in rcs_dbsm for {} points: give one for each point, or "
                     "one for all",
                     name, model.rcs_dbsm.size(), points)});
  check_lobes(model, key, points, out);
}

// A body has the facets and the materials of its vehicle.
void check_body_model(const Config& config, const TargetModelConfig& model, const std::string& key,
                      std::vector<Contradiction>& out) {
  const auto refuse = [&](const char* name) {
    out.push_back({{key + "." + name},
                   fmt::format("[[target_model]] {} has kind = \"body\", whose facets and materials are those of the "
                               "vehicle: remove {}, or use another kind",
                               toml_string(model.name), name)});
  };
  if (!model.rcs_dbsm.empty()) refuse("rcs_dbsm");
  if (!model.lobes.empty()) refuse("lobes");
  if (model.bistatic_db != std::array<double, 3>{0, 0, 0}) refuse("bistatic_db");
  if (!model.points_m.empty()) refuse("points_m");
  if (model.xpr_db) refuse("xpr_db");
  if (model.size_m) refuse("size_m");
  if (model.on.empty() && std::ranges::find(config.targets, model.name, &TargetConfig::model) == config.targets.end())
    out.push_back(
        {{key + ".on"},
         fmt::format("[[target_model]] {} has kind = \"body\" and no on, and no [[target]] has it, so no body "
                     "is it: name vehicles or their types by on, or add a [[target]] with a vehicle_type",
                     toml_string(model.name))});
}

void check_kind(const TargetModelConfig& model, const std::string& key, std::vector<Contradiction>& out) {
  const auto refuse = [&](const char* of, const std::string& why) {
    out.push_back(
        {{key + "." + of},
         fmt::format("[[target_model]] {} has kind = \"{}\", {}", toml_string(model.name), model.kind.word(), why)});
  };
  if (!model.rcs_dbsm.empty())
    refuse("rcs_dbsm", "which has its own cross section: remove rcs_dbsm, or use \"custom\"");
  if (!model.lobes.empty()) refuse("lobes", "which has its own lobes: remove lobes, or use \"custom\"");
  if (model.bistatic_db != std::array<double, 3>{0, 0, 0})
    refuse("bistatic_db", "which has its own bistatic law: remove bistatic_db, or use \"custom\"");
  const size_t points = model.kind == "vehicle-points" || model.kind == "agv-points" ? 5 : 1;
  if (!model.points_m.empty() && model.points_m.size() != points)
    refuse("points_m", fmt::format("which has {}, but points_m has {}: remove points_m, or give as many",
                                   points == 1 ? "one point" : "5 points", model.points_m.size()));
}

// Keys of one kind of part that the other has not, and what a kind needs.
void check_part(const TargetPartConfig& part, const std::string& key, std::vector<Contradiction>& out) {
  const std::string what = fmt::format("[[target_part]] of {}", toml_string(part.model));
  const auto check = [&](const char* name, const std::optional<double>& value, bool needed) {
    if (needed && !value)
      out.push_back({{key}, fmt::format("{} has kind = \"{}\" and no {}: give it one", what, part.kind.word(), name)});
    if (!needed && value)
      out.push_back(
          {{key + "." + name},
           fmt::format("{} has kind = \"{}\", which has no {}: remove the key", what, part.kind.word(), name)});
  };
  check("radius_m", part.radius_m, part.wheel());
  for (const auto& [name, value] :
       {std::pair{"length_m", part.length_m}, {"swing_deg", part.swing_deg}, {"stride_m", part.stride_m}})
    check(name, value, !part.wheel());
  const auto& [ahead, left, up] = part.axis;
  if (!(std::hypot(ahead, left) > 1e-6 * std::abs(up)))
    out.push_back({{key + ".axis"},
                   fmt::format("{} turns about an axis that is upright or has no length: give it a level one, such as "
                               "[0, 1, 0]",
                               what)});
}

void check_parts(const Config& config, const std::vector<std::string>& models, std::vector<Contradiction>& out) {
  for (size_t i = 0; i < config.target_parts.size(); ++i) {
    const TargetPartConfig& part = config.target_parts[i];
    const std::string key = fmt::format("target_part.{}", i);
    if (std::ranges::find(models, part.model) == models.end())
      out.push_back(
          {{key + ".model"},
           fmt::format("target_part.model = {}: there is no [[target_model]] of this name{}; add one, or name "
                       "another",
                       toml_string(part.model), spelling_hint(part.model, models))});
    check_part(part, key, out);
  }
}

void check_neighbours(const Config& config, std::vector<Contradiction>& out) {
  const TraceConfig& trace = config.trace;
  if (!trace.target || !has_targets(config)) return;
  const auto refuse = [&](std::vector<std::string> keys, const std::string& what) {
    keys.push_back(config.targets.empty() ? "target_model.0" : "target.0");
    out.push_back({std::move(keys), what});
  };
  if (trace.by_spheres())
    refuse({"trace.reception"},
           "trace.reception = \"sphere\" receives reflected rays only, but there are targets: use trace.reception = "
           "\"exact\", or set trace.target to false");
  if (trace.floor_db)
    refuse({"trace.floor_db"},
           fmt::format("trace.floor_db = {} says nothing of the power of waves that a target scatters: "
                       "remove trace.floor_db, or set trace.target to false",
                       *trace.floor_db));
  if (trace.target_reflections > 0 && trace.diffraction && trace.edge_rays.value_or(0) > 0)
    refuse(
        {"trace.edge_rays", "trace.target_reflections"},
        fmt::format("trace.edge_rays = {} does not go with trace.target_reflections = {}: give trace.edge_rays = 0, so "
                    "that receivers launch rays, or set trace.target_reflections to 0",
                    *trace.edge_rays, trace.target_reflections));
  if (trace.target_diffraction && (!trace.diffraction || trace.target_reflections == 0))
    refuse({"trace.target_diffraction", "trace.diffraction", "trace.target_reflections"},
           fmt::format("trace.target_diffraction = true needs trace.diffraction = true and trace.target_reflections of "
                       "at least 1, but they are {} and {}: set them, or set trace.target_diffraction to false",
                       trace.diffraction, trace.target_reflections));
}

}  // namespace

bool has_targets(const Config& config) {
  return !config.targets.empty() ||
         std::ranges::any_of(config.target_models, [](const TargetModelConfig& model) { return !model.on.empty(); });
}

void check_targets(const Config& config, std::vector<Contradiction>& out) {
  std::vector<std::string> names;
  for (size_t i = 0; i < config.target_models.size(); ++i) {
    const TargetModelConfig& model = config.target_models[i];
    names.push_back(model.name);
    const std::string key = fmt::format("target_model.{}", i);
    if (model.piece_m && !model.body())
      out.push_back({{key + ".piece_m"},
                     fmt::format("[[target_model]] {} has kind = \"{}\" and piece_m, which only a body has: remove "
                                 "piece_m, or use kind = \"body\"",
                                 toml_string(model.name), model.kind.word())});
    if (model.bounces && !model.body())
      out.push_back({{key + ".bounces"},
                     fmt::format("[[target_model]] {} has kind = \"{}\" and bounces, which only a body has: remove "
                                 "bounces, or use kind = \"body\"",
                                 toml_string(model.name), model.kind.word())});
    if (config.trace.target && model.body() && model.bounces.value_or(1) > std::max(config.trace.max_depth, 1u))
      out.push_back({{key + ".bounces", "trace.max_depth"},
                     fmt::format("[[target_model]] {} has bounces = {}, but paths have at most trace.max_depth = {} "
                                 "interactions: raise trace.max_depth, or lower bounces",
                                 toml_string(model.name), *model.bounces, config.trace.max_depth)});
    if (model.custom())
      check_custom(model, key, out);
    else if (model.body())
      check_body_model(config, model, key, out);
    else
      check_kind(model, key, out);
  }
  for (size_t i = 0; i < config.targets.size(); ++i) {
    const std::string& model = config.targets[i].model;
    if (std::ranges::find(names, model) == names.end())
      out.push_back(
          {{fmt::format("target.{}.model", i)},
           fmt::format("target.model = {}: there is no [[target_model]] of this name{}; add one, or name another",
                       toml_string(model), spelling_hint(model, names))});
    const auto found = std::ranges::find(config.target_models, model, &TargetModelConfig::name);
    if (found != config.target_models.end() && found->body() && config.targets[i].vehicle_type.empty())
      out.push_back({{fmt::format("target.{}.model", i), fmt::format("target.{}.vehicle_type", i)},
                     fmt::format("target.model = {} has kind = \"body\", but [[target]] {} has no vehicle_type, whose "
                                 "body would scatter: name a [[vehicle_type]] by vehicle_type",
                                 toml_string(model), toml_string(config.targets[i].name))});
  }
  check_parts(config, names, out);
  check_neighbours(config, out);
}

}  // namespace wavetracer::config
