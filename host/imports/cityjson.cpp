// SPDX-License-Identifier: Apache-2.0
// Reads CityJSON 1.0, 1.1 and 2.0 (https://www.cityjson.org/specs/2.0.1/) by nlohmann's parser.
// The text is not trusted: the parser does not recurse, and every index and number is checked.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "imports/city_model.hpp"
#include "imports/map.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

using Json = nlohmann::json;

const Json no_json;  // null

// Returns a member, or null if it is missing or `json` is no object.
const Json& member(const Json& json, const char* key) {
  if (!json.is_object()) return no_json;
  const auto found = json.find(key);
  return found == json.end() ? no_json : *found;
}

const Json& element(const Json& json, size_t i) { return json.is_array() && i < json.size() ? json[i] : no_json; }

std::string text_at(const Json& json, const char* key) {
  const Json& value = member(json, key);
  return value.is_string() ? value.get<std::string>() : std::string();
}

class CityJsonReader {
 public:
  CityJsonReader(std::string_view content, const std::string& name, const ImportOptions& options)
      : name_(name), limit_(lod_limit(options.lod)), root_(parsed(content)) {}

  CityModel read() {
    check_version();
    read_vertices();
    read_system();
    const Json& objects = member(root_, "CityObjects");
    if (!objects.is_object()) fail("CityObjects", "must be an object of city objects");
    for (const auto& [id, object] : objects.items()) add(id, object, 0);
    return std::move(model_);
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& what) const {
    throw InputError(fmt::format("{}: {}: {}", name_, place, what));
  }

  Json parsed(std::string_view content) const {
    if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
    try {
      return Json::parse(content);
    } catch (const Json::parse_error& error) {
      std::string hint = "is the file whole?";
      const std::string_view rest = content.substr(std::min(error.byte, content.size()));
      if (content.find("\"CityJSONFeature\"") != content.npos || rest.find("\"CityJSON\"") != rest.npos)
        hint = "a sequence of CityJSON features (.jsonl) must be made one CityJSON file first, as by cjseq collect";
      throw InputError(
          fmt::format("{}: not well-formed JSON; {}",
                      line_of(content, static_cast<std::ptrdiff_t>(error.byte > 0 ? error.byte - 1 : 0), name_), hint));
    } catch (const Json::out_of_range&) {
      throw InputError(fmt::format("{}: holds a number that is too large to be one", name_));
    }
  }

  void check_version() const {
    if (text_at(root_, "type") != "CityJSON")
      fail("type", "is not \"CityJSON\": give a CityJSON file of one city, not a feature of one");
    const std::string version = text_at(root_, "version");
    if (!version.starts_with("1.0") && !version.starts_with("1.1") && !version.starts_with("2.0"))
      fail("version", fmt::format("is '{}', but 1.0, 1.1 and 2.0 are read: bring the file up to date "
                                  "with `cjio OLD upgrade save NEW`",
                                  printable(version)));
  }

  // Returns three finite numbers.
  static std::optional<glm::dvec3> numbers(const Json& json) {
    if (!json.is_array() || json.size() != 3) return {};
    glm::dvec3 out;
    for (int k = 0; k < 3; ++k) {
      const Json& value = json[static_cast<size_t>(k)];
      if (!value.is_number() || !std::isfinite(out[k] = value.get<double>())) return {};
    }
    return out;
  }

  void read_vertices() {
    glm::dvec3 scale(1), translate(0);
    if (const Json& transform = member(root_, "transform"); !transform.is_null()) {
      const auto scales = numbers(member(transform, "scale")), translates = numbers(member(transform, "translate"));
      if (!scales || !translates) fail("transform", "scale and translate must be three numbers each");
      if (scales->x == 0 || scales->y == 0 || scales->z == 0)
        fail("transform/scale", "holds a zero, which makes all coordinates one: write the file again with more digits");
      scale = *scales;
      translate = *translates;
    }
    const Json& vertices = member(root_, "vertices");
    if (!vertices.is_array()) fail("vertices", "must be a list of points");
    vertices_.reserve(vertices.size());
    for (const Json& vertex : vertices) {
      const auto v = numbers(vertex);
      if (!v) fail(fmt::format("vertices/{}", vertices_.size()), "must be three numbers");
      vertices_.push_back(translate + scale * *v);
      if (!(glm::length(vertices_.back()) < 1e9))
        fail(fmt::format("vertices/{}", vertices_.size() - 1), "is out of all bounds after its transform");
    }
  }

  void read_system() {
    const Json& metadata = member(root_, "metadata");
    model_.system = text_at(metadata, "referenceSystem");
  }

  // Returns the index of the object in the model, or no_parent if it is not built. Parents come first.
  size_t add(const std::string& id, const Json& object, int depth) {
    constexpr int deepest = 8;
    if (const auto known = places_.find(id); known != places_.end()) return known->second;
    const std::string place = fmt::format("CityObjects/{}", printable(id));
    if (!object.is_object()) fail(place, "must be an object");
    if (depth > deepest) fail(place, "its parents have parents without end");
    const std::string type = text_at(object, "type");
    if (!is_built(type, model_)) return places_[id] = no_parent;
    ModelObject out;
    out.id = id;
    out.part = type == "BuildingPart" || type == "BridgePart";
    if (const Json& parent = element(member(object, "parents"), 0); parent.is_string()) {
      const auto parent_id = parent.get<std::string>();
      const Json& found = member(member(root_, "CityObjects"), parent_id.c_str());
      if (found.is_null()) fail(place, fmt::format("its parent '{}' is not in the file", printable(parent_id)));
      out.parent = add(parent_id, found, depth + 1);
    }
    const Json& geometry = member(object, "geometry");
    size_t count = 0;
    bool above = false;
    for (const Json& one : geometry)
      above = read_geometry(one, fmt::format("{}/geometry/{}", place, count++), out) || above;
    if (out.faces.empty() && above) ++model_.left_out["object that has more detail than --lod asks for, and no less"];
    places_[id] = model_.objects.size();
    model_.objects.push_back(std::move(out));
    return model_.objects.size() - 1;
  }

