// Mitsuba 3 XML: shapes of type ply and obj with to_world, bsdfs by reference or inline, <default> parameters.
// Radio bsdfs are those of Sionna RT 1.x (itu-radio-material, radio-material); of any other bsdf only the outermost id
// counts.
#include "scene/mitsuba.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <string_view>

#include "base/file.hpp"
#include "base/input_file.hpp"
#include "scene/mitsuba_transform.hpp"
#include "scene/model.hpp"
#include "scene/ply.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

class MitsubaReader {
 public:
  explicit MitsubaReader(const std::filesystem::path& path) : path_(path), text_(read_file(path)) {
    raw_.file = path.string();
    raw_.files = {raw_.file};
  }

  RawScene read() {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text_.data(), text_.size());
    if (!parsed) {
      throw InputError(fmt::format("{}: not well-formed XML: {}", position(parsed.offset), parsed.description()));
    }
    const pugi::xml_node scene = document.document_element();
    if (const std::string_view root = scene.name(); root == "osm" || root == "additional" || root == "polygons") {
      throw InputError(
          fmt::format("{}: the root element is <{}>: this is a map; `wavetracer convert {} -o FOLDER` converts it to a "
                      "scene, FOLDER/city.xml",
                      where(scene), scene.name(), path_.string()));
    }
    if (std::string_view(scene.name()) != "scene") {
      throw InputError(fmt::format("{}: the root element is <{}>, but that of a Mitsuba scene is <scene>", where(scene),
                                   scene.name()));
    }
    for (const pugi::xml_node node : scene.children("default"))
      defaults_[attribute(node, "name")] = attribute(node, "value");
    for (const pugi::xml_node node : scene.children("bsdf")) {  // before the shapes: references may point forward
      const uint32_t index = add_material(node, "");
      material_of_[raw_.materials[index].name] = index;
    }
    for (const pugi::xml_node node : scene.children()) {
      static const std::set<std::string_view> skipped = {"default", "bsdf",   "integrator", "sensor",
                                                         "emitter", "medium", "texture",    "film"};
      if (node.type() != pugi::node_element) continue;
      const std::string_view tag = node.name();
      if (tag == "shape") {
        add_shape(node);
      } else if (tag == "include") {
        throw InputError(fmt::format("{}: <include> is not supported: put its content into this file", where(node)));
      } else if (!skipped.contains(tag)) {
        raw_.warnings.push_back(fmt::format("{}: <{}> is unknown and was skipped", where(node), tag));
      }
    }
    return std::move(raw_);
  }

 private:
  std::string position(std::ptrdiff_t offset) const {
    const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
    return fmt::format("{}:{}", raw_.file, 1 + std::count(text_.begin(), end, '\n'));
  }
  std::string where(const pugi::xml_node node) const { return position(node.offset_debug()); }

  // "<shape type="ply" id="mesh-floor">", for messages.
  static std::string describe(const pugi::xml_node node) {
    std::string out = fmt::format("<{}", node.name());
    for (const char* key : {"type", "id"}) {
      if (const auto a = node.attribute(key)) out += fmt::format(" {}=\"{}\"", key, a.value());
    }
    return out + ">";
  }

  // An attribute with its $parameters replaced; the empty string where it is absent.
  std::string attribute(const pugi::xml_node node, const char* name) const {
    std::string value = node.attribute(name).value();
    const size_t at = value.find('$');
    if (at == std::string::npos) return value;
    // The longest parameter wins, as $resx before $res.
    const std::pair<const std::string, std::string>* best = nullptr;
    for (const auto& entry : defaults_) {
      if (value.compare(at + 1, entry.first.size(), entry.first) != 0) continue;
      if (!best || entry.first.size() > best->first.size()) best = &entry;
    }
    if (!best) {
      throw InputError(
          fmt::format("{}: {}: the parameter '{}' has no <default>", where(node), describe(node), value.substr(at)));
    }
    return value.replace(at, best->first.size() + 1, best->second);
  }

  // The child <tag name="name">, or an empty node.
  static pugi::xml_node property(const pugi::xml_node node, const char* tag, std::string_view name) {
    for (const pugi::xml_node child : node.children(tag)) {
      if (child.attribute("name").value() == name) return child;
    }
    return {};
  }

  std::optional<double> number(const pugi::xml_node node, std::string_view name, double least, bool infinite) const {
    pugi::xml_node child = property(node, "float", name);
    if (!child) child = property(node, "integer", name);
    if (!child) return std::nullopt;
    const std::string text = attribute(child, "value");
    const size_t last = text.find_last_not_of(" \t\r\n") + 1;  // 0 where there are blanks alone, or nothing
    const size_t first = std::min(text.find_first_not_of(" \t\r\n"), last);
    const char* const end = text.data() + last;
    double value = 0;
    const auto [stop, error] = std::from_chars(text.data() + first, end, value);
    if (error != std::errc() || stop != end || !(value >= least) || (!infinite && std::isinf(value))) {
      throw InputError(fmt::format("{}: {}: {} = '{}' must be a number of at least {}", where(child), describe(node),
                                   name, text, least));
    }
    return value;
  }

  // Index into raw_.materials. fallback names a material without an id.
  uint32_t add_material(const pugi::xml_node node, const std::string& fallback) {
    const auto is_radio = [](const pugi::xml_node n) {
      const std::string_view type = n.attribute("type").value();
      return type == "itu-radio-material" || type == "radio-material";
    };
    pugi::xml_node core = node;
    while (!is_radio(core) && core.child("bsdf")) core = core.child("bsdf");
    RawMaterial material;
    material.name = attribute(node, "id");
    material.where = where(node);
    if (is_radio(core)) read_radio(core, material);
    if (material.name.empty()) material.name = material.itu_type.value_or(fallback);
    raw_.materials.push_back(std::move(material));
    return static_cast<uint32_t>(raw_.materials.size() - 1);
  }

  void read_radio(const pugi::xml_node node, RawMaterial& material) {
    constexpr double thinnest_m = 1e-9;  // zero would make a slab that is not there
    material.thickness_m = number(node, "thickness", thinnest_m, true);
    if (number(node, "scattering_coefficient", 0, false).value_or(0) > 0) {
      raw_.warnings.push_back(fmt::format("{}: {}: scattering_coefficient is not used", where(node), describe(node)));
    }
    if (std::string_view(node.attribute("type").value()) == "itu-radio-material") {
      material.itu_type = attribute(property(node, "string", "type"), "value");
      if (material.itu_type->empty()) {
        throw InputError(
            fmt::format("{}: {} needs <string name=\"type\" value=\"concrete\"/>", where(node), describe(node)));
      }
    } else {  // Sionna RT's defaults are those of vacuum
      material.permittivity = number(node, "relative_permittivity", 1, false).value_or(1);
      material.conductivity_s_m = number(node, "conductivity", 0, false).value_or(0);
    }
  }

  uint32_t material_of(const pugi::xml_node shape, const std::string& name) {
    for (const pugi::xml_node child : shape.children()) {
      const std::string_view tag = child.name(), role = child.attribute("name").value();
      if (tag == "bsdf") return add_material(child, name);
      if (tag == "ref" && (role == "bsdf" || role.empty())) {
        const std::string id = attribute(child, "id");
        const auto found = material_of_.find(id);
        if (found != material_of_.end()) return found->second;
        throw InputError(fmt::format("{}: {} refers to the material '{}', but no <bsdf> of this file defines it",
                                     where(child), describe(shape), id));
      }
    }
    return no_material;
  }

  void add_shape(const pugi::xml_node shape) {
    const std::string type = attribute(shape, "type");
    if (type != "ply" && type != "obj") {
      throw InputError(
          fmt::format("{}: {}: shapes of this type are not supported; export the shape as a mesh (ply or obj)",
                      where(shape), describe(shape)));
    }
    const std::string filename = attribute(property(shape, "string", "filename"), "value");
    if (filename.empty()) {
      throw InputError(
          fmt::format("{}: {} needs <string name=\"filename\" value=\"...\"/>", where(shape), describe(shape)));
    }
    const std::filesystem::path file = path_.parent_path() / filename;
    std::error_code unnameable;  // such as a name that is too long
    if (!std::filesystem::exists(file, unnameable)) {
      throw InputError(fmt::format("{}: {}: there is no file {}", where(shape), describe(shape), file.string()));
    }
    if (const std::string problem = input_file_problem(file, "the mesh"); !problem.empty()) {
      throw InputError(fmt::format("{}: {}: {}: {}", where(shape), describe(shape), file.string(), problem));
    }
    std::string name = attribute(shape, "id");
    if (name.starts_with("mesh-")) name.erase(0, 5);  // as Sionna RT names its objects
    if (name.empty()) name = std::filesystem::path(filename).stem().string();
    std::optional<glm::dmat4> to_world;
    if (const pugi::xml_node node = property(shape, "transform", "to_world")) {
      to_world = read_transform(
          node, [this](pugi::xml_node n, const char* key) { return attribute(n, key); },
          [this](pugi::xml_node n) { return where(n); });
    }
    const uint32_t material = material_of(shape, name);
    for (RawMesh& mesh : read_meshes(file, type)) {
      mesh.name = name;
      mesh.material = material;
      if (to_world) {
        for (glm::dvec3& v : mesh.vertices) v = glm::dvec3(*to_world * glm::dvec4(v, 1));
      }
      raw_.meshes.push_back(std::move(mesh));
    }
  }

  std::vector<RawMesh> read_meshes(const std::filesystem::path& file, const std::string& type) {
    if (type == "obj") {
      RawScene model = read_model(file, ModelFormat::obj);
      std::move(model.warnings.begin(), model.warnings.end(), std::back_inserter(raw_.warnings));
      std::move(model.files.begin(), model.files.end(), std::back_inserter(raw_.files));
      return std::move(model.meshes);
    }
    PlyMesh ply = read_ply(file);
    raw_.files.push_back(file.string());
    if (ply.small_faces > 0) {
      raw_.warnings.push_back(
          fmt::format("{}: {} faces of fewer than three vertices were left out", file.string(), ply.small_faces));
    }
    std::vector<RawMesh> out(1);
    out[0].where = file.string();
    out[0].vertices = std::move(ply.vertices);
    out[0].triangles = std::move(ply.triangles);
    return out;
  }

  std::filesystem::path path_;
  std::string text_;
  RawScene raw_;
  std::map<std::string, std::string> defaults_;
  std::map<std::string, uint32_t> material_of_;  // id -> index into raw_.materials
};

}  // namespace

RawScene read_mitsuba(const std::filesystem::path& path) { return MitsubaReader(path).read(); }

}  // namespace wavetracer
