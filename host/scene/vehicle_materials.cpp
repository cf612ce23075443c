// SPDX-License-Identifier: Apache-2.0
// Thin panes and panels are slabs of their own thickness; people are half spaces, since nothing gets through. For
// human_skin, power laws were fitted to the Cole-Cole model within 0.13 dB of its reflection at normal incidence.
#include "scene/vehicle_materials.hpp"

#include <algorithm>
#include <limits>

namespace wavetracer {
namespace {

constexpr double unlimited_m = std::numeric_limits<double>::infinity();
constexpr const char* skin =
    "dry skin: S. Gabriel, R. W. Lau, C. Gabriel, Phys. Med. Biol. 41 (1996), 2271-2293, table 1, fitted";

double ratio(const Material& law, double ghz) { return std::max({law.min_ghz / ghz, ghz / law.max_ghz, 1.0}); }

}  // namespace

const std::vector<VehicleMaterial>& vehicle_materials() {
  static const std::vector<VehicleMaterial> list{
      {{"vehicle_glass", 6.31, 0, 0.0036, 1.3394, 0.1, 100, 0.005}, "the glass of ITU-R P.2040, 5 mm thick"},
      {{"plastic", 2.26, 0, 6.3e-5, 1, 1, 40, 0.003},
       "polypropylene, loss tangent 0.0005: B. Riddle, J. Baker-Jarvis, J. Krupka, IEEE Trans. Microw. Theory Tech. "
       "51 (2003), 727-733; 3 mm thick"},
      {{"human_skin", 41.37, -0.09995, 0.6991, 0.9579, 1, 10, unlimited_m}, skin},
      {{"human_skin", 145.4, -0.6396, 0.6456, 1.122, 10, 30, unlimited_m}, skin},
      {{"human_skin", 287.2, -0.8685, 10.53, 0.297, 30, 100, unlimited_m}, skin},
  };
  return list;
}

std::string vehicle_material_names() {
  std::string out, last;
  for (const VehicleMaterial& material : vehicle_materials()) {
    if (material.law.name == last) continue;
    last = material.law.name;
    out += (out.empty() ? "" : ", ") + last;
  }
  return out;
}

std::optional<ItuLaw> find_vehicle_law(std::string_view name, double frequency_ghz) {
  const Material* nearest = nullptr;
  for (const VehicleMaterial& material : vehicle_materials())
    if (material.law.name == name && (!nearest || ratio(material.law, frequency_ghz) < ratio(*nearest, frequency_ghz)))
      nearest = &material.law;
  if (!nearest) return std::nullopt;
  return ItuLaw{*nearest, ratio(*nearest, frequency_ghz) == 1, ""};
}

}  // namespace wavetracer
