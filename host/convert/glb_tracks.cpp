// SPDX-License-Identifier: Apache-2.0
// Rotations are quaternions, as in glTF.
// Indices must be valid, as SavedRun checks them.
#include "convert/glb_tracks.hpp"
#include <cmath>
#include "convert/vtk_glb_kml.hpp"

namespace wavetracer {

NodeTracks::NodeTracks(const SavedRun& run, const ExportOptions& options, const SavedFrame& first)
    : vehicles(run.instances().size()), transmitters(run.transmitters().size()), receivers(run.receivers().size()) {
  add(first, 0);
  for (size_t row = options.first_row + 1; row <= options.last_row; ++row) {
    options.tell(row);
    const auto time_s = static_cast<float>(run.time_s(row) - first.time_s);
    if (time_s > times_s.back() && std::isfinite(time_s)) add(run.frame(row), time_s);
  }
}

void NodeTracks::add(const SavedFrame& frame, float time_s) {
  times_s.push_back(time_s);
  for (auto* tracks : {&vehicles, &transmitters, &receivers})
    for (NodeTrack& track : *tracks) track.keys.emplace_back();
  for (const SavedPose& pose : frame.poses)
    if (is_finite(pose))
      vehicles[pose.instance].keys.back() = {pose.position_m, glm::normalize(glm::quat_cast(pose.rotation))};
  const auto add_ends = [](std::vector<NodeTrack>& ends, const std::vector<glm::dvec3>& positions_m) {
    for (size_t i = 0; i < ends.size(); ++i)
      if (is_finite(positions_m[i])) ends[i].keys.back() = {.position_m = positions_m[i]};
  };
  add_ends(transmitters, frame.transmitter_position_m);
  add_ends(receivers, frame.receiver_position_m);
}

}  // namespace wavetracer
