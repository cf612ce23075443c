// Buildings of OpenStreetMap files, XML or PBF, by libosmium; its assembler makes areas of ways and multipolygons.
// Objects may come in any order, as Overpass writes them. Memory is bounded by the size of the file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <osmium/area/assembler.hpp>
#include <osmium/index/map/sparse_mem_array.hpp>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/xml_input.hpp>
#include <set>

#include "imports/map.hpp"
#include "imports/projecting.hpp"
#include "imports/rings.hpp"
#include "imports/vegetation_tags.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

constexpr auto kept_tags = std::to_array<const char*>(
    {"building", "building:part", "height", "min_height", "building:levels", "building:min_level", "roof:levels",
     "roof:shape", "building:material", "roof:material", "location", "diameter_crown", "leaf_type"});

// The assembler compares each edge with all others beside it: 10^6 corners would take days. As many corners as a
// polygon may have (rings.hpp), and several rings in a multipolygon; each way in a few multipolygons.
constexpr size_t most_way_nodes = max_corners + 1, most_relation_nodes = 4 * max_corners, most_repeated = 4;
constexpr const char* too_many_corners = "more than 5000 corners";

bool is_yes(const osmium::TagList& tags, const char* key) {
  const char* const value = tags.get_value_by_key(key);
  return value && std::string_view(value) != "no";
}
bool is_tree(const osmium::TagList& tags) { return tags.has_tag("natural", "tree"); }
bool is_row(const osmium::TagList& tags) { return tags.has_tag("natural", "tree_row"); }
bool is_wood(const osmium::TagList& tags) {
  return tags.has_tag("natural", "wood") || tags.has_tag("landuse", "forest");
}
// What stands in the way of waves besides buildings, in words; empty: nothing of this kind. It is built if it is asked
// for (ImportOptions::vegetation).
std::string_view greenery(const osmium::TagList& tags) {
  if (is_tree(tags)) return "tree (natural=tree)";
  if (is_row(tags)) return "row of trees (natural=tree_row)";
  if (is_wood(tags)) return "forest (landuse=forest, natural=wood)";
  return {};
}
bool is_building(const osmium::TagList& tags) { return is_yes(tags, "building") || is_yes(tags, "building:part"); }

class OsmReader {
 public:
  OsmReader(std::string_view content, const std::string& name, bool vegetation)
      : content_(content),
        name_(name),
        is_pbf_(!content.starts_with('<') && root_element(content).empty()),
        vegetation_(vegetation) {}

  // Footprints in degrees (longitude, latitude): projected by the caller, who knows the middle only now.
  Map read() {
    read_entities(osmium::osm_entity_bits::relation,
                  [this](const osmium::OSMObject& object) { relation(static_cast<const osmium::Relation&>(object)); });
    read_entities(osmium::osm_entity_bits::node | osmium::osm_entity_bits::way, [this](osmium::OSMObject& object) {
      if (object.type() == osmium::item_type::node) {
        node(static_cast<const osmium::Node&>(object));
      } else {
        way(static_cast<const osmium::Way&>(object));
      }
    });
    locations_.sort();
    std::sort(ways_.begin(), ways_.end(), by_id);
    std::sort(relations_.begin(), relations_.end(), by_id);
    ways_.erase(std::unique(ways_.begin(), ways_.end(), same_id), ways_.end());
    relations_.erase(std::unique(relations_.begin(), relations_.end(), same_id), relations_.end());
    for (const Entry& entry : ways_) locate(kept_ways_.get<osmium::Way>(entry.offset));
    for (const Entry& entry : relations_) assemble(kept_relations_.get<osmium::Relation>(entry.offset));
    for (const Entry& entry : ways_) assemble(kept_ways_.get<osmium::Way>(entry.offset));
    return std::move(map_);
  }

 private:
  struct Entry {
    osmium::object_id_type id;
    size_t offset;  // into the buffer
  };
  static bool by_id(const Entry& a, const Entry& b) { return a.id < b.id; }
  static bool same_id(const Entry& a, const Entry& b) { return a.id == b.id; }
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

