// Radio ends as nodes: a node sends with one transmitter, receives with one receiver, or does both at one place.
// Assumes that the twins of a mounted antenna have the same positions, bit for bit, as runs write them.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>
#include "convert/convert.hpp"

namespace wavetracer {

struct Ns3Node {
  std::string name;
  std::optional<size_t> transmitter, receiver;  // rows of the run's ends
  glm::dvec3 position_m{0};                     // where it is first present
  bool late = false;                            // absent in the first frame
};

// Transmitters in their order, then the receivers that are none of them. Ends that are never present are no nodes.
std::vector<Ns3Node> find_nodes(const SavedRun& run, const ExportOptions& options);

}  // namespace wavetracer
