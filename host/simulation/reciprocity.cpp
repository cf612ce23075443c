// Appends the reversed paths after those that are there, and merges.
#include "simulation/reciprocity.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

#include "simulation/distinct_paths.hpp"

namespace wavetracer {

PathGeometry with_reversed_twins(PathGeometry paths, std::span<const uint32_t> receiver_of_transmitter,
                                 std::span<const uint32_t> transmitter_of_receiver, std::span<const Link> wanted) {
  const auto twin_of = [&](const Link& link) -> std::optional<Link> {
    const Link twin{transmitter_of_receiver[link.rx], receiver_of_transmitter[link.tx]};
    if (twin.tx == no_end || twin.rx == no_end || !std::ranges::binary_search(wanted, twin)) return {};
    return twin;
  };

  const size_t count = paths.size();
  std::vector<uint32_t> source;  // of the rows added
  std::optional<Link> twin;
  for (uint32_t row = 0; row < count; ++row) {
    const Link link{paths.tx[row], paths.rx[row]};
    // Rows of a link follow each other where the paths are sorted: one search is enough for them.
    if (row == 0 || link != Link{paths.tx[row - 1], paths.rx[row - 1]}) twin = twin_of(link);
    if (!twin) continue;
    source.push_back(row);
    paths.tx.push_back(twin->tx);
    paths.rx.push_back(twin->rx);
    if (!paths.quarters.empty()) paths.quarters.push_back(paths.quarters[row]);
    paths.first.push_back(paths.first.back() + paths.first[row + 1] - paths.first[row]);
  }
  if (source.empty()) return paths;
  paths.surface.resize(paths.first.back());
  paths.interaction.resize(paths.first.back());
  paths.vertex.resize(paths.first.back());
  tbb::parallel_for(size_t{0}, source.size(), [&](size_t i) {
    uint64_t from = paths.first[source[i] + 1];
    for (uint64_t to = paths.first[count + i]; to < paths.first[count + i + 1]; ++to) {
      --from;
      paths.surface[to] = paths.surface[from];
      paths.interaction[to] = paths.interaction[from];
      paths.vertex[to] = paths.vertex[from];
    }
  });
  return distinct_paths(paths);
}

}  // namespace wavetracer
