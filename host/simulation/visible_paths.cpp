// Reads solved paths and keeps the visible ones: all of them, where the pass visible has selected them.
// Read in pieces that stay in the cache: most rows are obstructed, and their bytes need not be kept.
#include "simulation/visible_paths.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "simulation/distinct_paths.hpp"
#include "wavetracer/paths.hpp"

namespace wavetracer {

namespace {
constexpr size_t piece_rows = 1 << 14;
}

PathGeometry visible_paths(const SolvedList& solved) {
  if (solved.count == 0) return {};
  const size_t stride = solved.max_depth;
  const auto headers = solved.headers.read(0, solved.count);
  PathGeometry out;
  std::vector<uint32_t> visible;
  for (uint32_t i = 0; i < headers.size(); ++i) {
    if (headers[i].blocked) continue;
    visible.push_back(i);
    out.tx.push_back(headers[i].transmitter);
    out.rx.push_back(headers[i].receiver);
    out.first.push_back(out.first.back() + headers[i].depth);
  }
  out.surface.resize(out.first.back());
  out.interaction.assign(out.first.back(), Interaction::reflection);
  out.vertex.resize(out.first.back());

  for (size_t row = 0; row < visible.size();) {
    const size_t begin = visible[row], end = std::min<size_t>(begin + piece_rows, headers.size());
    const size_t rows_end = std::lower_bound(visible.begin(), visible.end(), end) - visible.begin();
    const auto vertices = solved.vertices.read(3 * stride * begin, 3 * stride * (end - begin));
    const auto sequences = solved.sequences.read(stride * begin, stride * (end - begin));
    tbb::parallel_for(row, rows_end, [&](size_t i) {
      const size_t from = stride * (visible[i] - begin);
      for (size_t k = 0; k < headers[visible[i]].depth; ++k) {
        const double* p = &vertices[3 * (from + k)];
        out.surface[out.first[i] + k] = sequences[from + k];
        out.vertex[out.first[i] + k] = {p[0], p[1], p[2]};
      }
    });
    row = rows_end;
  }
  return distinct_paths(out);
}

}  // namespace wavetracer