  // Returns true if the geometry has a level of detail that was not asked for but is available with another --lod.
  bool read_geometry(const Json& geometry, const std::string& place, ModelObject& out) {
    const std::string type = text_at(geometry, "type");
    const Json& boundaries = member(geometry, "boundaries");
    const bool surfaces = type == "MultiSurface" || type == "CompositeSurface", solid = type == "Solid";
    const bool solids = type == "MultiSolid" || type == "CompositeSolid";
    if (!surfaces && !solid && !solids) {
      ++model_.left_out[type == "GeometryInstance" ? "copy of a template" : "geometry without surfaces"];
      return false;
    }
    const double lod = level(member(geometry, "lod"), place);
    if (lod < 1) return false;
    if (lod >= limit_) return true;
    const Json& semantics = member(geometry, "semantics");
    const Json& values = member(semantics, "values");
    surface_types_ = &member(semantics, "surfaces");
    faces_ = &out.faces[lod];
    if (surfaces) {
      read_shell(boundaries, values, place);
    } else if (solid) {
      read_solid(boundaries, values, place);
    } else {
      if (!boundaries.is_array()) fail(place, "boundaries must be a list of solids");
      for (size_t i = 0; i < boundaries.size(); ++i) read_solid(boundaries[i], element(values, i), place);
    }
    if (faces_->empty()) out.faces.erase(lod);
    return false;
  }

  double level(const Json& lod, const std::string& place) const {
    double value = NAN;
    if (lod.is_number()) value = lod.get<double>();
    if (lod.is_string()) {
      const auto text = lod.get<std::string>();
      if (text.size() <= 3 && text.find_first_not_of("0123456789.") == text.npos && !text.empty() && text[0] != '.')
        value = std::atof(text.c_str());
    }
    if (!(value >= 0 && value < 10)) fail(place, "lod must be a level of detail, such as \"1\" or \"2.2\"");
    return value;
  }

  void read_solid(const Json& shells, const Json& values, const std::string& place) {
    if (!shells.is_array()) fail(place, "boundaries of a solid must be a list of shells");
    if (shells.size() > 1) model_.left_out["cavity inside of a solid"] += shells.size() - 1;
    if (!shells.empty()) read_shell(shells[0], element(values, 0), place);
  }

  void read_shell(const Json& surfaces, const Json& values, const std::string& place) {
    if (!surfaces.is_array()) fail(place, "boundaries must be a list of surfaces");
    for (size_t i = 0; i < surfaces.size(); ++i) {
      std::optional<Role> role = Role::unknown;
      if (const Json& value = element(values, i); value.is_number_unsigned()) {
        const Json& semantic = element(*surface_types_, value.get<size_t>());
        if (semantic.is_null())
          fail(place, fmt::format("semantics/values names surface {}, of which there is none", value.get<size_t>()));
        role = role_of(text_at(semantic, "type"), model_);
      }
      if (role) faces_->push_back({*role, rings(surfaces[i], place)});
    }
  }

  std::vector<SpaceRing> rings(const Json& surface, const std::string& place) const {
    if (!surface.is_array()) fail(place, "a surface must be a list of rings");
    std::vector<SpaceRing> out;
    for (const Json& ring : surface) {
      if (!ring.is_array()) fail(place, "a ring must be a list of numbers of vertices");
      SpaceRing& points = out.emplace_back();
      for (const Json& index : ring) {
        if (!index.is_number_unsigned() || index.get<uint64_t>() >= vertices_.size())
          fail(place, fmt::format("names vertex {}, but they are 0 to {}",
                                  index.is_number() ? index.dump() : fmt::format("of the type {}", index.type_name()),
                                  static_cast<int64_t>(vertices_.size()) - 1));
        points.push_back(vertices_[index.get<size_t>()]);
      }
    }
    return out;
  }

  std::string name_;
  double limit_;
  Json root_;
  CityModel model_;
  std::vector<glm::dvec3> vertices_;
  std::unordered_map<std::string, size_t> places_;
  const Json* surface_types_ = nullptr;      // types of the current geometry's surfaces
  std::vector<ModelFace>* faces_ = nullptr;  // faces of the current geometry
};

}  // namespace

bool is_cityjson(std::string_view first_bytes) {
  if (first_bytes.starts_with("\xEF\xBB\xBF")) first_bytes.remove_prefix(3);
  const size_t begin = first_bytes.find_first_not_of(" \t\r\n");
  return begin != first_bytes.npos && first_bytes[begin] == '{' &&
         (first_bytes.find("\"CityJSON") != first_bytes.npos ||
          first_bytes.find("\"CityObjects\"") != first_bytes.npos);
}

CityModel read_cityjson(std::string_view content, const std::string& name, const ImportOptions& options) {
  return CityJsonReader(content, name, options).read();
}

}  // namespace wavetracer::imports
