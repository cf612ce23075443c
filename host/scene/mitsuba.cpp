// SPDX-License-Identifier: Apache-2.0
// Mitsuba 3 XML: shapes of type ply, obj, rectangle, cube, merge, shapegroup and instance with to_world.
#include "scene/mitsuba.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "base/input_file.hpp"
#include "scene/mitsuba_files.hpp"
#include "scene/mitsuba_materials.hpp"
#include "scene/mitsuba_properties.hpp"
#include "scene/model.hpp"
#include "scene/ply.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// The properties that shapes of a type may have. Normals and texture coordinates only matter for light: a surface is
// the same from both sides. The last five are those of Mitsuba 0.6.
const std::vector<std::string>* properties_of(std::string_view type) {
  static const std::vector<std::string> mesh = {
      "filename",       "to_world", "face_normals", "flip_normals",     "flip_tex_coords",
      "vertex_normals", "collapse", "srgb",         "max_smooth_angle", "silhouette_sampling_weight"};
  static const std::vector<std::string> plain = {"to_world", "flip_normals", "silhouette_sampling_weight"};
  static const std::vector<std::string> placed = {"to_world"}, none;
  if (type == "ply" || type == "obj") return &mesh;
  if (type == "rectangle" || type == "cube") return &plain;
  if (type == "instance") return &placed;
  if (type == "shapegroup" || type == "merge") return &none;
  return nullptr;
}

// The basic shapes of Mitsuba: a square with sides of two units on z = 0, and a cube with sides of two units.
RawMesh rectangle() {
  RawMesh out;
  out.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  out.triangles = {{0, 1, 2}, {0, 2, 3}};
  return out;
}

RawMesh cube() {
  RawMesh out;
  for (uint32_t i = 0; i < 8; ++i)
    out.vertices.emplace_back((i & 1u) != 0 ? 1 : -1, (i & 2u) != 0 ? 1 : -1, (i & 4u) != 0 ? 1 : -1);
  out.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return out;
}

class MitsubaReader {
 public:
  explicit MitsubaReader(const std::filesystem::path& path) : files_(path) {
    raw_.file = path.string();
    raw_.files = files_.names();
  }

  RawScene read() {
    MitsubaMaterials materials(files_, raw_);
    materials_ = &materials;
    for (const pugi::xml_node node : files_.elements())  // groups are read before instances, which may point forward
      if (is_group(node)) add_group(node);
    for (const pugi::xml_node node : files_.elements()) add_element(node);
    return std::move(raw_);
  }

 private:
  bool is_group(pugi::xml_node node) const {
    return std::string_view(node.name()) == "shape" && files_.attribute(node, "type") == "shapegroup";
  }

  void add_element(pugi::xml_node node) {
    // Elements that make no surface, and elements that only appear inside others.
    static const std::set<std::string_view> skipped = {"bsdf",   "integrator", "sensor", "emitter",
                                                       "medium", "texture",    "film",   "alias"};
    static const std::set<std::string_view> misplaced = {"volume", "phase", "sampler", "rfilter", "ref"};
    const std::string_view tag = node.name();
    if (tag == "shape") {
      if (!is_group(node)) add_meshes(read_shape(node));
    } else if (misplaced.contains(tag) || is_mitsuba_property(node)) {
      raw_.warnings.push_back(fmt::format("{}: <{}> is not used here and was skipped", files_.where(node), tag));
    } else if (!skipped.contains(tag)) {
      files_.fail(node, ": Mitsuba has no such element; correct its name, or remove it");
    }
  }

  void add_meshes(std::vector<RawMesh> meshes) {
    std::move(meshes.begin(), meshes.end(), std::back_inserter(raw_.meshes));
  }

  void add_group(pugi::xml_node node) {
    const std::string id = files_.attribute(node, "id");
    check_shape(node, "shapegroup", {"shape"});
    check_no_instance(node);
    std::vector<RawMesh> meshes = read_parts(node);
    if (!groups_.try_emplace(id, std::move(meshes)).second)
      files_.fail(node, ": another shapegroup of this file has this id; keep one");
  }

  // Groups of instances of groups would grow as a power of the length of the file. Mitsuba refuses them, too.
  void check_no_instance(pugi::xml_node shape) const {
    for (const pugi::xml_node child : shape.children("shape")) {
      if (files_.attribute(child, "type") == "instance")
        files_.fail(child, ": an instance must not be part of a shapegroup; put the shapes of its group there");
      check_no_instance(child);
    }
  }

  void check_shape(pugi::xml_node shape, std::string_view type, const std::vector<std::string_view>& objects) const {
    files_.check_attributes(shape, {"type", "id", "name"});
    check_properties(files_, shape, *properties_of(type), objects);
  }

