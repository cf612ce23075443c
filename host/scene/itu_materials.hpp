// The materials of Recommendation ITU-R P.2040, Table 3: their laws by name, edition and range of frequencies.
// Assumes nothing about a scene; the ranges are those that the laws were measured in.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// The laws of an edition, 0.1 m thick, name by name. A name may have several; below 100 GHz one of them holds. Where
// two hold one frequency, the law of the narrower range comes first.
const std::vector<Material>& itu_materials(ItuEdition edition = "P.2040-4");

// How a law was found.
struct ItuLaw {
  Material material;
  bool in_range;       // else it is the law whose range is nearest, by the ratio of frequencies
  std::string choice;  // a warning where several laws of the name hold the frequency; else empty
};

// The law of a name at a frequency > 0; nothing if the edition does not have the name.
std::optional<ItuLaw> find_itu_law(ItuEdition edition, std::string_view name, double frequency_ghz);

// Whether the range of the material is a limit, not only what was measured (Table 3, note on the kinds of ground).
bool range_is_a_limit(std::string_view name);

// "1 to 100 GHz": of one law; of all laws of a name, joined by "and"; empty for a name that there is not.
std::string range_in_words(const Material& law);
std::string ranges_in_words(ItuEdition edition, std::string_view name);

// All names, separated by commas.
std::string itu_names(ItuEdition edition);

}  // namespace wavetracer
