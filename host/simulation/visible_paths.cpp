// Reads solved paths and appends the visible ones: all of them, where the pass visible has selected them.
// Read in pieces that stay in the cache: most rows are obstructed, and their bytes need not be kept.
#include "simulation/visible_paths.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer {

namespace {

constexpr size_t piece_rows = 1 << 14;

// By the kind that stands in a step; a new one needs a line in records.h too.
constexpr auto codes = [] {
  std::array<Interaction, (WT_STEP_KIND >> WT_STEP_SHIFT) + 1> all{};  // 0: none, which fields refuse
  for (const InteractionKind& kind : interaction_kinds) all[kind.step] = kind.code;
  return all;
}();
static_assert(codes[WT_STEP_REFLECTION >> WT_STEP_SHIFT] == reflection &&
              codes[WT_STEP_TRANSMISSION >> WT_STEP_SHIFT] == transmission &&
              codes[WT_STEP_DIFFRACTION >> WT_STEP_SHIFT] == diffraction &&
              codes[WT_STEP_SCATTERING >> WT_STEP_SHIFT] == scattering);

}  // namespace

void append_visible(const SolvedList& solved, PathGeometry& out) {
  if (solved.count == 0) return;
  const size_t stride = solved.max_depth, rows_before = out.size();
  const auto headers = solved.headers.read(0, solved.count);
  std::vector<uint32_t> visible;
  for (uint32_t i = 0; i < headers.size(); ++i) {
    if (headers[i].blocked) continue;
    visible.push_back(i);
    out.tx.push_back(headers[i].transmitter);
    out.rx.push_back(headers[i].receiver);
    out.quarters.push_back(static_cast<uint8_t>(headers[i].quarters));
    out.first.push_back(out.first.back() + headers[i].depth);
  }
  out.surface.resize(out.first.back());
  out.interaction.resize(out.first.back());
  out.vertex.resize(out.first.back());

  for (size_t row = 0; row < visible.size();) {
    const size_t begin = visible[row], end = std::min<size_t>(begin + piece_rows, headers.size());
    const size_t rows_end = std::lower_bound(visible.begin(), visible.end(), end) - visible.begin();
    const auto vertices = solved.vertices.read(3 * stride * begin, 3 * stride * (end - begin));
    const auto steps = solved.sequences.read(stride * begin, stride * (end - begin));
    tbb::parallel_for(row, rows_end, [&](size_t i) {
      const size_t from = stride * (visible[i] - begin), to = out.first[rows_before + i];
      for (size_t k = 0; k < headers[visible[i]].depth; ++k) {
        const double* p = &vertices[3 * (from + k)];
        out.surface[to + k] = steps[from + k] & ~WT_STEP_KIND;
        out.interaction[to + k] = codes[steps[from + k] >> WT_STEP_SHIFT];
        out.vertex[to + k] = {p[0], p[1], p[2]};
      }
    });
    row = rows_end;
  }
}

}  // namespace wavetracer
