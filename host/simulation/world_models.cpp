// SPDX-License-Identifier: Apache-2.0
// Bodies by the names of types, and meshes stretched to sizes.
// Assumes that SUMO names the type of a vehicle that was changed at run time TYPE@VEHICLE.
#include "simulation/world_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/spelling.hpp"
#include "motion/input_text.hpp"
#include "motion/vehicle_types.hpp"
#include "scene/load.hpp"
#include "scene/materials.hpp"
#include "scene/scene_wedges.hpp"
#include "scene/vehicle_model.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

std::string_view base_of(std::string_view type) { return type.substr(0, type.find('@')); }

bool is_mesh(const VehicleTypeConfig& row) { return !NamedBody::parse(row.model); }

// By the first word of the name that is a vehicle class, which is how sumo_type() finds its size.
NamedBody kind_of(std::string_view type) {
  struct ClassBody {
    std::string_view word;
    NamedBody body;
  };
  constexpr ClassBody classes[] = {{"truck", "truck"},
                                   {"lorry", "truck"},
                                   {"trailer", "truck"},
                                   {"bus", "bus"},
                                   {"coach", "bus"},
                                   {"tram", "tram"},
                                   {"rail", "tram"},
                                   {"railtype", "tram"},
                                   {"ship", "truck"},
                                   {"containertype", "truck"},
                                   {"container", "truck"},
                                   {"delivery", "van"},
                                   {"van", "van"},
                                   {"emergency", "van"},
                                   {"pedestrian", "pedestrian"},
                                   {"pedtype", "pedestrian"},
                                   {"person", "pedestrian"},
                                   {"bicycle", "motorcycle"},
                                   {"bike", "motorcycle"},
                                   {"biketype", "motorcycle"},
                                   {"motorcycle", "motorcycle"},
                                   {"moped", "motorcycle"}};
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz";
  const std::string name = lower_case(type);
  for (size_t at = name.find_first_of(letters); at != name.npos; at = name.find_first_of(letters, at)) {
    const size_t end = std::min(name.find_first_not_of(letters, at), name.size());
    const std::string word = name.substr(at, end - at);
    if (const auto found = std::ranges::find(classes, word, &ClassBody::word); found != std::end(classes))
      return found->body;
    if (sumo_type(word)) break;
    at = end;
  }
  return "car";
}

// Stretched along the axes of the file, from its origin. Planes stay planes: dot(n, p) = d is dot(n / s, s p) = d.
Scene stretched(Scene scene, const glm::dvec3& scale) {
  if (scale == glm::dvec3(1)) return scene;
  scene.origin_m *= scale;
  for (glm::dvec3& vertex : scene.vertices) vertex *= scale;
  for (SceneNode& node : scene.nodes) node.position_m *= scale;
  for (Surface& surface : scene.surfaces) {
    const glm::dvec3 normal = surface.normal / scale;
    surface.normal = normal / glm::length(normal);
    surface.offset_m /= glm::length(normal);
    surface.lower *= scale;
    surface.upper *= scale;
  }
  scene.lower *= scale;
  scene.upper *= scale;
  if (!scene.wedges.empty()) find_wedges(scene);  // angles change with the shape
  return scene;
}

glm::dvec3 size_of(const VehicleType& type) { return {type.length_m, type.width_m, type.height_m}; }

}  // namespace

VehicleModels::VehicleModels(const Config& config) : config_(config) {
  for (const VehicleTypeConfig& row : config.vehicle_types) given_types_.push_back(sized(row));
  const std::string& name = config.trajectories.default_type;
  if (name.empty()) return;
  default_type_ = find_type(name);
  if (default_type_) return;
  std::vector<std::string> known;
  for (const VehicleType& type : given_types_) known.push_back(type.name);
  throw ConfigError(
      fmt::format("trajectories.default_type = \"{}\" is neither a [[vehicle_type]] nor a vehicle class of SUMO{}",
                  name, spelling_hint(name, known)));
}

const VehicleTypeConfig* VehicleModels::row_of(std::string_view name) const {
  const auto found =
      std::find_if(config_.vehicle_types.begin(), config_.vehicle_types.end(),
                   [&](const VehicleTypeConfig& row) { return row.name == name || row.name == base_of(name); });
  return found == config_.vehicle_types.end() ? nullptr : &*found;
}

// Returns those keys of the scene that say what a material's name means.
SceneConfig VehicleModels::material_rules() const {
  SceneConfig rules;
  rules.material_alias = config_.scene.material_alias;
  rules.itu_edition = config_.scene.itu_edition;
  rules.extrapolate_materials = config_.scene.extrapolate_materials;
  rules.plane_tolerance_m = config_.scene.plane_tolerance_m;
  return rules;
}

