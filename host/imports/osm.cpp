// SPDX-License-Identifier: Apache-2.0
// Reads buildings of OpenStreetMap files, XML or PBF, by libosmium, whose assembler makes areas of ways and
// multipolygons. Objects may come in any order and in several versions; the last counts. The file bounds the memory.
#include <fmt/format.h>

#include <algorithm>
#include <osmium/area/assembler.hpp>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/xml_input.hpp>
#include <set>

#include "imports/map.hpp"
#include "imports/osm_tags.hpp"
#include "imports/osm_text.hpp"
#include "imports/osm_versions.hpp"
#include "imports/projecting.hpp"
#include "imports/rings.hpp"
#include "imports/vegetation_tags.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

// The assembler compares each edge with all others beside it, so 10^6 corners would take days. The limits are the
// corners that a polygon may have (rings.hpp), several rings per multipolygon, and a few multipolygons per way.
constexpr size_t most_way_nodes = max_corners + 1, most_relation_nodes = 4 * max_corners, most_repeated = 4;
constexpr const char* too_many_corners = "more than 5000 corners";
constexpr const char* deleted_object = "deleted in the editor or in a later version (action='delete', visible='false')";

class OsmReader {
 public:
  OsmReader(std::string_view content, const std::string& name, bool vegetation)
      : content_(content),
        name_(name),
        is_pbf_(!content.starts_with('<') && root_element(content).empty()),
        vegetation_(vegetation) {}

  // Returns footprints in degrees (longitude, latitude); the caller projects them, since the middle is only known now.
  Map read() {
    if (!is_pbf_) {
      check_exponents(content_, name_);
      deleted_ = deleted_in_editor(content_);
    }
    read_entities(osmium::osm_entity_bits::relation,
                  [this](const osmium::OSMObject& object) { relation(static_cast<const osmium::Relation&>(object)); });
    keep_last_versions(relations_);
    for (const ObjectVersion& one : relations_)
      if (one.kept) take_members(kept_relations_.get<const osmium::Relation>(one.offset));
    read_entities(osmium::osm_entity_bits::node | osmium::osm_entity_bits::way, [this](osmium::OSMObject& object) {
      if (object.type() == osmium::item_type::node) return node(static_cast<const osmium::Node&>(object));
      way(static_cast<const osmium::Way&>(object));
    });
    places_.sort();
    keep_last_versions(ways_);
    for (const ObjectVersion& tree : trees_) plant_last(tree);
    for (const ObjectVersion& one : ways_)
      if (one.kept) locate(kept_ways_.get<osmium::Way>(one.offset));
    assemble_all<osmium::Relation>(relations_, kept_relations_);
    assemble_all<osmium::Way>(ways_, kept_ways_);
    return std::move(map_);
  }

 private:
  static constexpr auto growing = osmium::memory::Buffer::auto_grow::yes;

  template <class Visit>
  void read_entities(osmium::osm_entity_bits::type entities, const Visit& visit) {
    try {
      const osmium::io::File file(content_.data(), content_.size(), is_pbf_ ? "pbf" : "osm");
      osmium::io::Reader reader(file, entities);
      while (osmium::memory::Buffer buffer = reader.read()) {
        for (auto& object : buffer.select<osmium::OSMObject>()) visit(object);
      }
      reader.close();
    } catch (const Error&) {
      throw;
    } catch (const std::exception& e) {
      throw InputError(fmt::format("{}: cannot be read as a file of the format {}: {}", name_,
                                   is_pbf_ ? "OSM PBF" : "OSM XML", e.what()));
    }
  }

  // Notes a version of an object, and keeps it if something is built from it.
  template <class Object>
  void note(const Object& object, bool gone, bool wanted, bool built, osmium::memory::Buffer& kept,
            std::vector<ObjectVersion>& versions) {
    versions.push_back({object.id(), object.version(), wanted && !gone, built && gone, kept.committed()});
    if (!versions.back().kept) return;
    kept.add_item(object);
    kept.commit();
  }

  void node(const osmium::Node& node) {
    // Every node takes at least a byte, compressed ones perhaps half: more of them are an attack on memory.
    if (++nodes_ > 1000000 + 8 * content_.size()) {
      throw InputError(fmt::format("{}: the file contains far more nodes than its size allows: it is damaged", name_));
    }
    const bool gone = !node.visible() || deleted_.nodes.contains(node.id());
    places_.add(node.id(), node.version(), gone || !node.location().valid() ? osmium::Location() : node.location());
    if (gone || node.tags().empty()) return;
    check_tags(node);
    if (!is_tree(node.tags())) return;
    if (!node.location().valid()) return void(++map_.left_out["tree without a place"]);
    note(node, false, true, false, kept_trees_, trees_);
  }

