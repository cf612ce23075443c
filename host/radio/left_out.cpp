// SPDX-License-Identifier: Apache-2.0
// The warning about paths that were left out.
#include <fmt/format.h>

#include "radio/fields.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {
namespace {

constexpr size_t most_named = 4;  // links that a warning names

}  // namespace

std::string left_out_warning(const LeftOut& left_out, const EndName& tx_name, const EndName& rx_name) {
  uint64_t paths = 0;
  size_t links = 0;
  std::string named;
  for (const auto& [link, count] : left_out) {
    paths += count;
    if (++links <= most_named)
      named += fmt::format("{}\"{}\" -> \"{}\" ({})", links > 1 ? ", " : "", tx_name(link.tx), rx_name(link.rx), count);
  }
  if (links > most_named) named += fmt::format(" and {} more links", links - most_named);
  return fmt::format(
      "{} {} left out, because an antenna is at most {} m away from the surface that reflects there, or "
      "from the other antenna: {}; move the antenna",
      paths, paths == 1 ? "path is" : "paths are", WT_ON_SURFACE_M, named);
}

}  // namespace wavetracer
