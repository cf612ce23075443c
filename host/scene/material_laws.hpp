// SPDX-License-Identifier: Apache-2.0
// The laws of materials by name: those of Recommendation ITU-R P.2040, Table 3, by edition and frequency range, and
// those of vehicles and people, which the recommendation does not have. The ranges are those that the laws were
// measured in, or that their sources give.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Returns the laws of an edition for slabs of 0.1 m, grouped by name. A name may have several laws; below 100 GHz
// exactly one of them is valid at each frequency. If two are valid, the one with the narrower range comes first.
const std::vector<Material>& itu_materials(ItuEdition edition = "P.2040-4");

// The law that was found, and how.
struct ItuLaw {
  Material material;
  bool in_range;       // if false, the law is the one whose range is nearest, by the ratio of frequencies
  std::string choice;  // a warning if several laws of the name are valid at the frequency, else empty
};

// Returns the law of a name at a frequency > 0, or nothing if the edition does not have the name.
std::optional<ItuLaw> find_itu_law(ItuEdition edition, std::string_view name, double frequency_ghz);

// Tells whether the range of the material is a real limit of validity, not only the measured range (Table 3, note on
// the kinds of ground).
bool range_is_a_limit(std::string_view name);

// Returns text such as "1 to 100 GHz" for one law, or for all laws of a name, joined by "and"; empty for an unknown
// name.
std::string range_in_words(const Material& law);
std::string ranges_in_words(ItuEdition edition, std::string_view name);

// Returns all names, separated by commas.
std::string itu_names(ItuEdition edition);

struct VehicleMaterial {
  Material law;
  const char* source;  // source of its values
};

// Returns all laws, grouped by name; ranges of one name touch but do not overlap.
const std::vector<VehicleMaterial>& vehicle_materials();

// Returns all names, separated by commas.
std::string vehicle_material_names();

// Works as find_itu_law().
std::optional<ItuLaw> find_vehicle_law(std::string_view name, double frequency_ghz);

}  // namespace wavetracer
