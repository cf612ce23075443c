// SPDX-License-Identifier: Apache-2.0
// Chooses the reader of a file, and applies the units and axes of the configuration.
// The content counts before the suffix, so a renamed file loads, and a wrong file is named correctly in the message.
#include "scene/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <glm/common.hpp>
#include <limits>

#include "base/input_file.hpp"
#include "scene/build_scene.hpp"
#include "scene/city.hpp"
#include "scene/free_ends.hpp"
#include "scene/georeference.hpp"
#include "scene/mitsuba.hpp"
#include "scene/model.hpp"
#include "scene/ply.hpp"
#include "scene/volumes.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

RawScene read_single_ply(const std::filesystem::path& path) {
  PlyMesh ply = read_ply(path);
  RawScene raw;
  raw.file = path.string();
  raw.files = {raw.file};
  raw.warnings = std::move(ply.warnings);
  raw.meshes.push_back(
      {path.stem().string(), raw.file, std::move(ply.vertices), std::move(ply.triangles), no_material, ply.rounding});
  return raw;
}

std::string first_bytes(const std::filesystem::path& path) {
  check_input_file(path, "the scene file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: cannot be opened; check its permissions", path.string()));
  std::string head(256, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(in.gcount()));
  if (head.empty()) throw InputError(fmt::format("{}: the file is empty", path.string()));
  return head;
}

RawScene read_raw(const std::filesystem::path& path) {
  const std::string head = first_bytes(path);
  if (head.starts_with("version https://git-lfs")) {
    throw InputError(
        fmt::format("{}: is a Git LFS pointer, not the file itself; fetch it with 'git lfs pull'", path.string()));
  }
  std::string_view text = head;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // skips a byte order mark
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (text.starts_with('<') || suffix == ".xml") return read_mitsuba(path);
  if (text.starts_with("ply\n") || text.starts_with("ply\r") || suffix == ".ply") return read_single_ply(path);
  if (text.starts_with("glTF") || suffix == ".glb" || suffix == ".gltf" || suffix == ".obj") {
    const ModelFormat format = model_format(path);
    RawScene raw = read_model(path, format);
    raw.y_up = format == ModelFormat::gltf;  // glTF 2.0, section 3.4
    return raw;
  }
  if (head.substr(0, 15).ends_with("\x0a\x09OSMHeader") || path.string().ends_with(".osm.pbf"))
    throw InputError(
        fmt::format("{0}: this is a map of OpenStreetMap; `wavetracer convert {0} -o FOLDER` converts it to a scene, "
                    "FOLDER/city.xml",
                    path.string()));
  throw InputError(fmt::format(
      "{}: the file format is unknown; supported formats: Mitsuba XML, PLY, OBJ, glTF (.gltf, .glb)", path.string()));
}

// A file that gives the scene's place on the Earth counts as one of the scene's files.
RawScene read_with_georeference(const std::filesystem::path& path) {
  RawScene raw = read_raw(path);
  if (const std::filesystem::path place = georeference_file(path); !place.empty()) raw.files.push_back(place.string());
  return raw;
}

// Converts file units and axes to metres with z up.
void apply_units(RawScene& raw, const SceneConfig& config) {
  if (!(config.scale > 0) || !std::isfinite(config.scale)) {
    throw ConfigError(fmt::format("scene.scale = {}: must be a positive number of metres per file unit", config.scale));
  }
  const bool y_up = config.up == "y" || (config.up == "auto" && raw.y_up);
  const auto convert = [&](glm::dvec3& v) {
    if (y_up) v = {v.x, -v.z, v.y};
    v *= config.scale;
  };
  for (RawMesh& mesh : raw.meshes) {
    std::ranges::for_each(mesh.vertices, convert);
    mesh.rounding *= config.scale;
  }
  for (SceneNode& node : raw.nodes) convert(node.position_m);
}

// An error of 1/32 wavelength changes the phase of a reflection by at most 22 degrees. Welding moves vertices by up to
// a millimetre anyway, and more than two millimetres may be a kerb. Small models have small details.
double plane_tolerance_m(const RawScene& raw, const SceneConfig& config, double frequency_hz) {
  constexpr double speed_of_light_m_s = 299792458, most_of_extent = 1e-3;
  if (config.plane_tolerance_m) return *config.plane_tolerance_m;
  glm::dvec3 lower(std::numeric_limits<double>::max()), upper(-lower);
  for (const RawMesh& mesh : raw.meshes) {
    for (const glm::dvec3& v : mesh.vertices) {
      lower = glm::min(lower, v);
      upper = glm::max(upper, v);
    }
  }
  const glm::dvec3 size = upper - lower;
  return std::min(std::clamp(speed_of_light_m_s / frequency_hz / 32, 1e-3, 2e-3),
                  most_of_extent * std::max({size.x, size.y, size.z, 0.0}));
}

Scene finish(RawScene raw, const SceneConfig& scene, const std::vector<MaterialConfig>& materials, double frequency_hz,
             EdgeSearch edges) {
  apply_units(raw, scene);
  ResolvedMaterials resolved = resolve_materials(raw, scene, materials, frequency_hz);
  return build_scene(raw, std::move(resolved), edges, plane_tolerance_m(raw, scene, frequency_hz));
}

}  // namespace

Scene load_scene(const Config& config) {
  const SceneConfig& scene = config.scene;
  if (scene.file.empty() == scene.generate.empty()) {
    throw ConfigError(scene.file.empty()
                          ? "no scene: set scene.file to a file, or scene.generate to options of 'scene city'"
                          : "both scene.file and scene.generate are set: keep one");
  }
  const EdgeSearch edges = config.trace.diffraction ? EdgeSearch::of_scene : EdgeSearch::none;
  RawScene raw =
      scene.file.empty() ? generate_city(parse_city_options(scene.generate)) : read_with_georeference(scene.file);
  add_volumes(raw, config.vegetation);
  Scene out = finish(std::move(raw), scene, config.materials, config.radio.frequency_hz, edges);
  if (config.trace.diffraction && config.trace.edge_ends) mark_free_ends(out);
  return out;
}

Scene load_scene_file(const std::filesystem::path& path, const SceneConfig& scene,
                      const std::vector<MaterialConfig>& materials, double frequency_hz, EdgeSearch edges) {
  return finish(read_with_georeference(path), scene, materials, frequency_hz, edges);
}

}  // namespace wavetracer
