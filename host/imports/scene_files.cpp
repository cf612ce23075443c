// SPDX-License-Identifier: Apache-2.0
// Makes prisms: a floor, walls around every ring, a roof; vertices are shared, so that every edge has two faces.
// Names of objects are those of the map, as far as Mitsuba's ids allow.
#include "imports/scene_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "base/file.hpp"
#include "base/pending_folder.hpp"
#include "imports/wall_classes.hpp"
#include "scene/ply.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

constexpr size_t longest_name = 80;  // bytes

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u; }

// Tells whether the text is UTF-8 as XML requires it; overlong forms and surrogates are not detected.
bool is_utf8(std::string_view text) {
  for (size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    const size_t more = c < 0x80                ? 0
                        : c >= 0xC2 && c < 0xE0 ? 1
                        : c >= 0xE0 && c < 0xF0 ? 2
                        : c >= 0xF0 && c < 0xF5 ? 3
                                                : 9;
    if (more == 9 || i + more >= text.size()) return false;
    for (size_t k = 1; k <= more; ++k) {
      if (!is_continuation(text[i + k])) return false;
    }
    i += more + 1;
  }
  return true;
}

std::vector<glm::dvec3> corners(const Solid& solid) {
  std::vector<glm::dvec3> out;
  const double bottom = solid.shape.bottom_m > 0 ? solid.shape.bottom_m : -foundation_m;
  for (const double z : {solid.base_m + bottom, solid.base_m + solid.shape.top_m}) {
    const auto add = [&](const Ring& ring) {
      for (const Point& p : ring) {
        out.emplace_back(static_cast<double>(p.x) / grid_per_m, static_cast<double>(p.y) / grid_per_m, z);
      }
    };
    add(solid.polygon.outer);
    for (const Ring& hole : solid.polygon.holes) add(hole);
  }
  return out;
}

SceneMesh flat_ground(const Extent& extent, const ImportOptions& options) {
  const auto [x0, y0] = std::pair(extent.lower_m.x, extent.lower_m.y);
  const auto [x1, y1] = std::pair(extent.upper_m.x, extent.upper_m.y);
  return {"ground",
          "ground",
          options.ground_material,
          {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}},
          {{0, 1, 2}, {0, 2, 3}}};
}

void append(pugi::xml_node parent, const char* tag, const char* name, const std::string& value) {
  pugi::xml_node node = parent.append_child(tag);
  node.append_attribute("name") = name;
  node.append_attribute("value") = value.c_str();
}

std::string bsdf_id(const std::string& material) {
  return (find_wall_class(material) ? "mat-" : "mat-itu_") + material;
}

// Writes georeference.json, or removes that of an earlier import if this import has none.
void write_reference(const std::filesystem::path& folder, const Georeference& georeference) {
  const std::filesystem::path file = folder / "georeference.json";
  std::error_code error;
  if (georeference.projection.empty()) {
    std::filesystem::remove(file, error);
  } else {
    write_georeference(file, georeference);
  }
}

}  // namespace

// Ids of Mitsuba must not contain dots, and $ starts a parameter.
std::string object_name(const std::string& id, const std::string& text) {
  if (text.empty() || !is_utf8(text)) return id;
  std::string name = text;
  for (char& c : name) {
    if (c == '.' || c == '$' || (static_cast<unsigned char>(c) < ' ') || c == 0x7F) c = '_';
  }
  if (name.size() > longest_name) {
    size_t end = longest_name;
    while (end > 0 && is_continuation(name[end])) --end;
    name.resize(end);
  }
  return id + " " + name;
}

