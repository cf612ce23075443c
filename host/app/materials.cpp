// SPDX-License-Identifier: Apache-2.0
// The values of laws are computed by the same code as fields, so that the page cannot differ from the program.
#include "app/materials.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include "imports/wall_classes.hpp"
#include "radio/constants.hpp"
#include "radio/material.hpp"
#include "scene/material_laws.hpp"

namespace wavetracer::app {
namespace {

constexpr ItuEdition older = "P.2040-3", newest = "P.2040-4";
constexpr double d_band_ghz = 140;  // frequency at which the page compares the laws of both editions

// Ignores the range, to see the value of the law itself.
std::complex<double> permittivity_of(Material law, double ghz) {
  law.min_ghz = 0;
  law.max_ghz = ghz;
  return complex_permittivity(law, ghz * 1e9);
}

// Returns decibels of a reflection or loss; vacuum reflects nothing.
std::string decibels(double db) {
  if (!std::isfinite(db)) return "none";
  return fmt::format("{:.1f}", std::abs(db) < 0.05 ? 0.0 : db);
}

double conductivity_of(const Material& law, double ghz) { return law.c * std::pow(ghz, law.d); }

// Returns the reflection of a half space at normal incidence.
double reflected_db(const std::complex<double>& permittivity) {
  const std::complex<double> n = std::sqrt(permittivity);
  return 20 * std::log10(std::abs((1.0 - n) / (1.0 + n)));
}

// Returns the loss of a plane wave in the material, per centimetre.
double loss_db_cm(const std::complex<double>& permittivity, double ghz) {
  const double nepers_m =
      2 * std::numbers::pi * ghz * 1e9 / speed_of_light_m_s * std::abs(std::sqrt(permittivity).imag());
  return 20 / std::numbers::ln10 * nepers_m / 100;
}

bool holds(const Material& law, double ghz) { return ghz >= law.min_ghz && ghz <= law.max_ghz; }

bool in_edition(ItuEdition edition, const Material& law) {
  for (const Material& other : itu_materials(edition))
    if (other == law) return true;
  return false;
}

std::string power(double factor, double exponent) {
  return exponent == 0 ? fmt::format("{:g}", factor) : fmt::format("{:g} f^{:g}", factor, exponent);
}

std::string law_row(const Material& law) {
  constexpr double v2x_ghz = 5.9;
  std::string at = " | | |";
  if (holds(law, v2x_ghz)) {
    const std::complex<double> eta = permittivity_of(law, v2x_ghz);
    at = fmt::format(" {:.3g} | {:.3g} | {} |", eta.real(), conductivity_of(law, v2x_ghz), decibels(reflected_db(eta)));
  }
  return fmt::format("| `{}` | {} | {} | {} | {} |{}\n", law.name, range_in_words(law), power(law.a, law.b),
                     power(law.c, law.d), in_edition(older, law) ? "both" : newest.word(), at);
}

struct LargestChange {
  double reflected_db = 0, loss_factor = 1;
  std::string reflected_of, loss_of;
  void add(const std::string& name, double db, double factor) {
    if (db > reflected_db) reflected_db = db, reflected_of = name;
    if (factor > loss_factor) loss_factor = factor, loss_of = name;
  }
};

// Compares the law that the newest edition has at the frequency with the older edition's nearest law, extrapolated to
// it.
std::string difference_row(const Material& law, double ghz, LargestChange& most) {
  const auto before = find_itu_law(older, law.name, ghz);
  const std::complex<double> now = permittivity_of(law, ghz);
  std::string out = fmt::format("| `{}` | {:.3g} | {:.3g} | {} | {} |", law.name, now.real(), conductivity_of(law, ghz),
                                decibels(reflected_db(now)), decibels(loss_db_cm(now, ghz)));
  if (!before) return out + " unknown | | | |\n";
  const std::complex<double> then = permittivity_of(before->material, ghz);
  most.add(law.name, std::abs(reflected_db(then) - reflected_db(now)),
           std::max(loss_db_cm(then, ghz) / loss_db_cm(now, ghz), loss_db_cm(now, ghz) / loss_db_cm(then, ghz)));
  return out + fmt::format(" {:.3g} | {:.3g} | {} | {} |\n", then.real(), conductivity_of(before->material, ghz),
                           decibels(reflected_db(then)), decibels(loss_db_cm(then, ghz)));
}

constexpr const char* head = R"(# Radio materials
This page lists the materials that scenes may name: those of Recommendation ITU-R P.2040, Table 3, and some for vehicles and people. `wavetracer documentation --materials` makes the page; [scenarios.md](scenarios.md#materials) says how to use materials.

`scene.itu_edition` chooses the edition: `P.2040-4` (09/2025, the default) or `P.2040-3` (08/2023). **At the carriers of vehicles they do not differ:** every law of P.2040-3 is in P.2040-4 with the same values and the same range. P.2040-4 adds four materials (`clear_acrylic`, `vinyl_tile`, `carpet_tile`, `asphalt_concrete`) and laws above 100 GHz. The document of the ITU was not at hand: the values are those of two transcriptions of Table 3 that agree in every number, in the sources of Sionna RT (`src/sionna/rt/radio_materials/itu.py`, its pull request 70) and of DiffeRT (`differt/src/differt/em/_material.py`).

## Laws
The table has the relative permittivity a f^b and the conductivity c f^d in S/m, with f in GHz. The last columns have their values at 5.9 GHz, and the reflection of a half space at normal incidence. If two laws of one name are valid at a frequency, the program uses the law with the narrower range, and a warning says so.

| material | known from | permittivity | conductivity, S/m | edition | permittivity at 5.9 GHz | S/m at 5.9 GHz | reflected, dB |
| --- | --- | --- | --- | --- | --- | --- | --- |
)";

constexpr const char* difference = R"(
## Where the editions differ
At {0:g} GHz P.2040-3 knows none of these materials: a run stops with an error that names them. With `scene.extrapolate_materials = true` the run continues the law that was measured nearest to that frequency; the columns on the right show its values. The columns are permittivity, conductivity in S/m, reflection of a half space at normal incidence in dB, and loss inside of the material in dB per cm.

| at {0:g} GHz | P.2040-4 | S/m | reflected, dB | dB/cm | P.2040-3, continued | S/m | reflected, dB | dB/cm |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
)";

constexpr const char* foot = R"(
A law that is continued beyond its range may err by this much: by up to {:.1f} dB in reflection (`{}`), and by a factor of up to {:.0f} in loss (`{}`). The three kinds of ground are not known above 10 GHz in either edition, and metal not above 100 GHz.
)";

