// SPDX-License-Identifier: Apache-2.0
// Writes glTF 2.0: the scene object by object, vehicles, paths and sampled rays of the first frame, and ends; several
// frames make an animation. The root node turns z up to glTF's y up and carries the scene's origin, so nodes below it
// are in file axes: a reader that applies nodes in double has file coordinates (x, -z, y), and float32 vertices stay
// near zero.
#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <numeric>
#include <optional>
#include "convert/convert.hpp"
#include "convert/glb_file.hpp"
#include "convert/glb_lines.hpp"
#include "convert/glb_tracks.hpp"
#include "convert/vtk_glb_kml.hpp"
#include "results/saved_waypoints.hpp"
#include "results/saved_world.hpp"
#include "scene/volume_surface.hpp"

namespace wavetracer {
namespace {

using nlohmann::json;

class GlbWriter {
 public:
  GlbWriter(const SavedRun& run, const SavedWorld& world) : run_(run), world_(world) {
    root_ = group("wavetracer");
    const glm::dvec3& o = world.scene.origin_m;
    node(root_)["matrix"] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, o.x, o.z, -o.y, 1};
    file_.add("scenes", {{"nodes", {root_}}});
  }

  void add_scene();
  void add_vegetation();
  void add_vehicles(const std::vector<NodeTrack>& tracks);
  void add_ends(const std::vector<NodeTrack>& transmitters, const std::vector<NodeTrack>& receivers);
  void add_paths(const SavedFrame& frame, Warnings& warnings);
  void add_rays(const WaypointRows& rays);
  // times_s: times of the frames at which all tracks have keys
  void set_times(std::vector<float> times_s) { times_s_ = std::move(times_s); }
  void write(const std::filesystem::path& path) { file_.write(path); }

 private:
  json& node(size_t index) { return file_.root()["nodes"][index]; }
  size_t group(const std::string& name) { return file_.add("nodes", {{"name", name}}); }
  size_t child(size_t parent, json element) {
    const size_t index = file_.add("nodes", std::move(element));
    node(parent)["children"].push_back(index);
    return index;
  }
  size_t material(const Material& material);
  size_t line_material();
  json primitive(const Scene& scene, const std::vector<uint32_t>& triangles, const glm::dvec3& offset_m);
  json primitives(const Scene& scene, std::vector<uint32_t> triangles, const glm::dvec3& offset_m);
  void add_moving(size_t parent, const std::string& name, const NodeTrack& track, std::optional<size_t> mesh);
  void animate(size_t node, const NodeTrack& track);
  void channel(size_t node, const char* path, size_t times, size_t values, const char* interpolation);
  size_t line_mesh(const char* name, const GlbLines& lines);

  const SavedRun& run_;
  const SavedWorld& world_;
  GlbFile file_;
  size_t root_ = 0;
  std::vector<float> times_s_;
  std::vector<std::pair<Material, size_t>> materials_;
  std::optional<size_t> line_material_, all_times_;
};

// Makes one glTF material per radio material, with its name.
size_t GlbWriter::material(const Material& material) {
  for (const auto& [known, index] : materials_)
    if (known == material) return index;
  const size_t index = file_.add("materials", glb_material(material));
  materials_.emplace_back(material, index);
  return index;
}

// Adds one node per material, whose mesh contains all of its volumes: translucent, and closed, so that they can be read
// back.
void GlbWriter::add_vegetation() {
  const Scene& scene = world_.scene;
  if (scene.volumes.empty()) return;
  const size_t parent = child(root_, {{"name", "vegetation"}});
  for (uint32_t m = 0; m < scene.materials.size(); ++m) {
    std::vector<glm::vec3> positions;
    for (const Volume& volume : scene.volumes) {
      if (volume.material != m) continue;
      for (const auto& triangle : surface_triangles(volume))
        positions.insert(positions.end(), triangle.begin(), triangle.end());
    }
    if (positions.empty()) continue;
    std::vector<uint32_t> indices(positions.size());
    std::iota(indices.begin(), indices.end(), 0u);
    const json primitive{{"attributes", {{"POSITION", file_.add_positions(positions)}}},
                         {"indices", file_.add_indices(indices)},
                         {"material", material(scene.materials[m])}};
    const std::string& name = scene.materials[m].name;
    const size_t mesh = file_.add("meshes", {{"name", name}, {"primitives", {primitive}}});
    child(parent, {{"name", name}, {"mesh", mesh}});
  }
}

// Makes the material of paths and markers: it shows the colours of their vertices without lighting.
size_t GlbWriter::line_material() {
  if (!line_material_) {
    file_.root()["extensionsUsed"] = {"KHR_materials_unlit"};
    line_material_ = file_.add("materials", {{"name", "lines"},
                                             {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}},
                                             {"extensions", {{"KHR_materials_unlit", json::object()}}}});
  }
  return *line_material_;
}