const Scene& VehicleModels::mesh_of(const VehicleTypeConfig& row) {
  const auto [mesh, is_new] = meshes_.try_emplace({row.model, row.material});
  if (is_new) {
    SceneConfig scene = material_rules();
    scene.default_material = row.material;
    mesh->second = load_scene_file(row.model, scene, config_.materials, config_.radio.frequency_hz,
                                   config_.trace.diffraction ? EdgeSearch::of_model : EdgeSearch::none);
    if (!mesh->second.volumes.empty())
      throw InputError(
          fmt::format("{}: a mesh of this vehicle is vegetation, which only the static scene can have: give it another "
                      "material ([scene.material_alias])",
                      row.model));
  }
  return mesh->second;
}

// The sizes given; for the others those of the mesh, or of SUMO's class.
VehicleType VehicleModels::sized(const VehicleTypeConfig& row) {
  VehicleType out{row.name, row.length_m.value_or(0), row.width_m.value_or(0), row.height_m.value_or(0)};
  std::optional<VehicleType> known = sumo_type(row.name);
  if (is_mesh(row)) {
    const Scene& mesh = mesh_of(row);
    const glm::dvec3 extent_m = mesh.upper - mesh.lower;
    known = {row.name, extent_m.x, extent_m.y, extent_m.z};
  }
  // A vehicle without a body needs no size: its place is where its file puts it.
  if (!row.has_body() && !known) known = VehicleType{row.name, 0, 0, 0};
  for (double VehicleType::*size : {&VehicleType::length_m, &VehicleType::width_m, &VehicleType::height_m}) {
    if (out.*size > 0) continue;
    if (!known || (!((*known).*size > 0) && row.has_body()))
      throw ConfigError(fmt::format("vehicle_type \"{}\": {}: give length_m, width_m and height_m", row.name,
                                    is_mesh(row) ? row.model + " is flat" : "SUMO has no vehicle class of this name"));
    out.*size = (*known).*size;
  }
  return out;
}

std::optional<VehicleType> VehicleModels::find_type(std::string_view name) const {
  if (const VehicleTypeConfig* row = row_of(name))
    return given_types_[static_cast<size_t>(row - config_.vehicle_types.data())];
  if (auto type = sumo_type(base_of(name))) return type;
  return default_type_;
}

std::optional<uint32_t> VehicleModels::model_of(const VehicleType& type, std::string_view vehicle_id) {
  std::string_view name = type.name;
  if (!row_of(name) && !sumo_type(base_of(name))) name = config_.trajectories.default_type;
  const VehicleTypeConfig* row = row_of(name);
  std::string body = row ? row->model : "auto";
  if (body == "auto") body = vehicle_id.starts_with("person:") ? "pedestrian" : kind_of(base_of(name)).text();
  if (body == "none") return std::nullopt;
  const bool mesh = row && is_mesh(*row);
  const auto next = static_cast<uint32_t>(models_.size());
  const auto [found, is_new] =
      index_.try_emplace(Key{body, mesh ? row->material : "", type.length_m, type.width_m, type.height_m}, next);
  if (is_new && mesh) {
    const Scene& scene = mesh_of(*row);
    const glm::dvec3 extent_m = scene.upper - scene.lower;
    glm::dvec3 scale(1);
    for (int axis = 0; axis < 3; ++axis)
      if (extent_m[axis] > 0) scale[axis] = size_of(type)[axis] / extent_m[axis];
    models_.push_back(stretched(scene, scale));
  } else if (is_new) {
    models_.push_back(vehicle_model(NamedBody::named(body), type.length_m, type.width_m, type.height_m,
                                    material_rules(), config_.materials, config_.radio.frequency_hz));
  }
  return found->second;
}

std::vector<std::string> model_warnings(const std::vector<Scene>& models, const Scene& scene) {
  constexpr double longest_m = 400;  // no train is longer
  std::vector<std::string> out;
  const auto add = [&](const std::string& warning) {
    const std::vector<std::string>& said = scene.report.warnings;
    if (std::ranges::find(said, warning) == said.end() && std::ranges::find(out, warning) == out.end())
      out.push_back(warning);
  };
  for (const Scene& model : models) {
    if (model.files.empty()) continue;  // built in
    for (const std::string& warning : model.report.warnings)
      if (!says_unused(warning)) add(warning);
    const glm::dvec3 size = model.upper - model.lower;
    if (const double most_m = std::max({size.x, size.y, size.z}); most_m > longest_m)
      add(fmt::format("{}: the model of a vehicle is {:.0f} m long: is it in metres?", model.file, most_m));
  }
  return out;
}

}  // namespace wavetracer
