// SPDX-License-Identifier: Apache-2.0
// Checks of arrays and carriers that need the whole configuration: names that nothing has, keys that exclude each
// other.
#include <fmt/format.h>

#include <algorithm>

#include "base/spelling.hpp"
#include "config/contradictions.hpp"
#include "config/value_text.hpp"

namespace wavetracer::config {
namespace {

constexpr uint64_t most_elements = 65536;  // limit of an array

template <class End>
void check_references(const std::string& table, const std::vector<End>& ends, const std::vector<std::string>& arrays,
                      std::vector<Contradiction>& out) {
  for (size_t i = 0; i < ends.size(); ++i) {
    const std::string& name = ends[i].array;
    if (name.empty() || std::ranges::find(arrays, name) != arrays.end()) continue;
    out.push_back({{fmt::format("{}.{}.array", table, i)},
                   fmt::format("{}.array = {}: there is no [[array]] of this name{}; add one, or remove the key", table,
                               toml_string(name), spelling_hint(name, arrays))});
  }
}

void check_panel(const ArrayConfig& array, const std::string& key, std::vector<Contradiction>& out) {
  const std::string named = fmt::format("[[array]] {}", toml_string(array.name));
  const bool panel = array.rows > 1 || array.columns > 1 || array.vertical_spacing_m || array.horizontal_spacing_m;
  if (!array.positions_m.empty() && panel)
    out.push_back({{key, key + ".positions_m"},
                   named + " has both positions_m and the keys of a panel (rows, columns, spacing): "
                           "give either of them"});
  if (!array.positions_m.empty() && array.codebook == "dft")
    out.push_back({{key, key + ".codebook"},
                   named + " has positions_m, but codebook = \"dft\" needs a panel of rows and columns: "
                           "give a codebook file, or \"none\""});
  const uint64_t elements = std::max<uint64_t>(uint64_t{array.rows} * array.columns, array.positions_m.size());
  if (elements > most_elements)
    out.push_back(
        {{key, key + ".rows", key + ".columns"},
         fmt::format("{} has {} elements, and {} are the limit: make it smaller", named, elements, most_elements)});
}

void check_carriers(const RadioConfig& radio, std::vector<Contradiction>& out) {
  std::vector<double> sorted = radio.frequencies_hz;
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    out.push_back(
        {{"radio.frequencies_hz"}, fmt::format("radio.frequencies_hz has {} twice: name each carrier once", *twice)});
}

// Half of a band lies below its carrier, and frequencies are positive.
void check_bands(const Config& config, std::vector<Contradiction>& out) {
  const RadioConfig& radio = config.radio;
  std::vector<double> carriers = radio.frequencies_hz;
  if (carriers.empty()) carriers.push_back(radio.frequency_hz);
  const double lowest_hz = *std::ranges::min_element(carriers);
  const auto check = [&](const char* key, std::optional<double> bandwidth_hz) {
    if (bandwidth_hz && *bandwidth_hz / 2 >= lowest_hz)
      out.push_back({{key, radio.frequencies_hz.empty() ? "radio.frequency_hz" : "radio.frequencies_hz"},
                     fmt::format("{} = {:g}: half of it is more than the carrier of {:g} Hz, "
                                 "so the band would reach below 0 Hz: give less than twice the carrier",
                                 key, *bandwidth_hz, lowest_hz)});
  };
  check("radio.bandwidth_hz", radio.bandwidth_hz);
  check("response.bandwidth_hz", config.response.bandwidth_hz);
}

}  // namespace

void check_arrays(const Config& config, std::vector<Contradiction>& out) {
  std::vector<std::string> names;
  for (const ArrayConfig& array : config.arrays) names.push_back(array.name);
  check_references("transmitter", config.transmitters, names, out);
  check_references("receiver", config.receivers, names, out);
  check_references("station", config.stations, names, out);
  check_references("receiver_grid", config.receiver_grids, names, out);
  check_references("mount", config.mounts, names, out);
  for (size_t i = 0; i < config.arrays.size(); ++i) check_panel(config.arrays[i], fmt::format("array.{}", i), out);
  check_carriers(config.radio, out);
  check_bands(config, out);
}

}  // namespace wavetracer::config
