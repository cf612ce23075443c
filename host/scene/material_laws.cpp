// SPDX-License-Identifier: Apache-2.0
// The table is that of Recommendation ITU-R P.2040-4 (09/2025), which contains that of P.2040-3 (08/2023) with the same
// values. It was checked against two transcriptions by others: NVlabs/sionna-rt, src/sionna/rt/radio_materials/itu.py,
// and jeertmans/DiffeRT, differt/src/differt/em/_material.py.
#include "scene/material_laws.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wavetracer {
namespace {

struct Row {
  const char* name;
  double a, b, c, d, min_ghz, max_ghz;
  int since;  // first edition that has the law; 3 also stands for earlier editions
};

constexpr Row table[] = {
    {"vacuum", 1, 0, 0, 0, 0.001, 100, 3},
    {"concrete", 5.24, 0, 0.0462, 0.7822, 1, 100, 3},
    {"concrete", 5.17, 0, 0.0145, 1.09, 110, 330, 4},
    {"brick", 3.91, 0, 0.0238, 0.16, 1, 40, 3},
    {"brick", 4.15, 0, 0.0006, 1.5712, 110, 330, 4},
    {"plasterboard", 2.73, 0, 0.0085, 0.9395, 1, 100, 3},
    {"plasterboard", 2.56, 0, 0.0001, 1.7799, 110, 330, 4},
    {"plasterboard", 2.65, 0, 0.0002, 1.598, 100, 400, 4},
    {"wood", 1.99, 0, 0.0047, 1.0718, 0.001, 100, 3},
    {"wood", 1.82, 0, 0.004, 1.0761, 110, 330, 4},
    {"wood", 2.1183, 0, 0.0055, 1.1113, 100, 400, 4},
    {"glass", 6.31, 0, 0.0036, 1.3394, 0.1, 100, 3},
    {"glass", 5.79, 0, 0.0004, 1.658, 220, 450, 3},
    {"glass", 6.5767, 0, 0.0012, 1.4697, 100, 400, 4},
    {"clear_acrylic", 2.58, 0, 0.0001, 1.6524, 110, 330, 4},
    {"ceiling_board", 1.48, 0, 0.0011, 1.075, 1, 100, 3},
    {"ceiling_board", 1.52, 0, 0.0029, 1.029, 220, 450, 3},
    {"ceiling_board", 1.2567, 0, 0.00013, 1.454, 100, 400, 4},
    {"chipboard", 2.58, 0, 0.0217, 0.78, 1, 100, 3},
    {"chipboard", 2.16, 0, 0.0023, 1.359, 100, 200, 4},
    {"plywood", 2.71, 0, 0.33, 0, 1, 40, 3},
    {"plywood", 1.94, 0, 0.0067, 0.9982, 110, 330, 4},
    {"plywood", 2.17, 0, 0.0063, 1.045, 100, 400, 4},
    {"marble", 7.074, 0, 0.0055, 0.9262, 1, 60, 3},
    {"marble", 7.94, 0, 0.0001, 1.733, 110, 330, 4},
    {"marble", 8.62, 0, 0.0027, 1.15, 100, 400, 4},
    {"floorboard", 3.66, 0, 0.0044, 1.3515, 50, 100, 3},
    {"floorboard", 5.27, 0, 49.8726, 0, 400, 450, 4},
    {"floorboard", 5.27, 0, 2.22e-17, 7.3413, 220, 300, 4},
    {"floorboard", 5.27, 0, 0.0003, 2.0298, 300, 400, 4},
    {"floorboard", 3.1575, 0, 0.001675, 1.32775, 100, 400, 4},
    {"vinyl_tile", 3.62, 0, 0.0051, 0.8422, 1, 40, 4},
    {"carpet_tile", 2.08, 0, 0.0009, 0.82, 1, 40, 4},
    {"asphalt_concrete", 4.83, 0, 0.0108, 1.3969, 1, 40, 4},
    {"metal", 1, 0, 1e7, 0, 1, 100, 3},
    {"very_dry_ground", 3, 0, 0.00015, 2.52, 1, 10, 3},
    {"medium_dry_ground", 15, -0.1, 0.035, 1.63, 1, 10, 3},
    {"wet_ground", 30, -0.4, 0.15, 1.3, 1, 10, 3},
};

std::vector<Material> laws_of(int edition) {
  std::vector<Material> out;
  for (const Row& row : table)
    if (row.since <= edition) out.push_back({row.name, row.a, row.b, row.c, row.d, row.min_ghz, row.max_ghz});
  return out;
}

std::vector<Material> laws_of(ItuEdition edition, std::string_view name) {
  std::vector<Material> out;
  for (const Material& law : itu_materials(edition))
    if (law.name == name) out.push_back(law);
  return out;
}

bool holds(const Material& law, double ghz) { return ghz >= law.min_ghz && ghz <= law.max_ghz; }

// Returns the factor between the frequency and the range; 1 inside the range.
double distance(const Material& law, double ghz) { return std::max({law.min_ghz / ghz, ghz / law.max_ghz, 1.0}); }

constexpr double unlimited_m = std::numeric_limits<double>::infinity();
constexpr const char* skin =
    "dry skin: S. Gabriel, R. W. Lau, C. Gabriel, Phys. Med. Biol. 41 (1996), 2271-2293, table 1, fitted";
}  // namespace

