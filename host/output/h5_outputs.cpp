// SPDX-License-Identifier: Apache-2.0
// Holds the table of HDF5 outputs.
#include "output/h5_outputs.hpp"
#include <array>
#include "output/cache_entries_h5.hpp"
#include "output/element_h5.hpp"
#include "output/paths_h5.hpp"
#include "output/waypoints_h5.hpp"
#include "radio/codebook.hpp"

namespace wavetracer {
namespace {

constexpr std::array<H5Output, most_h5_outputs> outputs{
    {{"paths.h5", ".h5", encode_head_h5, append_frame_h5, growing_groups},
     {"waypoints.h5", ".waypoints.h5", encode_waypoints_head_h5, append_waypoints_h5, growing_waypoint_groups},
     {"cache_entries.h5", ".cache_entries.h5", encode_cache_entries_head_h5, append_cache_entries_h5,
      growing_cache_entry_groups},
     {"responses.h5", ".responses.h5", encode_responses_head_h5, append_responses_h5, growing_response_groups},
     {"beams.h5", ".beams.h5", encode_beams_head_h5, append_beams_h5, growing_beam_groups},
     {"carriers.h5", ".carriers.h5", encode_carriers_head_h5, append_carriers_h5, growing_carrier_groups}}};

}  // namespace

std::vector<H5Output> h5_outputs(const Config& config) {
  const std::array wanted = {true,
                             config.output.waypoints > 0,
                             config.output.cache_entries,
                             config.response.bandwidth_hz.has_value(),
                             has_beams(config),
                             config.radio.frequencies_hz.size() > 1};
  static_assert(wanted.size() == outputs.size());
  std::vector<H5Output> out;
  for (size_t i = 0; i < outputs.size(); ++i)
    if (wanted[i]) out.push_back(outputs[i]);
  return out;
}

}  // namespace wavetracer
