// SPDX-License-Identifier: Apache-2.0
// Reads footprints and trees of GeoPackage, Shapefile, GeoJSON, FlatGeobuf and any other format of GDAL, through the
// maps module. Fields become the tags of OpenStreetMap that building_tags.hpp reads, so that one place makes heights of
// them.
#include "imports/map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "imports/mapped_trees.hpp"
#include "imports/maps_module.hpp"
#include "imports/projecting.hpp"
#include "imports/rings.hpp"
#include "imports/straight_walls.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

constexpr const char* advice = "ogr2ogr -spat WEST SOUTH EAST NORTH city.gpkg MAP";

// A field that may hold a tag; if several fields give one tag, the first that is set counts.
struct TagField {
  std::string field;
  const char* tag;
};

// The tag of a height that counts for trees alone, since --levels gives those of buildings.
constexpr const char* tree_height = "tree:height";

std::vector<TagField> tag_fields(const ImportOptions& options) {
  std::vector<TagField> out;
  const auto add = [&](const std::string& given, const char* tag, std::initializer_list<const char*> usual) {
    if (!given.empty()) return out.push_back({given, tag});
    for (const char* name : usual) out.push_back({name, tag});
  };
  const bool any = !options.height_field.empty() || !options.levels_field.empty();
  if (!any || !options.height_field.empty()) add(options.height_field, "height", {"height"});
  if (!any || !options.levels_field.empty())
    add(options.levels_field, "building:levels", {"building:levels", "levels", "num_floors"});
  for (const char* name : {"roof:height", "roof:levels", "min_height", "building:min_level", "building:part"})
    add({}, name, {name});
  for (const char* name : {"building:facade:material", "building:cladding", "building:material"}) add({}, name, {name});
  add({}, "roof:material", {"roof:material"});
  for (const char* name : {"natural", "landuse", "building"}) add({}, name, {name});
  for (const char* name : {"est_height", "leaf_type"}) add({}, name, {name});
  add({}, "diameter_crown", {"diameter_crown", "crown_diameter", "diameter_c"});  // the last one in Shapefiles
  if (any && options.height_field.empty()) out.push_back({"height", tree_height});
  add({}, "name", {"name"});
  return out;
}

class FootprintTaker {
 public:
  FootprintTaker(Map& map, const std::vector<TagField>& fields, bool vegetation)
      : map_(map), fields_(fields), vegetation_(vegetation) {}

  void take(const wt_maps_shape& shape) {
    if (layers_.empty() || layers_.back() != shape.layer) layers_.emplace_back(shape.layer);
    Footprint out;
    out.id = fmt::format("feature_{}", shape.feature);
    if (layers_.size() > 1) out.id = fmt::format("layer_{}_{}", layers_.size(), out.id);
    if (shape.part > 0) out.id += fmt::format("_{}", shape.part + 1);
    const double* xy = shape.xy;
    for (size_t ring = 0; ring < shape.rings; ++ring) {
      RingM& to = ring == 0 ? out.outer : out.holes.emplace_back();
      for (size_t i = 0; i < shape.ring_sizes[ring]; ++i, xy += 2) {
        if (!std::isfinite(xy[0]) || !std::isfinite(xy[1]))
          return void(++map_.left_out["outside of the area of its coordinate system"]);
        to.push_back({xy[0], xy[1]});
      }
    }
    for (size_t k = 0; k < fields_.size(); ++k)
      if (shape.values[k]) out.tags.try_emplace(fields_[k].tag, shape.values[k]);
    if (const auto name = out.tags.find("name"); name != out.tags.end()) {
      out.name = name->second;
      out.tags.erase(name);
    }
    const Tags::node_type height = out.tags.extract(tree_height);
    if (shape.kind != WT_MAPS_POLYGON) {
      if (height) out.tags.try_emplace("height", height.mapped());
      return take_trees(shape.kind, std::move(out));
    }
    if (is_wood(out.tags)) {
      if (!vegetation_) return void(++map_.left_out["forest (landuse=forest, natural=wood)"]);
      out.tags["vegetation"] = "wood";
    }
    out.tags.erase("natural");
    out.tags.erase("landuse");
    map_.footprints.push_back(std::move(out));
  }

  const std::vector<MappedTrees>& trees() const { return trees_; }

 private:
  void take_trees(int kind, Footprint from) {
    const bool tree = kind == WT_MAPS_POINT && is_tree_point(from.tags);
    if (!tree && !(kind == WT_MAPS_LINE && is_row_line(from.tags)))
      return void(++map_.left_out["point or line that is no tree (natural=tree, natural=tree_row)"]);
    if (!vegetation_) return void(++map_.left_out[tree ? "tree (natural=tree)" : "row of trees (natural=tree_row)"]);
    trees_.push_back({from.id, from.name, std::move(from.outer), std::move(from.tags)});
  }

  static bool is_wood(const Tags& tags) {
    return !says_yes(tags, "building") && !says_yes(tags, "building:part") &&
           (tag(tags, "natural") == "wood" || tag(tags, "landuse") == "forest");
  }

  Map& map_;
  const std::vector<TagField>& fields_;
  bool vegetation_;
  std::vector<std::string> layers_;
  std::vector<MappedTrees> trees_;
};