  void node(const osmium::Node& node) {
    // Every node takes a byte at least, compressed ones perhaps half of it: more of them are a trap for the memory.
    if (++nodes_ > 1000000 + 8 * content_.size()) {
      throw InputError(fmt::format("{}: the file contains far more nodes than its size allows: it is damaged", name_));
    }
    count_greenery(node);
    if (vegetation_ && node.visible() && node.location().valid() && is_tree(node.tags()))
      plant({node.location().lon(), node.location().lat()}, fmt::format("node_{}", node.id()), node.tags());
    if (node.visible() && node.location().valid()) locations_.set(index_id(node.id()), node.location());
  }

  // Texts of PBF may hold zero bytes, which end a text for libosmium: a key would be left without its value, and what
  // lies behind the object would be read instead.
  void check_tags(const osmium::OSMObject& object) const {
    const osmium::TagList& tags = object.tags();
    const unsigned char* const bytes = tags.data();
    if (std::count(bytes + sizeof(osmium::TagList), bytes + tags.byte_size(), '\0') % 2 != 0) {
      throw InputError(fmt::format("{}: the tags of {} {} are damaged: they contain a zero byte", name_,
                                   osmium::item_type_to_name(object.type()), object.id()));
    }
  }

  void count_greenery(const osmium::OSMObject& object) {
    if (!object.visible() || object.tags().empty()) return;
    check_tags(object);
    if (vegetation_) return;
    if (const std::string_view kind = greenery(object.tags()); !kind.empty()) ++map_.left_out[std::string(kind)];
  }

  // Whether a closed way or a multipolygon with these tags is built.
  bool is_area(const osmium::TagList& tags) const { return is_building(tags) || (vegetation_ && is_wood(tags)); }

  // A tree, as the outline of its crown.
  void plant(const glm::dvec2& place_deg, const std::string& id, const osmium::TagList& tags) {
    Footprint footprint;
    footprint.id = id;
    set_tags(footprint, tags);
    footprint.tags["vegetation"] = "tree";
    footprint.outer = crown_ring(place_deg, tree_size(footprint.tags).crown_m);
    map_.footprints.push_back(std::move(footprint));
  }

  void plant_row(const osmium::Way& way) {
    std::vector<glm::dvec2> line_deg;
    for (const osmium::NodeRef& node : way.nodes())
      if (node.location().valid()) line_deg.emplace_back(node.lon(), node.lat());
    const std::vector<glm::dvec2> trees = planted(line_deg);
    if (trees.size() > most_trees_of_row || (row_trees_ += trees.size()) > most_trees_of_rows)
      return void(++map_.left_out["row of more than 1000 trees, or beyond 200,000 trees in rows"]);
    size_t count = 0;
    for (const glm::dvec2& place_deg : trees) plant(place_deg, fmt::format("way_{}_{}", way.id(), ++count), way.tags());
  }

  void way(const osmium::Way& way) {
    check_tags(way);
    count_greenery(way);
    const bool building = is_area(way.tags()), row = vegetation_ && is_row(way.tags());
    if (!way.visible() || (!building && !row && !member_ways_.contains(way.id()))) return;
    if (building && (way.nodes().size() < 4 || !way.is_closed()) && !member_ways_.contains(way.id())) {
      ++map_.left_out["way that is not closed, as if clipped at the border of an extract"];
      return;
    }
    way_nodes_ += way.nodes().size();
    ways_.push_back({way.id(), kept_ways_.committed()});
    kept_ways_.add_item(way);
    kept_ways_.commit();
  }

  void relation(const osmium::Relation& relation) {
    check_tags(relation);
    count_greenery(relation);
    const char* const type = relation.tags().get_value_by_key("type");
    if (!relation.visible() || !type || std::string_view(type) != "multipolygon" || !is_area(relation.tags())) {
      return;
    }
    for (const auto& member : relation.members()) {
      if (member.type() == osmium::item_type::way) member_ways_.insert(member.ref());
    }
    relations_.push_back({relation.id(), kept_relations_.committed()});
    kept_relations_.add_item(relation);
    kept_relations_.commit();
  }

  void locate(osmium::Way& way) {
    for (osmium::NodeRef& node : way.nodes()) node.set_location(locations_.get_noexcept(index_id(node.ref())));
  }

