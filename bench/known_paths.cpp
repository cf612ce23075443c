// SPDX-License-Identifier: Apache-2.0
// Merges lists that are sorted by link and delay, as Paths promises.
#include "known_paths.hpp"

#include <tuple>

#include "path_recall.hpp"
#include "radio/path_power.hpp"

namespace wavetracer::bench {
namespace {

void append(Paths& to, const Paths& from, size_t row) {
  to.tx.push_back(from.tx[row]);
  to.rx.push_back(from.rx[row]);
  to.depth.push_back(from.depth[row]);
  to.delay_s.push_back(from.delay_s[row]);
  to.a.push_back(from.a[row]);
  for (size_t v = from.vertex_offset[row]; v < from.vertex_offset[row + 1]; ++v) {
    to.vertex_interaction.push_back(from.vertex_interaction[v]);
    to.vertex_surface.push_back(from.vertex_surface[v]);
    to.vertex_instance.push_back(from.vertex_instance[v]);
  }
  to.vertex_offset.push_back(to.vertex_surface.size());
}

auto place_of(const Paths& paths, size_t row) { return std::tuple(paths.tx[row], paths.rx[row], paths.delay_s[row]); }

}  // namespace

void KnownPaths::add(const Paths& found) {
  const std::vector<size_t> known = matching_rows(found, paths_);
  Paths merged;
  size_t old = 0;
  for (size_t row = 0; row < found.size(); ++row) {
    if (known[row] != no_row) continue;
    for (; old < paths_.size() && place_of(paths_, old) <= place_of(found, row); ++old) append(merged, paths_, old);
    append(merged, found, row);
  }
  for (; old < paths_.size(); ++old) append(merged, paths_, old);
  paths_ = std::move(merged);
}

double KnownPaths::power() const {
  double power = 0;
  for (size_t row = 0; row < paths_.size(); ++row) power += power_of(paths_, row);
  return power;
}

KnownPaths::Lost KnownPaths::lost(const Paths& found) const {
  const std::vector<size_t> rows = matching_rows(paths_, found);
  Lost lost;
  for (size_t row = 0; row < rows.size(); ++row)
    if (rows[row] == no_row) {
      ++lost.paths;
      lost.power += power_of(paths_, row);
    }
  return lost;
}

}  // namespace wavetracer::bench
