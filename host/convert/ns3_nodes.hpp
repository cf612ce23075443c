// SPDX-License-Identifier: Apache-2.0
// Turns radio ends into nodes: a node sends with one transmitter, receives with one receiver, or does both at one
// place. The twins of a mounted antenna must have exactly equal positions, as runs write them.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>
#include "convert/convert.hpp"

namespace wavetracer {

struct Ns3Node {
  std::string name;
  std::optional<size_t> transmitter, receiver;  // rows among the run's ends
  glm::dvec3 position_m{0};                     // position in the first frame in which it is present
  bool late = false;                            // it is absent in the first frame
};

// Returns transmitters in their order, then the receivers without a transmitter. Ends that are never present are left
// out.
std::vector<Ns3Node> find_nodes(const SavedRun& run, const ExportOptions& options);

}  // namespace wavetracer
