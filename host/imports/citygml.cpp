// SPDX-License-Identifier: Apache-2.0
// Reads CityGML 1.0 and 2.0 (OGC 12-019) by pugixml: buildings and bridges with their parts, surfaces and fittings. The
// text is not trusted: pugixml neither recurses nor expands entities, and targets of xlinks are read once.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <set>
#include <unordered_map>

#include "imports/city_model.hpp"
#include "imports/map.hpp"
#include "imports/source_system.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

// Without the prefix of the namespace.
std::string_view local_name(const char* name) {
  const std::string_view text = name;
  return text.substr(text.find(':') + 1);  // npos + 1 is 0
}
std::string_view local_name(const pugi::xml_node node) { return local_name(node.name()); }

std::string_view attribute_of(const pugi::xml_node node, std::string_view local) {
  for (const pugi::xml_attribute attribute : node.attributes())
    if (local_name(attribute.name()) == local) return attribute.value();
  return {};
}

pugi::xml_node child_of(const pugi::xml_node node, std::string_view local) {
  for (const pugi::xml_node child : node.children())
    if (local_name(child) == local) return child;
  return {};
}

// Returns 2 for "lod2Solid"; -1 for a name without a level.
int lod_of(std::string_view local) {
  return local.size() > 4 && local.starts_with("lod") && local[3] >= '0' && local[3] <= '4' ? local[3] - '0' : -1;
}

class CityGmlReader {
 public:
  CityGmlReader(std::string_view content, const std::string& name, const ImportOptions& options)
      : content_(content), name_(name), limit_(lod_limit(options.lod)) {}

  CityModel read() {
    const pugi::xml_parse_result result = document_.load_buffer(content_.data(), content_.size());
    if (!result)
      throw InputError(fmt::format("{}: not well-formed XML: {}; is the file whole?",
                                   line_of(content_, result.offset, name_), result.description()));
    const pugi::xml_node root = document_.document_element();
    check_version(root);
    index(root);
    for (const pugi::xml_node member : root.children()) {
      const std::string_view kind = local_name(member);
      if (kind != "cityObjectMember" && kind != "featureMember" && kind != "featureMembers") continue;
      if (!member.first_child() && !attribute_of(member, "href").empty()) ++model_.left_out["object in another file"];
      for (const pugi::xml_node object : member.children())
        if (object.type() == pugi::node_element && is_built(local_name(object), model_)) {
          add_family(object);
        }
    }
    return std::move(model_);
  }

 private:
  [[noreturn]] void fail(const pugi::xml_node node, const std::string& what) const {
    throw InputError(
        fmt::format("{}: <{}>: {}", line_of(content_, node.offset_debug(), name_), printable(node.name()), what));
  }

  void check_version(const pugi::xml_node root) const {
    for (const pugi::xml_attribute attribute : root.attributes())
      if (std::string_view(attribute.value()).starts_with("http://www.opengis.net/citygml/3.0"))
        fail(root, "this is CityGML 3.0, but 1.0 and 2.0 are read: convert it, as with `citygml-tools to-cityjson`");
  }

  // Indexes all ids, and finds the one coordinate system of the file.
  void index(const pugi::xml_node root) {
    struct Walker : pugi::xml_tree_walker {
      CityGmlReader* reader = nullptr;
      bool for_each(pugi::xml_node& node) override {
        for (const pugi::xml_attribute attribute : node.attributes()) {
          const std::string_view kind = attribute.name();
          if (local_name(attribute.name()) == "id") reader->ids_.try_emplace(attribute.value(), node);
          if (kind == "srsName") reader->take_system(node, attribute.value());
        }
        return true;
      }
    } walker;
    walker.reader = this;
    pugi::xml_node(root).traverse(walker);
  }

  void take_system(const pugi::xml_node node, const std::string& system) {
    if (system == model_.system) return;
    if (model_.system.empty()) {
      model_.system = system;
    } else if (system_code(system) != system_code(model_.system)) {
      fail(node, fmt::format("srsName is '{}', but that of the file is '{}': bring all to one coordinate system",
                             printable(system), printable(model_.system)));
    }
  }