std::vector<SceneMesh> extrude(const Solid& solid) {
  SceneMesh walls{solid.id, object_name(solid.id, solid.name), solid.shape.walls, corners(solid), {}};
  const auto top = static_cast<uint32_t>(walls.vertices.size() / 2);
  uint32_t first = 0;
  const auto wall_ring = [&](const Ring& ring) {
    const auto size = static_cast<uint32_t>(ring.size());
    for (uint32_t i = 0; i < size; ++i) {
      const uint32_t p = first + i, q = first + (i + 1) % size;  // seen from p to q, the solid is on the left
      walls.triangles.push_back({p, q, q + top});
      walls.triangles.push_back({p, q + top, p + top});
    }
    first += size;
  };
  wall_ring(solid.polygon.outer);
  for (const Ring& hole : solid.polygon.holes) wall_ring(hole);
  for (const Triangle& t : solid.triangles) walls.triangles.push_back({t[0], t[2], t[1]});
  if (solid.shape.walls == solid.shape.roof) {
    for (const Triangle& t : solid.triangles) walls.triangles.push_back({t[0] + top, t[1] + top, t[2] + top});
    return {std::move(walls)};
  }
  SceneMesh roof{walls.file + "_roof", walls.name + " roof", solid.shape.roof, {}, solid.triangles};
  roof.vertices.assign(walls.vertices.begin() + top, walls.vertices.end());
  return {std::move(walls), std::move(roof)};
}

Extent ground_extent(const Plan& plan, const ImportOptions& options) {
  if (!options.ground || plan.solids.empty()) return {};
  Extent out = plan.traffic;
  for (const Solid& solid : plan.solids)
    for (const Point& p : solid.polygon.outer)
      out.add({static_cast<double>(p.x) / grid_per_m, static_cast<double>(p.y) / grid_per_m});
  out.lower_m -= options.margin_m;
  out.upper_m += options.margin_m;
  return out;
}

std::vector<SceneMesh> build_ground(const Extent& extent, const Terrain* terrain, const ImportOptions& options) {
  if (terrain) return {{"ground", "ground", options.ground_material, terrain->vertices, terrain->triangles}};
  if (extent.empty()) return {};
  return {flat_ground(extent, options)};
}

std::vector<SceneMesh> build_scene(const Plan& plan, const Terrain* terrain, const ImportOptions& options) {
  std::vector<SceneMesh> out = build_ground(ground_extent(plan, options), terrain, options);
  for (const Solid& solid : plan.solids) {
    for (SceneMesh& mesh : extrude(solid)) out.push_back(std::move(mesh));
  }
  return out;
}

void write_scene(const std::vector<SceneMesh>& meshes, const Georeference& georeference, const ImportOptions& options) {
  const std::filesystem::path& folder = options.output;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw RuntimeError(fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
  PendingFolder files(folder / "meshes", PendingFolder::Earlier::kept);
  pugi::xml_document document;
  if (const std::string& attribution = georeference.attribution; !attribution.empty())
    document.append_child(pugi::node_comment).set_value((" Map data: " + attribution + " ").c_str());
  pugi::xml_node scene = document.append_child("scene");
  scene.append_attribute("version") = "2.1.0";
  std::set<std::string> materials;
  for (const SceneMesh& mesh : meshes) materials.insert(mesh.material);
  for (const std::string& material : materials) {
    const WallClass* const wall = find_wall_class(material);
    pugi::xml_node bsdf = scene.append_child("bsdf");
    bsdf.append_attribute("type") = "itu-radio-material";
    bsdf.append_attribute("id") = bsdf_id(material).c_str();
    append(bsdf, "string", "type", wall ? wall->itu : material);
    append(bsdf, "float", "thickness", wall ? fmt::format("{}", wall->thickness_m) : "0.1");
  }
  uint64_t written = 0;
  for (const SceneMesh& mesh : meshes) {
    if (options.at) options.at(written++, meshes.size());
    const std::string file = mesh.file + ".ply";
    files.append(file, format_ply(mesh.vertices, mesh.triangles));
    pugi::xml_node shape = scene.append_child("shape");
    shape.append_attribute("type") = "ply";
    shape.append_attribute("id") = ("mesh-" + mesh.name).c_str();
    append(shape, "string", "filename", "meshes/" + file);
    append(shape, "boolean", "face_normals", "true");
    pugi::xml_node reference = shape.append_child("ref");
    reference.append_attribute("id") = bsdf_id(mesh.material).c_str();
    reference.append_attribute("name") = "bsdf";
  }
  files.commit();
  write_reference(folder, georeference);
  std::ostringstream text;
  document.save(text, "  ");
  write_file(folder / "city.xml", text.str());
}

}  // namespace wavetracer::imports