// Makes a primitive of the triangles of one material. Each vertex is stored once; normals are left out, which means
// flat shading.
json GlbWriter::primitive(const Scene& scene, const std::vector<uint32_t>& triangles, const glm::dvec3& offset_m) {
  std::vector<uint32_t> used;
  for (const uint32_t t : triangles) used.insert(used.end(), scene.triangles[t].begin(), scene.triangles[t].end());
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<glm::vec3> positions;
  for (const uint32_t vertex : used) positions.emplace_back(scene.vertices[vertex] + offset_m);
  std::vector<uint32_t> indices;
  for (const uint32_t t : triangles)
    for (const uint32_t vertex : scene.triangles[t])
      indices.push_back(static_cast<uint32_t>(std::ranges::lower_bound(used, vertex) - used.begin()));
  const uint32_t of = scene.surfaces[scene.triangle_surface[triangles.front()]].material;
  return {{"attributes", {{"POSITION", file_.add_positions(positions)}}},
          {"indices", file_.add_indices(indices)},
          {"material", material(scene.materials[of])}};
}

// Makes one primitive per material, in the order in which materials first appear.
json GlbWriter::primitives(const Scene& scene, std::vector<uint32_t> triangles, const glm::dvec3& offset_m) {
  const auto material_of = [&](uint32_t t) { return scene.surfaces[scene.triangle_surface[t]].material; };
  std::ranges::stable_sort(triangles, {}, material_of);
  json out = json::array();
  for (size_t first = 0; first < triangles.size();) {
    size_t last = first;
    while (last < triangles.size() && material_of(triangles[last]) == material_of(triangles[first])) ++last;
    out.push_back(primitive(
        scene, {triangles.begin() + static_cast<ptrdiff_t>(first), triangles.begin() + static_cast<ptrdiff_t>(last)},
        offset_m));
    first = last;
  }
  return out;
}

void GlbWriter::add_scene() {
  const Scene& scene = world_.scene;
  if (scene.triangles.empty()) return;
  std::vector<std::vector<uint32_t>> of_object(scene.objects.size());
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) of_object[scene.triangle_object[t]].push_back(t);
  const size_t parent = child(root_, {{"name", "scene"}});
  for (size_t i = 0; i < of_object.size(); ++i) {
    if (of_object[i].empty()) continue;
    const std::string& name = scene.objects[i];
    const size_t mesh =
        file_.add("meshes", {{"name", name}, {"primitives", primitives(scene, std::move(of_object[i]), {})}});
    child(parent, {{"name", name}, {"mesh", mesh}});
  }
}

void GlbWriter::channel(size_t target, const char* path, size_t times, size_t values, const char* interpolation) {
  json& animations = file_.root()["animations"];
  if (animations.empty()) animations.push_back({{"name", "frames"}});
  json& samplers = animations[0]["samplers"];
  samplers.push_back({{"input", times}, {"output", values}, {"interpolation", interpolation}});
  animations[0]["channels"].push_back(
      {{"sampler", samplers.size() - 1}, {"target", {{"node", target}, {"path", path}}}});
}

// Stores positions and rotations where they change; an absent object gets size 0.
void GlbWriter::animate(size_t target, const NodeTrack& track) {
  if (!all_times_) all_times_ = file_.add_times(times_s_);
  std::vector<float> times_s;
  std::vector<glm::vec3> positions, scales;
  std::vector<glm::vec4> rotations;
  glm::dquat last(1, 0, 0, 0);
  for (size_t i = 0; i < track.keys.size(); ++i) {
    const auto& key = track.keys[i];
    scales.emplace_back(key ? 1.0f : 0.0f);
    if (!key) continue;
    // Turns the shorter way round.
    const glm::dquat q = glm::dot(key->rotation, last) < 0 ? -key->rotation : key->rotation;
    times_s.push_back(times_s_[i]);
    positions.emplace_back(key->position_m - world_.scene.origin_m);
    rotations.emplace_back(q.x, q.y, q.z, q.w);
    last = q;
  }
  const auto moves = [](const auto& values) {
    return std::ranges::adjacent_find(values, std::not_equal_to<>()) != values.end();
  };
  const bool gaps = !track.always_present();
  if (moves(positions) || moves(rotations)) {
    const size_t times = gaps ? file_.add_times(times_s) : *all_times_;
    if (moves(positions)) channel(target, "translation", times, file_.add_translations(positions), "LINEAR");
    if (moves(rotations)) channel(target, "rotation", times, file_.add_rotations(rotations), "LINEAR");
  }
  if (gaps) channel(target, "scale", *all_times_, file_.add_translations(scales), "STEP");
}

