// SPDX-License-Identifier: Apache-2.0
// A study of caching: settings measured alternately at several numbers of rays, over the frames of a world.
// Each is timed and compared, frame by frame, with the first setting, which has no cache and launches the same rays.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "study/cache_rows.hpp"
#include "study/compared_caches.hpp"

namespace wavetracer::study {

struct Request;  // run.hpp
struct Host;

constexpr size_t most_regions = 8;  // largest number of transmitters in a study by transmitter

struct CacheStudy {
  std::string name;  // figures of one study share its rows
  std::vector<Setting> settings;
  std::vector<uint64_t> rays;      // ascending: the thesis' range and beyond
  std::vector<uint64_t> few_rays;  // measured on CPUs, and on request if time is short
  // For the built-in city, see with_traffic() of worlds.hpp. A config with vehicles of its own is "own".
  std::vector<std::string> drives = {"still"};
  size_t at_once = 16;         // number of settings that share a device besides the first, which is then measured again
  uint64_t most_frames = 500;  // limit of a drive, unless the request gives the number
  // Adds rows of frames that end at depth 1, where look-ups of a cold frame ask an empty table: lookup_parts() needs
  // them.
  bool first_depth = false;
  // Adds a row per transmitter, which has a region of the table; for the first few of them.
  bool by_transmitter = false;
  bool empty_tables = false;  // every frame finds the table empty: it only saves time within itself
  bool centroids = false;     // rows keep the error of every frame
};

// Returns the settings that are also measured at depth 1 or by transmitter.
std::vector<Setting> cut_settings(const CacheStudy& study);

struct CacheMeasurement {
  DeviceSummary device;
  std::vector<CacheRow> rows;
  uint64_t frames = 0;             // number of frames of a drive
  size_t points = 0, planned = 0;  // points are pairs of a drive and a number of rays
};

// Returns the numbers of rays: within --rays if it is given, else by device. Throws ConfigError if none is left.
std::vector<uint64_t> study_rays(const CacheStudy& study, const Request& request, bool gpu);
// Returns the frames of a drive: those asked for, else 500 as in the thesis, or fewer by study, and 20 on CPUs.
uint64_t study_frames(const CacheStudy& study, const Request& request, bool gpu);

// A stop takes effect after the frame in progress; its point is dropped.
CacheMeasurement measure_study(const CacheStudy& study, const Request& request, const Host& host);

}  // namespace wavetracer::study
