// SPDX-License-Identifier: Apache-2.0
// Objects of the scene keep their names and are buildings for DeepMIMO; vehicles are objects if the frame has them. An
// object without triangles is left out: DeepMIMO cannot say where it is.
#include "convert/deepmimo_scene.hpp"
#include <fmt/format.h>
#include <cmath>
#include "convert/npz.hpp"

namespace wavetracer {
namespace {

// The meshes so far: one list of vertices, and the triangles and materials of each object.
struct Meshes {
  std::vector<double> vertices;
  std::vector<std::vector<uint32_t>> faces, materials;
  nlohmann::ordered_json objects = nlohmann::ordered_json::array();

  void add(const std::string& name, const char* label, std::vector<uint32_t> triangles,
           std::vector<uint32_t> material) {
    if (triangles.empty()) return;
    const size_t id = objects.size();
    objects.push_back({{"name", name}, {"label", label}, {"id", id}, {"mesh_key", std::to_string(id)}});
    faces.push_back(std::move(triangles));
    materials.push_back(std::move(material));
  }
  // Returns the index of the first vertex.
  template <typename Place>
  uint32_t add_vertices(const Scene& scene, Place place) {
    const auto first = static_cast<uint32_t>(vertices.size() / 3);
    for (const glm::dvec3& vertex : scene.vertices) {
      const glm::dvec3 p = place(scene.origin_m + vertex);
      vertices.insert(vertices.end(), {p.x, p.y, p.z});
    }
    return first;
  }
};

void warn_of_layers(const Scene& scene, Warnings& warnings) {
  for (const Material& material : scene.materials)
    if (!material.layers.empty())
      warnings.push_back(
          fmt::format("deepmimo: the material \"{}\" has {} layers, of which the scene that is written has the first",
                      material.name, material.layers.size()));
}

void add_scene(Meshes& meshes, const Scene& scene, uint32_t first_material) {
  const uint32_t base = meshes.add_vertices(scene, [](const glm::dvec3& p) { return p; });
  std::vector<std::vector<uint32_t>> triangles(scene.objects.size()), materials(scene.objects.size());
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    const uint32_t object = scene.triangle_object[t];
    for (const uint32_t vertex : scene.triangles[t]) triangles[object].push_back(base + vertex);
    materials[object].push_back(first_material + scene.surfaces[scene.triangle_surface[t]].material);
  }
  for (size_t i = 0; i < triangles.size(); ++i)
    meshes.add(scene.objects[i], "buildings", std::move(triangles[i]), std::move(materials[i]));
}

void add_vehicle(Meshes& meshes, const Scene& model, const SavedPose& pose, const std::string& name,
                 uint32_t first_material) {
  const uint32_t base =
      meshes.add_vertices(model, [&](const glm::dvec3& p) { return pose.position_m + pose.rotation * p; });
  std::vector<uint32_t> triangles, materials;
  for (size_t t = 0; t < model.triangles.size(); ++t) {
    for (const uint32_t vertex : model.triangles[t]) triangles.push_back(base + vertex);
    materials.push_back(first_material + model.surfaces[model.triangle_surface[t]].material);
  }
  meshes.add(name, "objects", std::move(triangles), std::move(materials));
}

}  // namespace

DeepmimoScene::DeepmimoScene(const SavedRun& run, Warnings& warnings)
    : world_(load_saved_world(run)), frequency_hz_(run.frequency_hz()) {
  for (const SavedInstance& instance : run.instances()) vehicles_.push_back(instance.id);
  for (const std::string& warning : world_.warnings) warnings.push_back("deepmimo: " + warning);
  if (const size_t volumes = world_.scene.volumes.size(); volumes > 0)
    warnings.push_back(
        fmt::format("deepmimo: {} volumes of vegetation are no objects of the scene that is written", volumes));
  warn_of_layers(world_.scene, warnings);
  for (const Scene& model : world_.models) warn_of_layers(model, warnings);
  first_material_.push_back(0);
  auto next = static_cast<uint32_t>(world_.scene.materials.size());
  for (const Scene& model : world_.models) {
    first_material_.push_back(next);
    next += static_cast<uint32_t>(model.materials.size());
  }
}

nlohmann::ordered_json DeepmimoScene::materials() const {
  nlohmann::ordered_json list = nlohmann::ordered_json::object();
  const double ghz = frequency_hz_ / 1e9;
  const auto add = [&](const Material& m) {
    const size_t id = list.size();
    const char* model = m.scattering == 0 ? "none" : m.scattering_lobe == 0 ? "lambertian" : "directive";
    nlohmann::ordered_json& out = list[fmt::format("material_{}", id)];
    out = {{"id", id},
           {"name", m.name},
           {"permittivity", m.a * std::pow(ghz, m.b)},
           {"conductivity", m.c * std::pow(ghz, m.d)},
           {"scattering_model", model},
           {"scattering_coefficient", m.scattering},
           {"cross_polarization_coefficient", m.scattering_cross_polar}};
    if (m.scattering_lobe > 0) out["alpha_r"] = m.scattering_lobe;
    const double thickness_m = m.layers.empty() ? m.thickness_m : m.layers.front().thickness_m;
    if (std::isfinite(thickness_m)) out["thickness"] = thickness_m;
  };
  for (const Material& material : world_.scene.materials) add(material);
  for (const Scene& model : world_.models)
    for (const Material& material : model.materials) add(material);
  return list;
}

SceneSize DeepmimoScene::write(const PendingFolder& folder, const std::filesystem::path& where,
                               const SavedFrame& frame) const {
  Meshes meshes;
  add_scene(meshes, world_.scene, first_material_[0]);
  for (const SavedPose& pose : frame.poses)
    if (const uint32_t model = world_.instance_model[pose.instance]; model != no_instance)
      add_vehicle(meshes, world_.models[model], pose, vehicles_[pose.instance], first_material_[model + 1]);

  const auto archive = [&](const char* name, const auto& fill) {
    Npz npz([&](std::span<const std::byte> bytes) { folder.append(where / name, bytes); });
    fill(npz);
    npz.finish();
  };
  SceneSize size{meshes.objects.size(), meshes.vertices.size() / 3, 0};
  archive("vertices.npz", [&](Npz& npz) { npz.add("vertices", {size.vertices, 3}, meshes.vertices); });
  archive("faces.npz", [&](Npz& npz) {
    for (size_t i = 0; i < size.objects; ++i)
      npz.add(std::to_string(i), {meshes.faces[i].size() / 3, 3}, meshes.faces[i]);
  });
  archive("materials.npz", [&](Npz& npz) {
    for (size_t i = 0; i < size.objects; ++i)
      npz.add(std::to_string(i), {meshes.materials[i].size()}, meshes.materials[i]);
  });
  folder.append(where / "objects.json", json_text(meshes.objects));
  for (const auto& materials : meshes.materials) size.triangles += materials.size();
  return size;
}

std::string json_text(const nlohmann::ordered_json& value) {
  return value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace wavetracer