  // Adds a building with all its parts. Solids are read after all surfaces with a role, since they link to those.
  void add_family(const pugi::xml_node node) {
    taken_.clear();
    family_.clear();
    add(node, no_parent, 0);
    for (Member& member : family_) read_bounds(member);
    for (Member& member : family_) read_geometries(member.node, Role::unknown, member);
    for (const Member& member : family_)
      if (model_.objects[member.place].faces.empty() && member.above)
        ++model_.left_out["object that has more detail than --lod asks for, and no less"];
  }

  void add(const pugi::xml_node node, size_t parent, int depth) {
    constexpr int deepest = 8;
    if (depth > deepest) fail(node, "is a part of a part without end");
    const size_t place = model_.objects.size();
    const std::string_view type = local_name(node);
    const std::string_view id = attribute_of(node, "id");
    model_.objects.push_back(
        {id.empty() ? fmt::format("{} {}", type, place + 1) : std::string(id), parent, type.ends_with("Part"), {}});
    family_.push_back({node, place, false});
    for (const pugi::xml_node child : node.children()) {
      const std::string_view kind = local_name(child);
      if (kind.starts_with("consistsOf") || kind.starts_with("outer")) {
        for (const pugi::xml_node object : child.children())
          if (object.type() == pugi::node_element && is_built(local_name(object), model_))
            add(object, place, depth + 1);
      } else if (kind.starts_with("interior")) {
        ++model_.left_out["room or fitting inside of a building"];
      }
    }
  }

  struct Member {
    pugi::xml_node node;
    size_t place;  // index in the model
    bool above;    // it has more detail than was asked for
  };

  // Reads surfaces with a role, and their openings. Those that are left out are marked too, so that a solid that links
  // to them does not bring them back.
  void read_bounds(Member& member) {
    for (const pugi::xml_node bound : member.node.children()) {
      if (local_name(bound) != "boundedBy") continue;
      for (const pugi::xml_node surface : bound.children()) {
        const std::string_view kind = local_name(surface);
        if (surface.type() != pugi::node_element || kind == "Envelope" || kind == "Null") continue;
        read_geometries(surface, role_of(kind, model_), member);
        for (const pugi::xml_node opening : surface.children())
          if (local_name(opening) == "opening")
            for (const pugi::xml_node window : opening.children())
              if (window.type() == pugi::node_element)
                read_geometries(window, role_of(local_name(window), model_), member);
      }
    }
  }

  void read_geometries(const pugi::xml_node node, std::optional<Role> role, Member& member) {
    for (const pugi::xml_node property : node.children()) {
      const std::string_view kind = local_name(property);
      const int lod = lod_of(kind);
      if (lod < 1 || kind.ends_with("TerrainIntersection") || kind.ends_with("MultiCurve")) continue;
      if (kind.ends_with("ImplicitRepresentation")) {
        ++model_.left_out["copy of a template"];
      } else if (lod >= limit_) {
        member.above = true;
      } else {
        std::vector<ModelFace> faces;
        collect(property, {role, lod, false, &faces}, 0);
        if (!role || faces.empty()) continue;
        std::ranges::move(faces, std::back_inserter(model_.objects[member.place].faces[lod]));
      }
    }
  }

  struct Collecting {
    std::optional<Role> role;
    int lod;
    bool turned;  // turned by an OrientableSurface
    std::vector<ModelFace>* faces;
  };

  // Collects all polygons below an element or its link targets that were not collected for this building before.
  void collect(const pugi::xml_node node, Collecting what, int depth) {
    constexpr int deepest = 40;
    if (node.type() != pugi::node_element || !taken_.insert({what.lod, node.internal_object()}).second) return;
    if (depth > deepest) fail(node, "surfaces within surfaces without end");
    const std::string_view kind = local_name(node);
    if (kind == "Polygon" || kind == "PolygonPatch" || kind == "Triangle" || kind == "Rectangle")
      return take_polygon(node, what);
    if (kind == "interior") return void(++model_.left_out["cavity inside of a solid"]);
    if (kind == "OrientableSurface" && attribute_of(node, "orientation") == "-") what.turned = !what.turned;
    if (const std::string_view link = attribute_of(node, "href"); !link.empty()) follow(node, link, what, depth);
    for (const pugi::xml_node child : node.children()) collect(child, what, depth + 1);
  }