  std::vector<RawMesh> read_shape(pugi::xml_node shape) {
    const std::string type = files_.attribute(shape, "type");
    if (properties_of(type) == nullptr)
      files_.fail(shape, ": shapes of this type are not supported; export the shape as a mesh (ply or obj)");
    if (type == "shapegroup") files_.fail(shape, ": a shapegroup must be an element of <scene>");
    if (type == "merge") {
      check_shape(shape, type, {"shape"});
      return read_parts(shape);
    }
    if (type == "instance") return read_instance(shape);
    check_shape(shape, type, {"bsdf", "ref", "emitter", "sensor", "medium", "texture", "subsurface"});
    return read_mesh(shape, type);
  }

  std::vector<RawMesh> read_parts(pugi::xml_node shape) {
    std::vector<RawMesh> out;
    for (const pugi::xml_node child : shape.children("shape")) {
      std::vector<RawMesh> part = read_shape(child);
      std::move(part.begin(), part.end(), std::back_inserter(out));
    }
    return out;
  }

  std::vector<RawMesh> read_instance(pugi::xml_node shape) {
    check_shape(shape, "instance", {"ref"});
    const pugi::xml_node ref = shape.child("ref");
    const auto group = groups_.find(files_.attribute(ref, "id"));
    if (!ref || group == groups_.end() || ref.next_sibling("ref"))
      files_.fail(shape, " needs one <ref id=\"...\"/> to a shape of type shapegroup");
    std::vector<RawMesh> out = group->second;
    move(shape, out);
    return out;
  }

  void move(pugi::xml_node shape, std::vector<RawMesh>& meshes) const {
    const pugi::xml_node node = mitsuba_property(files_, shape, "to_world", {"transform"});
    if (!node) return;
    const glm::dmat4 to_world = read_transform(node, files_);
    for (RawMesh& mesh : meshes) {
      for (glm::dvec3& v : mesh.vertices) v = glm::dvec3(to_world * glm::dvec4(v, 1));
      mesh.rounding *= largest_stretch(to_world);
    }
  }

  std::vector<RawMesh> read_mesh(pugi::xml_node shape, const std::string& type) {
    const bool of_file = type == "ply" || type == "obj";
    std::string name = files_.attribute(shape, "id");
    if (name.starts_with("mesh-")) name.erase(0, 5);  // Sionna RT names its objects like this
    std::filesystem::path file;
    if (of_file) file = file_of(shape);
    if (name.empty()) name = of_file ? file.stem().string() : type;
    const uint32_t material = materials_->of_shape(shape, name);
    std::vector<RawMesh> out = of_file ? meshes_of_file(file, type) : std::vector<RawMesh>(1);
    if (!of_file) {
      out[0] = type == "cube" ? cube() : rectangle();
      out[0].where = files_.where(shape);
    }
    for (RawMesh& mesh : out) {
      mesh.name = name;
      mesh.material = material;
    }
    move(shape, out);
    return out;
  }

  std::filesystem::path file_of(pugi::xml_node shape) const {
    const pugi::xml_node node = mitsuba_property(files_, shape, "filename", {"string"});
    if (node) files_.check_attributes(node, {"name", "value"});
    const std::string filename = files_.attribute(node, "value");
    if (filename.empty()) files_.fail(shape, " needs <string name=\"filename\" value=\"...\"/>");
    std::filesystem::path file = files_.find(shape, filename);
    if (const std::string problem = input_file_problem(file, "the mesh"); !problem.empty())
      files_.fail(shape, fmt::format(": {}: {}", file.string(), problem));
    return file;
  }

  // Returns the meshes of a file. From the second use on its meshes are kept, since more shapes may use them.
  std::vector<RawMesh> meshes_of_file(const std::filesystem::path& file, const std::string& type) {
    MeshFile& known = mesh_files_[{file.string(), type}];
    if (++known.uses > 2) return known.meshes;
    RawScene read = type == "obj" ? read_model(file, ModelFormat::obj) : ply_scene(file);
    if (known.uses == 1) {
      std::ranges::move(read.warnings, std::back_inserter(raw_.warnings));
      std::ranges::move(read.files, std::back_inserter(raw_.files));
    } else {
      known.meshes = read.meshes;
    }
    return std::move(read.meshes);
  }

  static RawScene ply_scene(const std::filesystem::path& file) {
    PlyMesh ply = read_ply(file);
    RawScene out;
    out.files.push_back(file.string());
    out.warnings = std::move(ply.warnings);
    RawMesh& mesh = out.meshes.emplace_back();
    mesh.where = file.string();
    mesh.vertices = std::move(ply.vertices);
    mesh.triangles = std::move(ply.triangles);
    mesh.rounding = ply.rounding;
    return out;
  }

  struct MeshFile {
    uint64_t uses = 0;
    std::vector<RawMesh> meshes = {};  // filled from the second use on
  };

  MitsubaFiles files_;
  RawScene raw_;
  MitsubaMaterials* materials_ = nullptr;
  std::map<std::string, std::vector<RawMesh>> groups_;
  std::map<std::pair<std::string, std::string>, MeshFile> mesh_files_;  // keys are name and type
};

}  // namespace

RawScene read_mitsuba(const std::filesystem::path& path) { return MitsubaReader(path).read(); }

}  // namespace wavetracer
