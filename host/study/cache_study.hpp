// A study of caching: settings measured in turns at several numbers of rays, over the frames of a world.
// Each is timed and compared, frame by frame, with the first setting, which has no cache and launches the same rays.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "study/cache_rows.hpp"
#include "study/cache_settings.hpp"

namespace wavetracer::study {

struct Request;  // run.hpp
struct Host;

constexpr size_t most_regions = 8;  // transmitters that a study by transmitter tells apart

struct CacheStudy {
  std::string name;  // figures of one study share its rows
  std::vector<Setting> settings;
  std::vector<uint64_t> rays;      // ascending: the thesis' range and beyond
  std::vector<uint64_t> few_rays;  // measured on CPUs, and on request where time is short
  // Of the built-in city, see with_traffic() of worlds.hpp. A config with vehicles of its own is "own".
  std::vector<std::string> drives = {"still"};
  size_t at_once = 16;          // settings that share a device besides the first, which is then measured again
  uint64_t most_frames = 500;   // of a drive, unless the request says how many
  bool by_depth = false;        // also a row per depth
  bool by_transmitter = false;  // also a row per transmitter, whose region of the table it is; the first few of them
  bool empty_tables = false;    // every frame finds the table empty: what it saves, it saves within itself
  bool centroids = false;       // rows keep the error of every frame
};

// Those that are also measured by depth or by transmitter.
std::vector<Setting> cut_settings(const CacheStudy& study);

struct CacheMeasurement {
  DeviceSummary device;
  std::vector<CacheRow> rows;
  uint64_t frames = 0;             // of a drive
  size_t points = 0, planned = 0;  // a drive and a number of rays each
};

// The numbers of rays: within --rays where it is given, else by device. Throws ConfigError where none is left.
std::vector<uint64_t> study_rays(const CacheStudy& study, const Request& request, bool gpu);
// Frames of a drive: those asked for, else 500 as in the thesis, or fewer by study, and 20 on CPUs.
uint64_t study_frames(const CacheStudy& study, const Request& request, bool gpu);

// A stop is heeded after the frame in progress; the point it belongs to is dropped.
CacheMeasurement measure_study(const CacheStudy& study, const Request& request, const Host& host);

}  // namespace wavetracer::study