  void follow(const pugi::xml_node node, std::string_view link, const Collecting& what, int depth) {
    if (!link.starts_with("#")) return void(++model_.left_out["surface in another file"]);
    const auto found = ids_.find(link.substr(1));
    if (found == ids_.end())
      fail(node, fmt::format("xlink:href=\"{}\" leads nowhere: the file has no such gml:id", printable(link)));
    collect(found->second, what, depth + 1);
  }

  void take_polygon(const pugi::xml_node polygon, const Collecting& what) {
    ModelFace face{what.role.value_or(Role::unknown), {}};
    for (const pugi::xml_node boundary : polygon.children()) {
      const std::string_view kind = local_name(boundary);
      const bool outer = kind == "exterior" || kind == "outerBoundaryIs";
      if (!outer && kind != "interior" && kind != "innerBoundaryIs") continue;
      for (const pugi::xml_node ring : boundary.children()) {
        if (local_name(ring) != "LinearRing") continue;
        SpaceRing points = ring_of(ring);
        if (what.turned) std::ranges::reverse(points);
        face.rings.insert(outer ? face.rings.begin() : face.rings.end(), std::move(points));
      }
    }
    what.faces->push_back(std::move(face));
  }

  SpaceRing ring_of(const pugi::xml_node ring) const {
    SpaceRing out;
    for (const pugi::xml_node child : ring.children()) {
      const std::string_view kind = local_name(child);
      if (kind == "posList" || kind == "pos" || kind == "coordinates") {
        add_points(child, out);
      } else if (kind == "pointProperty" || kind == "pointRep") {
        add_points(child_of(child_of(child, "Point"), "pos"), out);
      }
    }
    return out;
  }

  // Reads numbers separated by blanks or, in <coordinates>, by commas: three for each point.
  void add_points(const pugi::xml_node list, SpaceRing& out) const {
    if (attribute_of(list, "srsDimension") == "2")
      fail(list, "its points have no heights, but those of a building need some");
    glm::dvec3 point(0);
    int k = 0;
    for (const pugi::xml_node piece : list.children()) {  // there are several if a comment lies between them
      if (piece.type() != pugi::node_pcdata && piece.type() != pugi::node_cdata) continue;
      constexpr std::string_view between = " \t\r\n,";
      const std::string_view text = piece.value();
      for (size_t begin = text.find_first_not_of(between); begin != text.npos;) {
        const size_t end = std::min(text.find_first_of(between, begin), text.size());
        point[k] = coordinate(text.substr(begin, end - begin), list);
        begin = text.find_first_not_of(between, end);
        if (++k < 3) continue;
        out.push_back(point);
        k = 0;
      }
    }
    if (k != 0) fail(list, "the number of its coordinates is not a multiple of three");
  }

  double coordinate(std::string_view text, const pugi::xml_node list) const {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + (text.starts_with('+') ? 1 : 0), end, value);
    if (error != std::errc() || stop != end || !(std::abs(value) < 1e9))
      fail(list, fmt::format("'{}' is not a coordinate", printable(text)));
    return value;
  }

  std::string_view content_;
  std::string name_;
  double limit_;
  pugi::xml_document document_;
  std::unordered_map<std::string_view, pugi::xml_node> ids_;
  std::set<std::pair<int, const void*>> taken_;  // elements of the current building that were read, with their level
  std::vector<Member> family_;                   // its members
  CityModel model_;
};

}  // namespace

bool is_citygml(std::string_view first_bytes) {
  const std::string_view root = root_element(first_bytes);
  return root.substr(root.find(':') + 1) == "CityModel";
}

CityModel read_citygml(std::string_view content, const std::string& name, const ImportOptions& options) {
  return CityGmlReader(content, name, options).read();
}

}  // namespace wavetracer::imports