const std::vector<Material>& itu_materials(ItuEdition edition) {
  static const std::vector<Material> third = laws_of(3), fourth = laws_of(4);
  return edition == "P.2040-3" ? third : fourth;
}

std::optional<ItuLaw> find_itu_law(ItuEdition edition, std::string_view name, double frequency_ghz) {
  const std::vector<Material> laws = laws_of(edition, name);
  if (laws.empty()) return std::nullopt;
  std::vector<std::string> ranges;
  for (const Material& law : laws)
    if (holds(law, frequency_ghz)) ranges.push_back(range_in_words(law));
  const auto nearest = std::min_element(laws.begin(), laws.end(), [&](const Material& a, const Material& b) {
    return distance(a, frequency_ghz) < distance(b, frequency_ghz);
  });
  ItuLaw out{*nearest, !ranges.empty(), ""};
  if (ranges.size() > 1)
    out.choice = fmt::format(
        "ITU-R {} has {} laws of \"{}\" at {:g} GHz ({}): that of {} is used, because its range is narrower; "
        "a [[material]] with a, b, c and d takes another one",
        edition.word(), ranges.size(), name, frequency_ghz, fmt::join(ranges, ", "), ranges.front());
  return out;
}

bool range_is_a_limit(std::string_view name) { return name.ends_with("_ground"); }

std::string range_in_words(const Material& law) { return fmt::format("{:g} to {:g} GHz", law.min_ghz, law.max_ghz); }

std::string ranges_in_words(ItuEdition edition, std::string_view name) {
  std::vector<std::string> words;
  for (const Material& law : laws_of(edition, name)) words.push_back(range_in_words(law));
  return fmt::format("{}", fmt::join(words, " and "));
}

std::string itu_names(ItuEdition edition) {
  std::vector<std::string> names;
  for (const Material& law : itu_materials(edition))
    if (names.empty() || names.back() != law.name) names.push_back(law.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// Thin panes and panels are slabs of their own thickness; people are half spaces, since nothing gets through. For
// human_skin, power laws were fitted to the Cole-Cole model within 0.13 dB of its reflection at normal incidence.
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
    if (material.law.name == name &&
        (!nearest || distance(material.law, frequency_ghz) < distance(*nearest, frequency_ghz)))
      nearest = &material.law;
  if (!nearest) return std::nullopt;
  return ItuLaw{*nearest, distance(*nearest, frequency_ghz) == 1, ""};
}

}  // namespace wavetracer
