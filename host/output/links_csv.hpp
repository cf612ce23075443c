// links.csv: one row a frame and link, also for links without a path.
// RFC 4180 with a header row and "\n" line ends; numbers are the shortest text that reads back to the same double.
#pragma once
#include <filesystem>
#include <span>
#include "output/output.hpp"
#include "output/pending_file.hpp"

namespace wavetracer {

// tx and rx are the names of the config, or the row number where a name is empty. A link without a path has a gain of
// "-inf" and delay, Doppler and missed figures of "nan". los is 1 or 0.
void write_links_csv(const Run& run, Frames frames, PendingFile& file);

// The rows of all parts, which write_links_csv() wrote, under one header. Throws RuntimeError.
void join_links_csv(std::span<const std::filesystem::path> parts, PendingFile& file);

}  // namespace wavetracer