constexpr const char* vehicles = R"(
## Vehicles and people
Bodies of vehicles may also name these materials. A `[[material]]` of the same name changes them, as it changes those above. They are slabs of the given thickness; `human_skin` is a half space. The reflection of `human_skin` at normal incidence is within 0.13 dB of the model in its source.

| material | known from | permittivity | conductivity, S/m | thickness, m | permittivity at 5.9 GHz | S/m at 5.9 GHz | reflected, dB | source |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
)";

std::string vehicle_row(const VehicleMaterial& material) {
  constexpr double v2x_ghz = 5.9;
  const Material& law = material.law;
  std::string at = " | | ";
  if (holds(law, v2x_ghz)) {
    const std::complex<double> eta = permittivity_of(law, v2x_ghz);
    at = fmt::format("{:.3g} | {:.3g} | {}", eta.real(), conductivity_of(law, v2x_ghz), decibels(reflected_db(eta)));
  }
  return fmt::format("| `{}` | {} | {} | {} | {:g} | {} | {} |\n", law.name, range_in_words(law), power(law.a, law.b),
                     power(law.c, law.d), law.thickness_m, at, material.source);
}

constexpr const char* walls = R"(
## Classes of walls
`wavetracer convert MAP -o FOLDER --wall-classes` gives the walls of each building one of these classes, instead of a material of 0.1 m, and writes their `[[material]]` tables to `FOLDER/materials.toml`. Put these tables into the configuration and change what you know better. Without them the scene file itself has the thickness of the third column, and no scattering. The class follows from the first of the tags `building:facade:material`, `building:cladding` and `building:material` whose value is known. Without one it follows from the kind of `building`, such as `house` (brick) or `warehouse` (metal), or else from `--wall-material`. Kinds of buildings are an assumption that holds for middle Europe at best, so `convert` prints how often it was made. Roofs have no classes, and neither have city models.

