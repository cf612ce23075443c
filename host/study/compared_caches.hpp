// SPDX-License-Identifier: Apache-2.0
// The caches that the studies compare, by name: the thesis' with its parameters, and ours.
// A. Zhdanov, TU Munich, 2014, section 6.3. A constant that the thesis does not give says so.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>
#include "wavetracer/config.hpp"

namespace wavetracer::study {

struct Setting {
  std::string name;
  std::function<void(Config&)> apply;  // changes a config that has its number of rays
  bool whole_only = false;             // measured over whole frames, not by depth or transmitter
};

constexpr uint32_t thesis_division = 200000, thesis_precision_division = 10000;
constexpr double thesis_residual = 0.0125, thesis_residual_of_errors = 0.093;  // figures 6.11 and 6.12
constexpr uint64_t thesis_chained_buffer = 50000, thesis_open_buffer = 300000;
constexpr double thesis_load_factor = 3;
constexpr uint32_t thesis_readers = 5;
// The thesis does not say how far a transmitter may move before its entries expire: this is the radius of its antennas.
constexpr double thesis_position_step_m = 1;

// Returns entries for all segments of a frame; a ray has few.
uint64_t ample_buffer(const Config& config);

// Sets what every study of caching launches: the thesis' unordered rays, with whole frames.
void uncached(Config& config);

Setting no_cache();
Setting chained(uint32_t hash_method, uint64_t buffer_size = thesis_chained_buffer);
Setting open_mutex(uint32_t hash_method);
Setting open_readers(uint32_t hash_method);
// For traffic: an open table with readers, the thesis' scope "all", and its returned point, the other ray's hit point.
Setting position(uint32_t hash_method = 3);
Setting precision(double residual, uint32_t hash_method = 3);
// Returns the same setting in the thesis' chained or open table as printed, with its faults: "printed chained mixed".
Setting as_printed(Setting setting);
// The concurrent table, with data that depend on the static scene alone: by quantised key, or by the ray itself.
Setting ours();
Setting exact();
// Later frames keep the sequences of earlier ones and launch a tenth of the rays.
Setting reuse_instead();
// Directions follow a Hilbert curve: rays are in order without a sort.
Setting born_in_order();

// Returns `setting` with rays sorted by H3DH.
Setting with_order(Setting setting);

// Returns the keys of a config that settings decide; --set must not change them.
const std::vector<std::string>& cache_keys();

// Names by which texts and tests look rows up.
std::string hash_name(uint32_t hash_method);  // "uniform", "Morton", "mixed"

}  // namespace wavetracer::study
