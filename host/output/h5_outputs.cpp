// SPDX-License-Identifier: Apache-2.0
// Holds the table of HDF5 outputs.
#include "output/h5_outputs.hpp"
#include <array>
#include "output/cache_entries_h5.hpp"
#include "output/element_h5.hpp"
#include "output/paths_h5.hpp"
#include "output/radar_h5.hpp"
#include "output/waypoints_h5.hpp"
#include "radio/codebook.hpp"

namespace wavetracer {
namespace {

template <size_t N>
std::vector<std::string> names_of(const std::array<const char*, N>& groups) {
  return {groups.begin(), groups.end()};
}

std::array<H5Output, most_h5_outputs> all_outputs(const Config& config) {
  return {
      {{"paths.h5", ".h5", encode_head_h5, append_frame_h5, names_of(growing_groups)},
       {"waypoints.h5", ".waypoints.h5", encode_waypoints_head_h5, append_waypoints_h5,
        names_of(growing_waypoint_groups)},
       {"cache_entries.h5", ".cache_entries.h5", encode_cache_entries_head_h5, append_cache_entries_h5,
        names_of(growing_cache_entry_groups)},
       {"responses.h5", ".responses.h5", encode_responses_head_h5, append_responses_h5,
        names_of(growing_response_groups)},
       {"beams.h5", ".beams.h5", encode_beams_head_h5, append_beams_h5, names_of(growing_beam_groups)},
       {"carriers.h5", ".carriers.h5", encode_carriers_head_h5, append_carriers_h5, names_of(growing_carrier_groups)},
       {"radar.h5", ".radar.h5", encode_radar_head_h5, append_radar_h5, growing_radar_groups(config.radars)}}};
}

}  // namespace

std::vector<H5Output> h5_outputs(const Config& config) {
  const std::array wanted = {true,
                             config.output.waypoints > 0,
                             config.output.cache_entries,
                             config.response.bandwidth_hz.has_value(),
                             has_beams(config),
                             config.radio.frequencies_hz.size() > 1,
                             !config.radars.empty()};
  static_assert(wanted.size() == most_h5_outputs);
  std::array<H5Output, most_h5_outputs> outputs = all_outputs(config);
  std::vector<H5Output> out;
  for (size_t i = 0; i < outputs.size(); ++i)
    if (wanted[i]) out.push_back(std::move(outputs[i]));
  return out;
}

}  // namespace wavetracer
