// SPDX-License-Identifier: Apache-2.0
// A block is cut by transmitter and receiver. The whole frame decides whether a launcher sends or listens, which sets
// its number of rays.
#include "simulation/link_block.hpp"

#include <algorithm>

namespace wavetracer {

LinkBlock make_link_block(const std::vector<Link>& links, TransmitterRange from, ReceiverRange to, Launching launching,
                          std::span<const uint32_t> receiver_of_transmitter,
                          std::span<const uint32_t> transmitter_of_receiver, const Origins& origins) {
  LinkBlock block{{}, {}, std::vector<char>(origins.count(), 0), {}};
  std::vector<char> own(transmitter_of_receiver.size(), 0);
  const auto launch = [&](uint32_t origin) {
    if (origin != no_end) block.launches[origin] = 1;
  };
  for (const Link& link : links) {
    const bool is_own = link.rx >= to.first && link.rx < to.end;
    if (link.tx < from.first || link.tx >= from.end || (!is_own && launching == Launching::own)) continue;
    if (is_own) {
      block.own.push_back(link);
      own[link.rx] = 1;
      block.solved.push_back(link);
    }
    launch(link.tx);
    launch(origins.origin_of_receiver[link.rx]);  // in paths that are met from both ends
    const Link twin{transmitter_of_receiver[link.rx], receiver_of_transmitter[link.tx]};
    if (twin.tx == no_end || twin.rx == no_end || !std::ranges::binary_search(links, twin)) continue;
    if (is_own) block.solved.push_back(twin);
    launch(twin.tx);
  }
  std::ranges::sort(block.solved);
  const auto repeated = std::ranges::unique(block.solved);
  block.solved.erase(repeated.begin(), repeated.end());
  const auto& [first, receivers] = origins.listeners;
  for (uint32_t listener = 0; listener < origins.listeners.count(); ++listener) {
    for (uint32_t i = first[listener]; i < first[listener + 1]; ++i)
      if (own[receivers[i]]) block.listeners.receivers.push_back(receivers[i]);
    block.listeners.close();
  }
  return block;
}

std::vector<Launcher> launchers_of(const LinkBlock& block, const std::vector<Launcher>& launchers) {
  std::vector<Launcher> out;
  std::ranges::copy_if(launchers, std::back_inserter(out),
                       [&](const Launcher& launcher) { return block.launches[launcher.transmitter] != 0; });
  return out;
}

}  // namespace wavetracer
