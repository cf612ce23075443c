// SPDX-License-Identifier: Apache-2.0
// Colours are linear, as glTF has them. Vegetation is translucent.
#include "convert/glb_materials.hpp"
#include <array>
#include <cmath>

namespace wavetracer {
namespace {

using nlohmann::json;

json base_colour(const Material& material) {
  static constexpr struct {
    const char* name;
    std::array<double, 3> colour;
  } known[] = {{"brick", {0.35, 0.11, 0.07}},          {"glass", {0.25, 0.45, 0.55}},
               {"metal", {0.35, 0.38, 0.42}},          {"wood", {0.30, 0.17, 0.07}},
               {"marble", {0.60, 0.56, 0.50}},         {"asphalt_concrete", {0.05, 0.05, 0.055}},
               {"wet_ground", {0.08, 0.10, 0.06}},     {"medium_dry_ground", {0.13, 0.13, 0.08}},
               {"very_dry_ground", {0.25, 0.20, 0.12}}};
  if (material.vegetation) return {0.08, 0.32, 0.09, 0.4};
  for (const auto& entry : known)
    if (material.name == entry.name) return {entry.colour[0], entry.colour[1], entry.colour[2], 1.0};
  return {0.32, 0.32, 0.31, 1.0};  // the colour of concrete
}

// Returns the configuration's values of a vegetation law.
json law_of(const VegetationLaw& vegetation) {
  json law{{"vegetation", vegetation.deciduous ? "deciduous" : "mixed"}, {"in_leaf", vegetation.in_leaf}};
  if (vegetation.attenuation_db_m) law["attenuation_db_m"] = *vegetation.attenuation_db_m;
  if (const auto most_db = vegetation.max_attenuation_db)
    law["max_attenuation_db"] = std::isfinite(*most_db) ? json(*most_db) : json("inf");
  return law;
}

}  // namespace

json glb_material(const Material& material) {
  json law{{"a", material.a}, {"b", material.b}, {"c", material.c}, {"d", material.d}};
  if (std::isfinite(material.thickness_m)) law["thickness_m"] = material.thickness_m;
  if (material.vegetation) law = law_of(*material.vegetation);
  if (material.scattering > 0) law["scattering"] = material.scattering;
  json element{{"name", material.name},
               {"doubleSided", true},
               {"pbrMetallicRoughness",
                {{"baseColorFactor", base_colour(material)}, {"metallicFactor", 0}, {"roughnessFactor", 0.9}}},
               {"extras", std::move(law)}};
  if (material.vegetation) element["alphaMode"] = "BLEND";
  return element;
}

}  // namespace wavetracer
