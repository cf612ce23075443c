// SPDX-License-Identifier: Apache-2.0
// Puts the buildings of a city model on the ground of the scene, and makes their meshes.
// A building and its parts are moved together.
#include "imports/model_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "imports/model_faces.hpp"
#include "imports/model_ground.hpp"
#include "imports/rings.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

class ModelBuilder {
 public:
  ModelBuilder(CityModel model, const std::string& name, const ImportOptions& options)
      : model_(std::move(model)), name_(name), options_(options) {}

  ModelScene build() {
    choose_levels(model_);
    const PlacedModel place = place_model(model_, name_, options_);
    out_.georeference = place.georeference;
    make_families();
    if (families_.empty()) fail_empty();
    out_.summary.ground = ground(place);
    std::optional<Terrain> terrain;
    if (!options_.terrain.empty()) terrain = read(place);
    std::erase_if(families_, [&](Family& family) { return !settle(family, terrain ? &*terrain->ground : nullptr); });
    out_.meshes = build_ground(out_.summary.ground, terrain ? &*terrain : nullptr, options_);
    const size_t grounds = out_.meshes.size();
    for (const Family& family : families_)
      for (const Body& body : family) add_meshes(body);
    report();
    if (out_.meshes.size() == grounds) fail_empty();
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail_empty() const {
    std::string reasons;
    for (const auto& [reason, count] : model_.left_out) reasons += fmt::format("\n  {:>7}  {}", count, reason);
    throw InputError(fmt::format("{}: contains no building that can be used{}{}", name_,
                                 reasons.empty() ? "" : "; left out:", reasons));
  }

  void make_families() {
    Extent extent;
    for (const ModelObject& object : model_.objects)
      for (const auto& [lod, faces] : object.faces)
        for (const ModelFace& face : faces)
          for (const SpaceRing& ring : face.rings)
            for (const glm::dvec3& p : ring) extent.add({p.x, p.y});
    if (extent.empty()) return;
    out_.summary.offset_m = shift_to_origin(extent, name_);
    out_.georeference.offset_m += out_.summary.offset_m;
    std::vector<size_t> family_of(model_.objects.size(), no_parent);
    for (size_t i = 0; i < model_.objects.size(); ++i) {
      ModelObject& object = model_.objects[i];
      size_t& family = family_of[i];
      if (object.parent != no_parent) family = family_of[object.parent];
      if (family == no_parent) {
        family = families_.size();
        families_.emplace_back();
      }
      Body body{&object, {}, false};
      for (auto& [lod, faces] : object.faces)
        for (ModelFace& face : faces) take(face, body);
      object.faces.clear();
      if (!body.faces.empty()) families_[family].push_back(std::move(body));
    }
    std::erase_if(families_, [](const Family& family) { return family.empty(); });
  }

  void take(ModelFace& face, Body& body) {
    for (SpaceRing& ring : face.rings)
      for (glm::dvec3& p : ring) p += glm::dvec3(out_.summary.offset_m, 0);
    const size_t holes = face.rings.size();
    GridFace on = on_grid(face);
    if (on.rings.size() < holes) model_.left_out["hole of fewer than three corners"] += holes - on.rings.size();
    if (!on.rings.empty() && on.rings[0].size() > 2) return body.faces.push_back(std::move(on));
    ++model_.left_out["surface of fewer than three corners"];
  }

  Extent ground(const PlacedModel& place) const {
    if (!options_.ground) return {};
    Extent out = extent_to_reach(place.network, out_.georeference.offset_m, name_, options_);
    for (const Family& family : families_)
      for (const Body& body : family)
        for (const GridFace& face : body.faces)
          for (const GridCorner& p : face.rings[0]) out.add(glm::dvec2(metres(p)));
    out.lower_m -= options_.margin_m;
    out.upper_m += options_.margin_m;
    return out;
  }

  Terrain read(const PlacedModel& place) {
    Terrain terrain = read_terrain(out_.summary.ground, out_.georeference, options_);
    out_.summary.terrain = terrain.summary;
    model_.warnings.insert(model_.warnings.end(), terrain.warnings.begin(), terrain.warnings.end());
    out_.georeference.elevation_m = 0;
    if (place.above_ellipsoid)
      model_.warnings.push_back(
          fmt::format("{}: its heights are above the ellipsoid, but those of a terrain are mostly above sea level, "
                      "which is tens of metres off",
                      name_));
    return terrain;
  }

  // Moves a building to the ground, and lets it reach below it, so that no face lies in the ground's plane and no gap
  // is below it. Returns false if the building is left out.
  bool settle(Family& family, const Ground* ground) {
    for (Body& body : family) {
      tell_roles(body);
      if (body.inward) ++model_.guessed["object whose surfaces look inward: turned"];
    }
    const int64_t lowest = lowest_corner(family);
    const double lowest_m = static_cast<double>(lowest) / grid_per_m;
    const std::set<GridCorner> feet = feet_of(family, lowest, options_.level_height_m);
    int64_t rise = -lowest, foot = 0;
    if (ground) {
      const auto below = terrain_below(*ground, family);
      if (!below) {
        ++model_.left_out["beyond the terrain"];
        return false;
      }
      rise = 0;
      foot = std::min<int64_t>(lowest, std::llround(std::min(*below, 1e6) * grid_per_m));
      if (std::isfinite(*below)) gaps_m_.push_back(lowest_m - *below);
    }
    lowest_m_ = std::min(lowest_m_, lowest_m);
    highest_m_ = std::max(highest_m_, lowest_m);
    foot -= std::llround(foundation_m * grid_per_m);
    move(family, feet, foot, rise);
    return true;
  }

  const std::string& material_of(Role role) const {
    static const std::string glass = "glass", wood = "wood";
    if (role == Role::roof) return options_.roof_material;
    if (role == Role::window) return glass;
    return role == Role::door ? wood : options_.wall_material;
  }

  SceneMesh empty_mesh(const std::string& id, const std::string& text, const std::string& material) const {
    const std::string kind = material == options_.wall_material   ? ""
                             : material == options_.roof_material ? "roof"
                                                                  : material;
    const std::string name = object_name(id, text);
    return {kind.empty() ? id : id + "_" + kind, kind.empty() ? name : name + " " + kind, material, {}, {}};
  }

  void add_meshes(const Body& body) {
    std::map<std::string, SceneMesh> meshes;
    std::map<std::string, std::map<GridCorner, uint32_t>> corners;
    const std::string id = fmt::format("building_{}", ++built_);
    for (GridFace face : body.faces) {
      tidy(face);  // removes feet that came to one place
      if (face.rings[0].size() < 3) continue;
      const FaceTriangles found = triangulate_face(face);
      if (!found.fault.empty()) {
        ++model_.left_out[fmt::format("surface: {}", found.fault)];
        continue;
      }
      if (found.crossing) ++model_.guessed["surface whose outline touches itself: built all the same"];
      if (found.bend_m > 0.01) ++model_.guessed["surface that is not flat by more than 1 cm: built of flat triangles"];
      const std::string& material = material_of(face.role);
      SceneMesh& mesh = meshes.try_emplace(material, empty_mesh(id, body.object->id, material)).first->second;
      add(face, found.triangles, body.inward, mesh, corners[material]);
    }
    if (meshes.empty()) return;
    ++(body.object->parent == no_parent ? out_.summary.buildings : out_.summary.parts);
    for (auto& [material, mesh] : meshes) out_.meshes.push_back(std::move(mesh));
  }

  void add(const GridFace& face, const std::vector<Triangle>& triangles, bool turned, SceneMesh& mesh,
           std::map<GridCorner, uint32_t>& corners) {
    std::vector<uint32_t> indices;
    for (const auto& ring : face.rings)
      for (const GridCorner& p : ring) {
        const auto [entry, is_new] = corners.try_emplace(p, static_cast<uint32_t>(mesh.vertices.size()));
        if (is_new) {
          mesh.vertices.push_back(metres(p));
          extent_.add(glm::dvec2(mesh.vertices.back()));
        }
        indices.push_back(entry->second);
      }
    for (const Triangle& t : triangles) {
      const Triangle own{indices[t[0]], indices[t[1]], indices[t[2]]};
      if (own[0] != own[1] && own[1] != own[2] && own[2] != own[0])
        mesh.triangles.push_back(turned ? Triangle{own[0], own[2], own[1]} : own);
    }
  }

  void report() {
    ImportSummary& summary = out_.summary;
    summary.lower_m = extent_.lower_m;
    summary.upper_m = extent_.upper_m;
    summary.left_out = model_.left_out;
    summary.guessed = model_.guessed;
    summary.warnings = model_.warnings;
    if (families_.empty()) return;
    summary.heights =
        fmt::format("lowest points of the buildings are at {:.1f} to {:.1f} m in the file", lowest_m_, highest_m_);
    if (options_.terrain.empty()) {
      summary.heights += "; each stands on z = 0";
    } else if (!gaps_m_.empty()) {
      std::ranges::sort(gaps_m_);
      const double middle = gaps_m_[gaps_m_.size() / 2];
      summary.heights +=
          fmt::format(" and stay there, {:+.1f} m ({:+.1f} to {:+.1f}) from the lowest ground below them", middle,
                      gaps_m_.front(), gaps_m_.back());
      constexpr double suspicious_m = 5;
      if (std::abs(middle) > suspicious_m)
        summary.warnings.push_back(fmt::format(
            "{}: half of the buildings are {:.1f} m or more {} the terrain: do the heights of both count from "
            "the same zero?",
            name_, std::abs(middle), middle > 0 ? "above" : "below"));
    }
  }

  CityModel model_;
  const std::string& name_;
  const ImportOptions& options_;
  ModelScene out_;
  std::vector<Family> families_;
  Extent extent_;
  std::vector<double> gaps_m_;
  double lowest_m_ = std::numeric_limits<double>::infinity(), highest_m_ = -std::numeric_limits<double>::infinity();
  size_t built_ = 0;
};

}  // namespace

ModelScene build_model(CityModel model, const std::string& name, const ImportOptions& options) {
  return ModelBuilder(std::move(model), name, options).build();
}

}  // namespace wavetracer::imports
