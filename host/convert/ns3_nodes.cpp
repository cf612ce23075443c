// SPDX-License-Identifier: Apache-2.0
// Twins are found by their positions in every frame, and by name if several share those.
// Velocities are not compared: they follow from the positions.
#include "convert/ns3_nodes.hpp"
#include <algorithm>
#include <cmath>

namespace wavetracer {
namespace {

// The positions of each end in every frame.
struct Tracks {
  std::vector<std::vector<glm::dvec3>> transmitters, receivers;
};

Tracks read_tracks(const SavedRun& run, const ExportOptions& options) {
  Tracks tracks{std::vector<std::vector<glm::dvec3>>(run.transmitters().size()),
                std::vector<std::vector<glm::dvec3>>(run.receivers().size())};
  for (size_t row = options.first_row; row <= options.last_row; ++row) {
    const SavedFrame frame = run.frame(row);
    for (size_t i = 0; i < tracks.transmitters.size(); ++i)
      tracks.transmitters[i].push_back(frame.transmitter_position_m[i]);
    for (size_t i = 0; i < tracks.receivers.size(); ++i) tracks.receivers[i].push_back(frame.receiver_position_m[i]);
  }
  return tracks;
}

bool absent(const glm::dvec3& p) { return std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z); }

bool never_present(const std::vector<glm::dvec3>& track) { return std::ranges::all_of(track, absent); }

bool same_track(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  for (size_t i = 0; i < a.size(); ++i)
    if (!(a[i] == b[i]) && !(absent(a[i]) && absent(b[i]))) return false;
  return true;
}

Ns3Node make_node(const std::string& name, const std::vector<glm::dvec3>& track) {
  Ns3Node node;
  node.name = name;
  node.late = absent(track.front());
  for (const glm::dvec3& position : track)
    if (!absent(position)) {
      node.position_m = position;
      break;
    }
  return node;
}

}  // namespace

std::vector<Ns3Node> find_nodes(const SavedRun& run, const ExportOptions& options) {
  const Tracks tracks = read_tracks(run, options);
  std::vector<Ns3Node> nodes;
  for (size_t i = 0; i < tracks.transmitters.size(); ++i)
    if (!never_present(tracks.transmitters[i]))
      nodes.emplace_back(make_node(run.transmitters()[i].name, tracks.transmitters[i])).transmitter = i;
  const size_t transmitters = nodes.size();
  for (size_t i = 0; i < tracks.receivers.size(); ++i) {
    if (never_present(tracks.receivers[i])) continue;
    const std::string& name = run.receivers()[i].name;
    Ns3Node* twin = nullptr;
    for (size_t k = 0; k < transmitters; ++k)
      if (!nodes[k].receiver && same_track(tracks.transmitters[*nodes[k].transmitter], tracks.receivers[i]) &&
          (twin == nullptr || nodes[k].name == name))
        twin = &nodes[k];
    if (twin == nullptr) twin = &nodes.emplace_back(make_node(name, tracks.receivers[i]));
    twin->receiver = i;
  }
  return nodes;
}

}  // namespace wavetracer