| class | made of | thickness, m, and its source | S, lobe, and their source |
| --- | --- | --- | --- |
)";

constexpr const char* walls_foot = R"(
The standards and papers were not at hand; the losses of concrete and wood were computed with the laws above at normal incidence, without echoes inside of the wall (test `imports`). S is the scattering coefficient (`scattering`), which acts with `trace.scattering = true` alone; the model knows no rms height of a surface. S = 0.4 with a lobe of 4 was found for a brick house with windows near 1 GHz, and stands for other masonry, too. [calibration.md](calibration.md#what-walls-are-worth) has what thickness and S are worth on measured levels: the thickness matters, and S hardly.

**Walls inside of buildings** are in no map of footprints. A partition of plasterboard is two boards with air between them, and no slab of 0.1 m: give it `layers`, as in [calibration.md](calibration.md#what-walls-are-worth).
)";

std::string wall_row(const imports::WallClass& wall) {
  std::string made = fmt::format("`{}`", wall.itu), thick = fmt::format("{:g}", wall.thickness_m);
  if (!wall.layers.empty()) {
    made.clear();
    for (const imports::WallLayer& layer : wall.layers)
      made += fmt::format("{}{:g} m of `{}`", made.empty() ? "" : ", ", layer.thickness_m, layer.material);
    thick += " of glass";
  }
  const std::string rough = wall.scattering > 0 ? fmt::format("{:g}, {}", wall.scattering, wall.lobe) : "0";
  return fmt::format("| `{}` | {} | {}: {} | {}: {} |\n", wall.name, made, thick, wall.why_thick, rough,
                     wall.why_rough);
}

}  // namespace

std::string materials_page() {
  std::string out = head;
  for (const Material& law : itu_materials(newest)) out += law_row(law);
  out += fmt::format(difference, d_band_ghz);
  std::string last;
  LargestChange most;
  for (const Material& law : itu_materials(newest)) {
    if (law.name == last || !holds(law, d_band_ghz)) continue;
    last = law.name;
    out += difference_row(law, d_band_ghz, most);
  }
  out += fmt::format(foot, most.reflected_db, most.reflected_of, most.loss_factor, most.loss_of) + vehicles;
  for (const VehicleMaterial& material : vehicle_materials()) out += vehicle_row(material);
  out += walls;
  for (const imports::WallClass& wall : imports::wall_classes()) out += wall_row(wall);
  return out + walls_foot;
}

std::string materials_table(ItuEdition edition, double frequency_hz) {
  const double ghz = frequency_hz / 1e9;
  std::string out =
      fmt::format("{:<18} {:<18} {:>12} {:>14} {:>13} {:>10}  at {:g} GHz, ITU-R {}\n", "material", "known from",
                  "permittivity", "conduct., S/m", "reflected, dB", "dB/cm", ghz, edition.word());
  std::vector<Material> laws = itu_materials(edition);
  for (const VehicleMaterial& material : vehicle_materials()) laws.push_back(material.law);
  for (const Material& law : laws) {
    out += fmt::format("{:<18} {:<18}", law.name, range_in_words(law));
    if (holds(law, ghz)) {
      const std::complex<double> eta = permittivity_of(law, ghz);
      out += fmt::format(" {:>12.4g} {:>14.4g} {:>13} {:>10.3g}", eta.real(), conductivity_of(law, ghz),
                         decibels(reflected_db(eta)), loss_db_cm(eta, ghz));
    } else {
      out += fmt::format(" {:>12}", "not known");
    }
    out += '\n';
  }
  return out;
}

}  // namespace wavetracer::app
