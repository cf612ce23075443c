// Offsets first, then every row is copied to its place, on all cores.
#include "radio/path_rows.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace wavetracer {

PathGeometry rows_of(const PathGeometry& paths, std::span<const uint32_t> rows) {
  PathGeometry out;
  out.tx.resize(rows.size());
  out.rx.resize(rows.size());
  if (!paths.quarters.empty()) out.quarters.resize(rows.size());
  out.first.resize(rows.size() + 1);
  for (size_t i = 0; i < rows.size(); ++i)
    out.first[i + 1] = out.first[i] + paths.first[rows[i] + 1] - paths.first[rows[i]];
  out.surface.resize(out.first.back());
  out.interaction.resize(out.first.back());
  out.vertex.resize(out.first.back());
  tbb::parallel_for(size_t{0}, rows.size(), [&](size_t i) {
    const uint32_t row = rows[i];
    out.tx[i] = paths.tx[row];
    out.rx[i] = paths.rx[row];
    if (!paths.quarters.empty()) out.quarters[i] = paths.quarters[row];
    const auto to = static_cast<std::ptrdiff_t>(out.first[i]);
    std::ranges::copy(of_path(paths, paths.surface, row), out.surface.begin() + to);
    std::ranges::copy(of_path(paths, paths.interaction, row), out.interaction.begin() + to);
    std::ranges::copy(of_path(paths, paths.vertex, row), out.vertex.begin() + to);
  });
  return out;
}

}  // namespace wavetracer
