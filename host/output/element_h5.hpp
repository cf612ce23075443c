// SPDX-License-Identifier: Apache-2.0
// Writes responses.h5, beams.h5 and carriers.h5: the channels of links between elements of arrays and at more than one
// carrier. element_h5.cpp lists the layouts, with the same words that the files contain.
#pragma once
#include <array>
#include "output/frame_tables.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// As for paths.h5: one writes the parts that do not grow with frames, the other the rows of a frame.
void encode_responses_head_h5(const Run& run, hdf5::File& file);
void append_responses_h5(const Run& run, const FrameResult& frame, FrameTables& tables);
inline constexpr std::array growing_response_groups{"/links", "/responses"};

void encode_beams_head_h5(const Run& run, hdf5::File& file);
void append_beams_h5(const Run& run, const FrameResult& frame, FrameTables& tables);
inline constexpr std::array growing_beam_groups{"/beams"};

void encode_carriers_head_h5(const Run& run, hdf5::File& file);
void append_carriers_h5(const Run& run, const FrameResult& frame, FrameTables& tables);
inline constexpr std::array growing_carrier_groups{"/paths"};

}  // namespace wavetracer
