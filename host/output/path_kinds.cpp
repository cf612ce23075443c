// SPDX-License-Identifier: Apache-2.0
// A path's interactions are joined as bits; the last row of interaction_kinds that has one of them decides.
#include "output/path_kinds.hpp"

namespace wavetracer {

size_t path_kind(const Paths& paths, size_t path) {
  uint32_t met = 0;
  for (size_t k = paths.vertex_offset[path]; k < paths.vertex_offset[path + 1]; ++k) met |= paths.vertex_interaction[k];
  size_t kind = interaction_kinds.size();
  while (kind > 0 && !(met & interaction_kinds[kind - 1].code)) --kind;
  return kind;
}

PathKindCounts count_path_kinds(const Paths& paths) {
  PathKindCounts counts{};
  for (size_t i = 0; i < paths.size(); ++i) ++counts[path_kind(paths, i)];
  return counts;
}

}  // namespace wavetracer