  void assemble(const osmium::Way& way) {
    if (vegetation_ && is_row(way.tags())) return plant_row(way);
    if (!is_area(way.tags()) || way.nodes().size() < 4 || !way.is_closed()) return;
    if (way.nodes().size() > most_way_nodes) {
      ++map_.left_out[too_many_corners];
      return;
    }
    build(way, "way", [&](osmium::area::Assembler& assembler, osmium::memory::Buffer& out) { assembler(way, out); });
  }

  void assemble(const osmium::Relation& relation) {
    std::vector<const osmium::Way*> members;
    size_t nodes = 0;
    for (const auto& member : relation.members()) {
      if (member.type() != osmium::item_type::way) continue;
      const auto found = std::lower_bound(ways_.begin(), ways_.end(), Entry{member.ref(), 0}, by_id);
      if (found == ways_.end() || found->id != member.ref()) {
        ++map_.left_out["multipolygon with a missing way, as if clipped at the border of an extract"];
        return;
      }
      members.push_back(&kept_ways_.get<const osmium::Way>(found->offset));
      nodes += members.back()->nodes().size();
    }
    if (members.empty()) return;
    if (nodes > most_relation_nodes) {
      ++map_.left_out[too_many_corners];
      return;
    }
    if ((member_nodes_ += nodes) > most_repeated * way_nodes_ + most_relation_nodes) {
      ++map_.left_out["multipolygon with ways that belong to too many others"];
      return;
    }
    build(relation, "relation",
          [&](osmium::area::Assembler& assembler, osmium::memory::Buffer& out) { assembler(relation, members, out); });
  }

  template <class Assemble>
  void build(const osmium::OSMObject& source, const char* kind, const Assemble& assemble) {
    osmium::memory::Buffer out(1024, growing);
    osmium::area::Assembler assembler(assembler_config_);
    assemble(assembler, out);
    bool any = false;
    for (const auto& area : out.select<osmium::Area>()) {
      const bool many = area.num_rings().first > 1;
      size_t count = 0;
      for (const osmium::OuterRing& outer : area.outer_rings()) {
        Footprint footprint;
        footprint.id = fmt::format("{}_{}", kind, source.id());
        if (many) footprint.id += fmt::format("_{}", ++count);
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
    for (const char* key : kept_tags) {
      if (const char* const value = tags.get_value_by_key(key)) footprint.tags[key] = value;
    }
    footprint.name = tags.get_value_by_key("name", "");
    if (!is_building(tags) && is_wood(tags)) footprint.tags["vegetation"] = "wood";
  }

  static osmium::unsigned_object_id_type index_id(osmium::object_id_type id) {
    return static_cast<osmium::unsigned_object_id_type>(id);
  }

  std::string_view content_;
  const std::string& name_;
  bool is_pbf_, vegetation_;
  Map map_;
  size_t nodes_ = 0, row_trees_ = 0;
  size_t way_nodes_ = 0, member_nodes_ = 0;  // of the ways that are kept; of multipolygons so far, each time anew
  const osmium::area::AssemblerConfig assembler_config_{};
  osmium::index::map::SparseMemArray<osmium::unsigned_object_id_type, osmium::Location> locations_;
  std::set<osmium::object_id_type> member_ways_;
  osmium::memory::Buffer kept_ways_{1 << 16, growing}, kept_relations_{1 << 16, growing};
  std::vector<Entry> ways_, relations_;
};

}  // namespace

bool is_osm(std::string_view first_bytes) {
  // PBF: the length of a BlobHeader, then its field 1, "OSMHeader".
  return root_element(first_bytes) == "osm" || first_bytes.substr(0, 15).ends_with("\x0a\x09OSMHeader");
}

Map read_osm(std::string_view content, const std::string& name, const ImportOptions& options) {
  Map map = OsmReader(content, name, options.vegetation).read();
  if (map.footprints.empty()) return map;
  project(map, name, options, fmt::format("osmium extract -b WEST,SOUTH,EAST,NORTH {} -o city.osm.pbf", name));
  map.georeference.attribution = osm_attribution;
  return map;
}

}  // namespace wavetracer::imports
