// The closing words of a run, for people: what ran where, how fast, what was found and where it is.
// Everything in it stands in summary.json and links.csv, too.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "output/output.hpp"
#include "output/totals.hpp"
#include "radio/links.hpp"

namespace wavetracer::app {

struct Results {
  Totals totals;
  uint32_t last_frame = 0;
  std::vector<LinkFigures> last_links;  // of last_frame; empty where it was computed by an earlier run
  std::vector<std::filesystem::path> files;
};

// At least one frame. Links are sorted by gain, the strongest first.
std::string report(const Run& run, const Results& results);

}  // namespace wavetracer::app
