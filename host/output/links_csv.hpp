// links.csv: one row a frame, transmitter and receiver, also for links without a path.
// RFC 4180 with a header row and "\n" line ends; numbers are the shortest text that reads back to the same double.
#pragma once
#include <string>
#include "output/output.hpp"

namespace wavetracer {

// tx and rx are the names of the config, or the row number where a name is empty. A link without a path has a gain of
// "-inf" and delay and Doppler figures of "nan". los is 1 or 0.
std::string encode_links_csv(const RunData& run);

}  // namespace wavetracer
