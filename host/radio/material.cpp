// SPDX-License-Identifier: Apache-2.0
// The complex relative permittivity of a radio material at a frequency.
// Coefficients and range were validated where the material was made.
#include "radio/material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "radio/constants.hpp"
#include "scene/material_laws.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// Returns the materials without layers, and the layers of the others.
std::vector<Material> plain_materials(std::span<const Material> materials) {
  std::vector<Material> out;
  for (const Material& material : materials) {
    if (material.layers.empty()) out.push_back(material);
    out.insert(out.end(), material.layers.begin(), material.layers.end());
  }
  return out;
}

}  // namespace

std::string range_problem(std::span<const Material> materials, double frequency_hz) {
  const double ghz = frequency_hz / 1e9;
  std::string unknown, first, newer;
  bool measured = false;  // one of them has a measured range, not a limit
  std::vector<std::string> named;
  for (const Material& material : plain_materials(materials)) {
    if (ghz >= material.min_ghz && ghz <= material.max_ghz) continue;
    if (std::ranges::find(named, material.name) != named.end()) continue;
    named.push_back(material.name);
    unknown += fmt::format("{}the material \"{}\" is only known from {}", unknown.empty() ? "" : ", ", material.name,
                           range_in_words(material));
    if (first.empty()) first = material.name;
    measured = measured || !range_is_a_limit(material.name);
    const auto law = find_itu_law("P.2040-4", material.name, ghz);
    if (law && law->in_range) newer = "scene.itu_edition = \"P.2040-4\", which knows more of them there, ";
  }
  if (unknown.empty()) return "";
  return fmt::format(
      "radio.frequency_hz = {:g}: {}; choose a frequency in that range, {}{}or give permittivity and conductivity_s_m "
      "in a [[material]] table with name = \"{}\"",
      frequency_hz, unknown, newer,
      measured ? "set scene.extrapolate_materials = true to use what was measured nearest to it, " : "", first);
}

std::complex<double> complex_permittivity(const Material& material, double frequency_hz) {
  const double ghz = frequency_hz / 1e9;
  if (const std::string problem = range_problem({&material, 1}, frequency_hz); !problem.empty())
    throw ConfigError(problem);
  const double permittivity = material.a * std::pow(ghz, material.b);
  const double conductivity_s_m = material.c * std::pow(ghz, material.d);
  return {permittivity, -conductivity_s_m / (2 * std::numbers::pi * frequency_hz * vacuum_permittivity_f_m)};
}

}  // namespace wavetracer