  // Texts of PBF may contain zero bytes, which end a text for libosmium: a key would lose its value, and libosmium
  // would read beyond the object.
  void check_tags(const osmium::OSMObject& object) const {
    const osmium::TagList& tags = object.tags();
    const unsigned char* const bytes = tags.data();
    if (std::count(bytes + sizeof(osmium::TagList), bytes + tags.byte_size(), '\0') % 2 != 0) {
      throw InputError(fmt::format("{}: the tags of {} {} are damaged: they contain a zero byte", name_,
                                   osmium::item_type_to_name(object.type()), object.id()));
    }
  }

  void count_greenery(const osmium::OSMObject& object) {
    if (const std::string_view kind = left_out_greenery(object.tags(), vegetation_); !kind.empty())
      ++map_.left_out[std::string(kind)];
  }

  // Tells whether a closed way or a multipolygon with these tags is built.
  bool is_area(const osmium::TagList& tags) const { return is_building(tags) || (vegetation_ && is_wood(tags)); }

  void plant_last(const ObjectVersion& tree) {
    if (!places_.is_last(tree.id, tree.version) || !planted_.insert(tree.id).second) return;
    const auto& node = kept_trees_.get<const osmium::Node>(tree.offset);
    count_greenery(node);
    if (!vegetation_) return;
    plant({node.location().lon(), node.location().lat()}, fmt::format("node_{}", node.id()), node.tags());
  }

  // Adds a tree as the outline of its crown.
  void plant(const glm::dvec2& place_deg, const std::string& id, const osmium::TagList& tags) {
    Footprint footprint;
    footprint.id = id;
    set_tags(footprint, tags);
    footprint.tags["vegetation"] = is_row(tags) ? "row" : "tree";
    footprint.outer = crown_ring(place_deg, tree_size(footprint.tags).crown_m, MapUnit::degree);
    map_.footprints.push_back(std::move(footprint));
  }

  void plant_row(const osmium::Way& way) {
    std::vector<glm::dvec2> line_deg;
    for (const osmium::NodeRef& node : way.nodes())
      if (node.location().valid()) line_deg.emplace_back(node.lon(), node.lat());
    const std::vector<glm::dvec2> trees = planted(line_deg, MapUnit::degree);
    if (trees.size() > most_trees_of_row || (row_trees_ += trees.size()) > most_trees_of_rows)
      return void(++map_.left_out[too_many_trees]);
    size_t count = 0;
    for (const glm::dvec2& place_deg : trees) plant(place_deg, fmt::format("way_{}_{}", way.id(), ++count), way.tags());
  }

  void way(const osmium::Way& way) {
    const bool gone = !way.visible() || deleted_.ways.contains(way.id());
    check_tags(way);
    const bool built = is_area(way.tags()) || !greenery(way.tags()).empty();
    note(way, gone, built || member_ways_.contains(way.id()), built, kept_ways_, ways_);
    if (ways_.back().kept) way_nodes_ += way.nodes().size();
  }

  void relation(const osmium::Relation& relation) {
    const bool gone = !relation.visible() || deleted_.relations.contains(relation.id());
    check_tags(relation);
    const bool built = is_multipolygon(relation) || !greenery(relation.tags()).empty();
    note(relation, gone, built, built, kept_relations_, relations_);
  }

  // Tells whether an area is made of the relation.
  bool is_multipolygon(const osmium::Relation& relation) const {
    return relation.tags().has_tag("type", "multipolygon") && is_area(relation.tags());
  }

  void take_members(const osmium::Relation& relation) {
    if (!is_multipolygon(relation)) return;
    for (const auto& member : relation.members())
      if (member.type() == osmium::item_type::way) member_ways_.insert(member.ref());
  }

  void locate(osmium::Way& way) {
    for (osmium::NodeRef& node : way.nodes()) node.set_location(places_.place(node.ref()));
  }

  template <class Object>
  void assemble_all(const std::vector<ObjectVersion>& versions, const osmium::memory::Buffer& kept) {
    for (const ObjectVersion& one : versions) {
      if (one.kept) assemble(kept.get<const Object>(one.offset));
      if (one.deleted) ++map_.left_out[deleted_object];
    }
  }

  void assemble(const osmium::Way& way) {
    count_greenery(way);
    if (vegetation_ && is_row(way.tags())) return plant_row(way);
    if (!is_area(way.tags())) return;
    if (way.nodes().size() < 4 || !way.is_closed()) {
      if (!member_ways_.contains(way.id()))
        ++map_.left_out["way that is not closed, as if clipped at the border of an extract"];
      return;
    }
    if (way.nodes().size() > most_way_nodes) return void(++map_.left_out[too_many_corners]);
    build(way, "way", [&](osmium::area::Assembler& assembler, osmium::memory::Buffer& out) { assembler(way, out); });
  }