struct TakerCall {
  FootprintTaker taker;
  std::exception_ptr problem;  // exceptions must not cross the module's C interface
};

int visit(void* user, const wt_maps_shape* shape) {
  auto& call = *static_cast<TakerCall*>(user);
  try {
    call.taker.take(*shape);
    return 0;
  } catch (...) {
    call.problem = std::current_exception();
    return 1;
  }
}

void check_fields(const std::string& name, const std::vector<TagField>& fields, const wt_maps_layers& layers,
                  const ImportOptions& options, Map& map) {
  bool heights = false;
  for (size_t k = 0; k < fields.size(); ++k) {
    const bool found = (layers.found >> k & 1) != 0;
    const bool of_height =
        std::string_view(fields[k].tag) == "height" || std::string_view(fields[k].tag) == "building:levels";
    heights = heights || (found && of_height);
    if (!found && (fields[k].field == options.height_field || fields[k].field == options.levels_field))
      throw InputError(fmt::format("{}: there is no field '{}'; fields are {}", name, fields[k].field,
                                   *layers.fields ? layers.fields : "none"));
    if ((layers.ambiguous >> k & 1) == 0) continue;
    const std::string several =
        fmt::format("{}: several fields are called '{}', or differ from that by case alone; fields are {}", name,
                    fields[k].field, layers.fields);
    if (fields[k].field == options.height_field || fields[k].field == options.levels_field)
      throw InputError(several + "; name one of them as it is written there, or rename all but one");
    map.warnings.push_back(several + "; the first of them is used");
  }
  if (!heights)
    map.warnings.push_back(
        fmt::format("{}: no field gives heights, so all buildings are {:g} m high; "
                    "name one of its fields with --height (metres) or --levels (storeys): {}",
                    name, options.default_height_m, *layers.fields ? layers.fields : "it has none"));
}

// Says from which fields trees have their heights and crowns.
std::string tree_columns(const std::vector<TagField>& fields, const wt_maps_layers& layers) {
  const auto found = [&](std::initializer_list<std::string_view> tags) {
    std::vector<std::string> names;
    for (size_t k = 0; k < fields.size(); ++k)
      if ((layers.found >> k & 1) != 0 && std::ranges::find(tags, fields[k].tag) != tags.end())
        names.push_back("'" + fields[k].field + "'");
    return names.empty() ? "no field" : fmt::format("{}", fmt::join(names, ", "));
  };
  return fmt::format("height from {}, diameter of the crown from {}, kind of leaves from {}",
                     found({"height", "est_height", tree_height}), found({"diameter_crown"}), found({"leaf_type"}));
}

// Coordinates without a system are kept, unless they look like degrees, which would make a city of a metre.
void check_metres(Map& map, const std::string& name, const ImportOptions& options) {
  bool small = !map.footprints.empty();
  each_point(map, [&](const glm::dvec2& p) { small = small && std::abs(p.x) <= 180 && std::abs(p.y) <= 90; });
  if (small)
    throw InputError(
        fmt::format("{}: does not name its coordinate system, and all coordinates are as small as degrees; "
                    "if they are degrees, name it: ogr2ogr -a_srs EPSG:4326 named.gpkg {}",
                    name, name));
  if (!options.net.empty())
    throw InputError(
        fmt::format("{}: does not name its coordinate system, so it cannot be placed on the network of --net", name));
  map.georeference.projection = options.projection;
  if (options.projection.empty())
    map.warnings.push_back(
        fmt::format("{}: does not name its coordinate system: its coordinates are taken as metres, "
                    "and the scene has no georeference; --projection names one",
                    name));
}

}  // namespace

Map read_vector_map(const std::string& file, const ImportOptions& options) {
  const MapsModule& module = maps_module(file);
  const std::vector<TagField> fields = tag_fields(options);
  std::vector<const char*> names;
  for (const TagField& field : fields) names.push_back(field.field.c_str());
  const wt_maps_query query{options.layer.empty() ? nullptr : options.layer.c_str(), names.data(), names.size(),
                            max_corners + 1 + 100};
  Map map;
  TakerCall call{FootprintTaker(map, fields, options.vegetation), {}};
  wt_maps_layers layers{};
  char error[WT_MAPS_ERROR_SIZE] = {};
  const int failed = module.shapes(file.c_str(), &query, &visit, &call, &layers, error);
  if (call.problem) std::rethrow_exception(call.problem);
  if (failed != 0) throw InputError(fmt::format("{}: cannot be read as a map: {}", file, error));
  check_fields(file, fields, layers, options, map);
  if (layers.no_shapes > 0) map.left_out["feature without a geometry that is read"] += layers.no_shapes;
  if (layers.too_large > 0) map.left_out["more than 5000 corners"] += layers.too_large;
  const double unit_m = layers.in_degrees ? metres_per_degree : 1;
  map.rounding_m = unit_m * rounding_of(map.footprints, layers.in_degrees ? degree_steps : metre_steps);
  plant(map, call.taker.trees(), layers.in_degrees ? MapUnit::degree : MapUnit::metre);
  if (!call.taker.trees().empty()) map.tree_columns = tree_columns(fields, layers);
  if (layers.in_degrees)
    project(map, file, options, advice);
  else
    check_metres(map, file, options);
  return map;
}

}  // namespace wavetracer::imports
