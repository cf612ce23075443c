// SPDX-License-Identifier: Apache-2.0
// The reader of files checks values and some pairs of keys with their places (host/config); these checks also hold for
// tables that a user of the library makes.
#include "scene/material_checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

std::string_view without_prefix(std::string_view text, std::string_view prefix) {
  if (text.starts_with(prefix)) text.remove_prefix(prefix.size());
  return text;
}

void check_layers(const MaterialConfig& m) {
  if (m.layers.empty()) return;
  const auto fail = [&m](const std::string& what) {
    throw ConfigError(fmt::format("[[material]] '{}': {}", m.name, what));
  };
  if (m.layers.size() > most_layers)
    fail(fmt::format("it has {} layers, and a wall may have {} at most", m.layers.size(), most_layers));
  for (const LayerConfig& layer : m.layers)
    if (layer.material.empty() || !(layer.thickness_m > 0))
      fail("each layer needs the name of a material and a positive thickness_m (inf: a half space)");
  if (gives_law(m) || m.thickness_m || !m.library.empty())
    fail("layers say what the wall is made of: remove its library, law, permittivity, conductivity and thickness");
}

}  // namespace

std::array<std::string, 3> spellings(std::string_view name) {
  const std::string_view bare = without_prefix(name, "mat-");
  return {std::string(name), std::string(bare), std::string(without_prefix(bare, "itu_"))};
}

Woodland woodland_named(std::string_view name) {
  if (name == "vegetation") return "mixed";
  if (name == "deciduous_vegetation") return "deciduous";
  return "none";
}

bool gives_law(const MaterialConfig& m) { return m.a || m.b || m.c || m.d || m.permittivity || m.conductivity_s_m; }

Woodland woodland_of(std::string_view name, const MaterialConfig* over) {
  if (over && is_vegetation(over->vegetation)) return over->vegetation;
  const bool surface = over && (gives_law(*over) || !over->library.empty());
  return surface ? "none" : woodland_named(spellings(name)[2]);
}

void check_material(const MaterialConfig& m) {
  const auto fail = [&m](const char* what) { throw ConfigError(fmt::format("[[material]] '{}': {}", m.name, what)); };
  const bool law = m.a || m.b || m.c || m.d, fixed = m.permittivity || m.conductivity_s_m;
  if (law && fixed) fail("give either a, b, c, d or permittivity and conductivity_s_m, not both");
  for (const auto& value : {m.a, m.b, m.c, m.d, m.permittivity, m.conductivity_s_m}) {
    if (value && !std::isfinite(*value)) fail("its coefficients must be finite");
  }
  if ((m.permittivity && *m.permittivity < 1) || (m.a && *m.a <= 0)) fail("permittivity must be 1 or more, a positive");
  if ((m.conductivity_s_m && *m.conductivity_s_m < 0) || (m.c && *m.c < 0)) fail("conductivity_s_m or c is negative");
  if (m.scattering_lobe && *m.scattering_lobe != std::floor(*m.scattering_lobe))
    fail("scattering_lobe must be an integer");
  check_layers(m);
  if (m.thickness_m && !(*m.thickness_m > 0)) fail("thickness_m must be positive (inf: a half space)");
  const bool surface = law || fixed || m.thickness_m || m.scattering_lobe || !m.library.empty() || !m.layers.empty();
  if (is_vegetation(m.vegetation) && surface)
    fail(
        "vegetation is no surface, and has no permittivity, thickness, scattering_lobe, library or layers: "
        "remove those keys");
  const bool leaves = m.attenuation_db_m || m.max_attenuation_db || !m.in_leaf;
  if (leaves && (surface || (!is_vegetation(m.vegetation) && !is_vegetation(woodland_named(spellings(m.name)[2])))))
    fail("attenuation_db_m, max_attenuation_db and in_leaf need vegetation = \"mixed\" or \"deciduous\"");
}

}  // namespace wavetracer
