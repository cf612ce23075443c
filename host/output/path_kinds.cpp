// A path's interactions are joined as bits; the most special bit decides.
// Assumes the values of Interaction, which are single bits.
#include "output/path_kinds.hpp"

namespace wavetracer {

size_t path_kind(const Paths& paths, size_t path) {
  uint32_t met = 0;
  for (size_t k = paths.vertex_offset[path]; k < paths.vertex_offset[path + 1]; ++k) met |= paths.vertex_interaction[k];
  if (met & diffuse) return 4;
  if (met & diffraction) return 3;
  if (met & transmission) return 2;
  return met & reflection ? 1 : 0;
}

PathKindCounts count_path_kinds(const Paths& paths) {
  PathKindCounts counts{};
  for (size_t i = 0; i < paths.size(); ++i) ++counts[path_kind(paths, i)];
  return counts;
}

}  // namespace wavetracer
