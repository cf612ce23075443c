// Appends the reversed paths after those that are there, and merges.
#include "simulation/reciprocity.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

#include "simulation/distinct_paths.hpp"

namespace wavetracer {

PathGeometry with_reversed_twins(const PathGeometry& paths, std::span<const uint32_t> receiver_of_transmitter,
                                 std::span<const uint32_t> transmitter_of_receiver, std::span<const Link> wanted) {
  const auto twin_of = [&](const Link& link) -> std::optional<Link> {
    const Link twin{transmitter_of_receiver[link.rx], receiver_of_transmitter[link.tx]};
    if (twin.tx == no_end || twin.rx == no_end || !std::ranges::binary_search(wanted, twin)) return {};
    return twin;
  };

  PathGeometry all = paths;
  std::vector<uint32_t> source;  // of the rows added
  std::optional<Link> twin;
  for (uint32_t row = 0; row < paths.size(); ++row) {
    const Link link{paths.tx[row], paths.rx[row]};
    // Rows of a link follow each other where the paths are sorted: one search is enough for them.
    if (row == 0 || link != Link{paths.tx[row - 1], paths.rx[row - 1]}) twin = twin_of(link);
    if (!twin) continue;
    source.push_back(row);
    all.tx.push_back(twin->tx);
    all.rx.push_back(twin->rx);
    all.first.push_back(all.first.back() + paths.first[row + 1] - paths.first[row]);
  }
  all.surface.resize(all.first.back());
  all.interaction.resize(all.first.back());
  all.vertex.resize(all.first.back());
  tbb::parallel_for(size_t{0}, source.size(), [&](size_t i) {
    uint64_t from = paths.first[source[i] + 1];
    for (uint64_t to = all.first[paths.size() + i]; to < all.first[paths.size() + i + 1]; ++to) {
      --from;
      all.surface[to] = paths.surface[from];
      all.interaction[to] = paths.interaction[from];
      all.vertex[to] = paths.vertex[from];
    }
  });
  return distinct_paths(all);
}

}  // namespace wavetracer