void GlbWriter::add_moving(size_t parent, const std::string& name, const NodeTrack& track, std::optional<size_t> mesh) {
  if (!track.ever_present()) return;
  const auto& key = *std::ranges::find_if(track.keys, [](const auto& k) { return k.has_value(); });
  const glm::dvec3 p = key->position_m - world_.scene.origin_m;
  const glm::dquat& q = key->rotation;
  json element{{"name", name}, {"translation", {p.x, p.y, p.z}}, {"rotation", {q.x, q.y, q.z, q.w}}};
  if (mesh) element["mesh"] = *mesh;
  if (!track.keys.front()) element["scale"] = {0, 0, 0};
  const size_t index = child(parent, std::move(element));
  if (track.keys.size() > 1) animate(index, track);
}

void GlbWriter::add_vehicles(const std::vector<NodeTrack>& tracks) {
  if (tracks.empty()) return;
  const size_t parent = child(root_, {{"name", "vehicles"}});
  std::vector<std::optional<size_t>> mesh_of(world_.models.size());
  for (size_t i = 0; i < tracks.size(); ++i) {
    const uint32_t m = world_.instance_model[i];
    std::optional<size_t> mesh;
    if (m != no_instance && !world_.models[m].triangles.empty() && tracks[i].ever_present()) {
      const Scene& model = world_.models[m];
      std::vector<uint32_t> all(model.triangles.size());
      for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
      if (!mesh_of[m])
        mesh_of[m] = file_.add("meshes", {{"name", std::filesystem::path(model.file).stem().string()},
                                          {"primitives", primitives(model, std::move(all), model.origin_m)}});
      mesh = mesh_of[m];
    }
    add_moving(parent, run_.instances()[i].id, tracks[i], mesh);
  }
}

size_t GlbWriter::line_mesh(const char* name, const GlbLines& lines) {
  const json primitive{
      {"attributes",
       {{"POSITION", file_.add_positions(lines.positions)}, {"COLOR_0", file_.add_colours(lines.colours)}}},
      {"indices", file_.add_indices(lines.legs)},
      {"material", line_material()},
      {"mode", 1}};
  return file_.add("meshes", {{"name", name}, {"primitives", {primitive}}});
}

void GlbWriter::add_ends(const std::vector<NodeTrack>& transmitters, const std::vector<NodeTrack>& receivers) {
  const auto add = [this](const char* kind, GlbFile::Colour colour, const auto& ends, const auto& tracks) {
    if (tracks.empty()) return;
    const size_t parent = child(root_, {{"name", kind}}), mesh = line_mesh(kind, marker_lines(colour));
    for (size_t i = 0; i < tracks.size(); ++i) add_moving(parent, ends[i].name, tracks[i], mesh);
  };
  add("transmitters", {255, 26, 43, 255}, run_.transmitters(), transmitters);
  add("receivers", {26, 163, 255, 255}, run_.receivers(), receivers);
}

void GlbWriter::add_paths(const SavedFrame& frame, Warnings& warnings) {
  GainScale scale;
  scale.add(frame.paths);
  json extras{{"frame", frame.number}, {"time_s", frame.time_s}, {"paths", frame.paths.size()}};
  if (!scale.empty()) {
    extras["brightest_db"] = scale.strongest_db();
    extras["darkest_db"] = scale.weakest_db();
  }
  const size_t parent = child(root_, {{"name", "paths"}, {"extras", std::move(extras)}});
  size_t left_out = 0;
  const GlbLines lines = path_lines(frame, scale, world_.scene.origin_m, left_out);
  if (left_out > 0)
    warnings.push_back(fmt::format("glb: {} paths with points that are not finite are left out", left_out));
  if (!lines.legs.empty()) node(parent)["mesh"] = line_mesh("paths", lines);
}

void GlbWriter::add_rays(const WaypointRows& rays) {
  const GlbLines lines = ray_lines(rays, world_.scene.origin_m);
  const size_t parent = child(root_, {{"name", "rays"}, {"extras", {{"segments", lines.legs.size() / 2}}}});
  if (!lines.legs.empty()) node(parent)["mesh"] = line_mesh("rays", lines);
}

}  // namespace

Written export_glb(const SavedRun& run, const ExportOptions& options, Warnings& warnings) {
  const SavedWorld world = load_saved_world(run);
  warnings.insert(warnings.end(), world.warnings.begin(), world.warnings.end());
  const SavedFrame first = run.frame(options.first_row);
  const NodeTracks tracks(run, options, first);
  GlbWriter writer(run, world);
  writer.set_times(tracks.times_s);
  writer.add_scene();
  writer.add_vegetation();
  writer.add_vehicles(tracks.vehicles);
  writer.add_paths(first, warnings);
  if (const std::optional<SavedWaypoints> waypoints = saved_waypoints(run))
    writer.add_rays(waypoints->frame(first.number));
  writer.add_ends(tracks.transmitters, tracks.receivers);
  writer.write(options.output);
  return {options.output};
}

}  // namespace wavetracer
