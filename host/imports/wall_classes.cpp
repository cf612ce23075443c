// SPDX-License-Identifier: Apache-2.0
// Values are those of docs/materials.md, which says how sure they are.
#include "imports/wall_classes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace wavetracer::imports {
namespace {

constexpr double masonry_scattering = 0.4;
constexpr int masonry_lobe = 4;
constexpr const char* structured =
    "V. Degli-Esposti et al., IEEE Trans. Antennas Propag. 55 (2007), 143-153: a brick house with windows";
constexpr const char* smooth = "no value was found; panes and sheets are smooth";

// Values of building=* and the ITU material that such houses usually have. Countries differ.
struct UsualWall {
  std::string_view building, itu;
};
constexpr auto usual_walls =
    std::to_array<UsualWall>({{"house", "brick"},     {"detached", "brick"},    {"semidetached_house", "brick"},
                              {"terrace", "brick"},   {"residential", "brick"}, {"apartments", "brick"},
                              {"church", "marble"},   {"cathedral", "marble"},  {"chapel", "marble"},
                              {"castle", "marble"},   {"industrial", "metal"},  {"warehouse", "metal"},
                              {"hangar", "metal"},    {"greenhouse", "glass"},  {"barn", "wood"},
                              {"cabin", "wood"},      {"hut", "wood"},          {"shed", "wood"},
                              {"garage", "concrete"}, {"garages", "concrete"},  {"parking", "concrete"}});

const WallClass* class_of_material(std::string_view itu) {
  const auto found = std::ranges::find_if(wall_classes(), [&](const WallClass& each) { return each.itu == itu; });
  return found == wall_classes().end() ? nullptr : &*found;
}

std::string name_or(std::string_view itu) {
  const WallClass* const found = class_of_material(itu);
  return found ? found->name : std::string(itu);
}

std::string layers_of(const WallClass& wall) {
  std::string out;
  for (const WallLayer& layer : wall.layers)
    out += fmt::format("{}{{ material = \"{}\", thickness_m = {} }}", out.empty() ? "" : ", ", layer.material,
                       layer.thickness_m);
  return out;
}

}  // namespace

const std::vector<WallClass>& wall_classes() {
  static const std::vector<WallClass> classes = {
      {"brick_wall",
       "brick",
       0.24,
       {},
       masonry_scattering,
       masonry_lobe,
       "one brick length, the module of DIN 4172",
       structured},
      {"concrete_wall",
       "concrete",
       0.2,
       {},
       masonry_scattering,
       masonry_lobe,
       "loses within 1 dB of concrete in 3GPP TR 38.901, Table 7.4.3-1, from 2 to 6 GHz",
       structured},
      {"stone_wall",
       "marble",
       0.24,
       {},
       masonry_scattering,
       masonry_lobe,
       "the least of bearing walls of natural stone, DIN 1053-1",
       structured},
      {"glass_wall",
       "glass",
       0.008,
       {{"glass", 0.004}, {"vacuum", 0.016}, {"glass", 0.004}},
       0,
       0,
       "two panes of 4 mm and 16 mm between them, a usual unit of EN 1279",
       smooth},
      {"metal_wall", "metal", 0.001, {}, 0, 0, "a sheet: no wave passes it at any thickness", smooth},
      {"wood_wall",
       "wood",
       0.14,
       {},
       0,
       0,
       "loses as much as wood in 3GPP TR 38.901, Table 7.4.3-1, at 5.9 GHz",
       "no value was found"}};
  return classes;
}

const WallClass* find_wall_class(std::string_view name) {
  const auto found = std::ranges::find_if(wall_classes(), [&](const WallClass& each) { return each.name == name; });
  return found == wall_classes().end() ? nullptr : &*found;
}

std::string wall_class_of(const Tags& tags, const std::string& otherwise, std::map<std::string, uint64_t>& guessed) {
  bool unknown = false;
  for (const char* key : {"building:facade:material", "building:cladding", "building:material"}) {
    const std::string_view value = tag(tags, key);
    if (const std::string_view itu = itu_material(value); !itu.empty()) return name_or(itu);
    unknown = unknown || !value.empty();
  }
  if (unknown) ++guessed["material of a wall that ITU-R P.2040 does not have"];
  const auto usual = std::ranges::find(usual_walls, tag(tags, "building"), &UsualWall::building);
  const std::string name = name_or(usual == usual_walls.end() ? std::string_view(otherwise) : usual->itu);
  ++guessed[fmt::format("walls without a known material: {} {}", name,
                        usual == usual_walls.end() ? "by --wall-material" : "by the kind of building")];
  return name;
}

std::string wall_tables(const std::vector<std::string>& names) {
  std::string out =
      "# Classes of walls of this scene. Put the tables into the configuration, and change what you know better.\n"
      "# scattering needs trace.scattering = true. docs/materials.md says where the numbers come from.\n";
  for (const std::string& name : names) {
    const WallClass* const wall = find_wall_class(name);
    if (!wall) continue;
    out += fmt::format("\n[[material]]\nname = \"{}\"\n", wall->name);
    if (wall->layers.empty())
      out += fmt::format("library = \"{}\"\nthickness_m = {}  # {}\n", wall->itu, wall->thickness_m, wall->why_thick);
    else
      out += fmt::format("layers = [{}]  # {}\n", layers_of(*wall), wall->why_thick);
    if (wall->scattering > 0)
      out +=
          fmt::format("scattering = {}  # {}\nscattering_lobe = {}\n", wall->scattering, wall->why_rough, wall->lobe);
    else
      out += fmt::format("scattering = 0  # {}\n", wall->why_rough);
  }
  return out;
}

}  // namespace wavetracer::imports
