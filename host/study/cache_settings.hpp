// The caches that the studies compare, by name: the thesis' with its parameters, and ours beside them.
// A. Zhdanov, TU Munich, 2014, section 6.3. What the thesis does not give is said at its constant.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>
#include "wavetracer/config.hpp"

namespace wavetracer::study {

struct Setting {
  std::string name;
  std::function<void(Config&)> apply;  // to a config that has its number of rays
  bool whole_only = false;             // measured over whole frames, not by depth or transmitter
};

constexpr uint32_t thesis_division = 200000, thesis_precision_division = 10000;
constexpr double thesis_residual = 0.0125, thesis_residual_of_errors = 0.093;  // figures 6.11 and 6.12
constexpr uint64_t thesis_chained_buffer = 50000, thesis_open_buffer = 300000;
constexpr double thesis_load_factor = 3;
constexpr uint32_t thesis_readers = 5;
// How far a transmitter may move before its entries are stale is not given: the radius of the thesis' antennas.
constexpr double thesis_position_step_m = 1;

// Entries for all segments of a frame, of which a ray has few.
uint64_t ample_buffer(const Config& config);

// What every study of caching launches: the thesis' unordered rays, each frame whole.
void uncached(Config& config);

Setting no_cache();
Setting chained(uint32_t hash_method, uint64_t buffer_size = thesis_chained_buffer);
Setting open_mutex(uint32_t hash_method);
Setting open_readers(uint32_t hash_method);
// For traffic: open, readers, what the thesis caches (scope "all") and returns (the other ray's hit point).
Setting position(uint32_t hash_method = 3);
Setting precision(double residual, uint32_t hash_method = 3);
// The same in the thesis' chained or open table as it is printed, with its faults: "printed chained mixed".
Setting as_printed(Setting setting);
// The concurrent table, with what the static scene decides alone: by quantised key, or by the ray itself.
Setting ours();
Setting exact();
// Later frames keep the sequences of earlier ones and launch a tenth of the rays.
Setting reuse_instead();
// Directions along a Hilbert curve: rays in order without a sort.
Setting born_in_order();

// `setting` with rays sorted by H3DH.
Setting with_order(Setting setting);

// The keys of a config that settings decide; --set must leave them alone.
const std::vector<std::string>& cache_keys();

// Names that words and tests look rows up by.
std::string hash_name(uint32_t hash_method);  // "uniform", "Morton", "mixed"

}  // namespace wavetracer::study
