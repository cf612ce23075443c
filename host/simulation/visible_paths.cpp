// SPDX-License-Identifier: Apache-2.0
// Rows have room for the deepest path; shorter ones use the beginning.
#include "simulation/visible_paths.hpp"

#include <algorithm>

#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer {

PathGeometry read_visible(Setup& setup) {
  const SolvedList& list = setup.exact_paths.visible.list();
  const uint32_t count = setup.discovery->sequences().counters().read(Stage::transfer).visible;
  const auto headers = list.headers.read(0, count);
  const auto steps = list.sequences.read(0, size_t{count} * list.max_depth);
  const auto vertices = list.vertices.read(0, 3 * steps.size());
  PathGeometry out;
  for (size_t i = 0; i < headers.size(); ++i) {
    out.tx.push_back(headers[i].transmitter);
    out.rx.push_back(headers[i].receiver);
    out.quarters.push_back(static_cast<uint8_t>(headers[i].quarters));
    for (size_t k = i * list.max_depth; k < i * list.max_depth + headers[i].depth; ++k) {
      const auto kind = std::ranges::find(interaction_kinds, steps[k] >> WT_STEP_SHIFT, &InteractionKind::step);
      out.surface.push_back(steps[k] & ~WT_STEP_KIND);
      out.interaction.push_back(kind == interaction_kinds.end() ? 0 : kind->code);
      out.vertex.emplace_back(vertices[3 * k], vertices[3 * k + 1], vertices[3 * k + 2]);
    }
    out.first.push_back(out.surface.size());
  }
  return out;
}

}  // namespace wavetracer