  void assemble(const osmium::Relation& relation) {
    count_greenery(relation);
    if (!is_multipolygon(relation)) return;
    std::vector<const osmium::Way*> members;
    size_t nodes = 0;
    for (const auto& member : relation.members()) {
      if (member.type() != osmium::item_type::way) continue;
      const auto found = std::ranges::lower_bound(ways_, member.ref(), {}, &ObjectVersion::id);
      if (found == ways_.end() || found->id != member.ref() || !found->kept) {
        ++map_.left_out["multipolygon with a missing way, as if clipped at the border of an extract"];
        return;
      }
      members.push_back(&kept_ways_.get<const osmium::Way>(found->offset));
      nodes += members.back()->nodes().size();
    }
    if (members.empty()) return;
    if (nodes > most_relation_nodes) return void(++map_.left_out[too_many_corners]);
    if ((member_nodes_ += nodes) > most_repeated * way_nodes_ + most_relation_nodes) {
      ++map_.left_out["multipolygon with ways that belong to too many others"];
      return;
    }
    build(relation, "relation",
          [&](osmium::area::Assembler& assembler, osmium::memory::Buffer& out) { assembler(relation, members, out); });
  }

  template <class Assemble>
  void build(const osmium::OSMObject& source, const char* kind, const Assemble& assemble) {
    constexpr osmium::object_id_type largest_id = osmium::object_id_type{1} << 61;  // the assembler doubles ids
    if (source.id() > largest_id || source.id() < -largest_id)
      return void(++map_.left_out["outline whose id is too large"]);
    osmium::memory::Buffer out(1024, growing);
    osmium::area::Assembler assembler(assembler_config_);
    assemble(assembler, out);
    bool any = false;
    for (const auto& area : out.select<osmium::Area>()) {
      size_t count = 0;
      for (const osmium::OuterRing& outer : area.outer_rings()) {
        Footprint footprint;
        footprint.id = fmt::format("{}_{}", kind, source.id());
        if (area.num_rings().first > 1) footprint.id += fmt::format("_{}", ++count);
        for (const osmium::NodeRef& node : outer) footprint.outer.push_back({node.lon(), node.lat()});
        for (const osmium::InnerRing& inner : area.inner_rings(outer)) {
          RingM& hole = footprint.holes.emplace_back();
          for (const osmium::NodeRef& node : inner) hole.push_back({node.lon(), node.lat()});
        }
        set_tags(footprint, source.tags());
        map_.footprints.push_back(std::move(footprint));
        any = true;
      }
    }
    if (any) return;
    ++map_.left_out[assembler.stats().invalid_locations > 0
                        ? "outline with a missing node, as if clipped at the border of an extract"
                        : "outline that crosses itself or does not close"];
  }

  static void set_tags(Footprint& footprint, const osmium::TagList& tags) {
    footprint.tags = kept_of(tags);
    footprint.name = tags.get_value_by_key("name", "");
    if (!is_building(tags) && is_wood(tags)) footprint.tags["vegetation"] = "wood";
  }

  std::string_view content_;
  const std::string& name_;
  bool is_pbf_, vegetation_;
  Map map_;
  size_t nodes_ = 0, row_trees_ = 0;
  size_t way_nodes_ = 0, member_nodes_ = 0;  // nodes of kept ways; nodes of multipolygons, counted for each of them
  const osmium::area::AssemblerConfig assembler_config_{};
  DeletedObjects deleted_;
  NodePlaces places_;
  std::set<osmium::object_id_type> member_ways_, planted_;
  osmium::memory::Buffer kept_trees_{1 << 16, growing}, kept_ways_{1 << 16, growing}, kept_relations_{1 << 16, growing};
  std::vector<ObjectVersion> trees_, ways_, relations_;
};

}  // namespace

bool is_osm(std::string_view first_bytes) {
  // A PBF file begins with the length of a BlobHeader, then its field 1, "OSMHeader".
  const std::string_view root = root_element(first_bytes);
  return root == "osm" || root == "osmChange" || first_bytes.substr(0, 15).ends_with("\x0a\x09OSMHeader");
}

Map read_osm(std::string_view content, const std::string& name, const ImportOptions& options) {
  Map map = OsmReader(content, name, options.vegetation).read();
  if (map.footprints.empty()) return map;
  map.rounding_m = 0.5e-7 * metres_per_degree;  // along the latitude: OpenStreetMap's coordinates have seven decimals
  project(map, name, options, fmt::format("osmium extract -b WEST,SOUTH,EAST,NORTH {} -o city.osm.pbf", name));
  map.georeference.attribution = osm_attribution;
  return map;
}

}  // namespace wavetracer::imports
