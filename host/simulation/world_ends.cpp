// Places are compared exactly: two ends are one because their configuration says so, not because they are near.
#include "simulation/world_ends.hpp"

#include <map>
#include <tuple>

#include "radio/antenna.hpp"
#include "simulation/world_links.hpp"

namespace wavetracer {

EndsOfRole standing_ends(const std::vector<RadioEnd>& ends, const glm::dvec3& origin_m) {
  EndsOfRole out;
  out.ends = ends;
  for (const RadioEnd& end : ends)
    out.standing.push_back({.position_m = vector_of(end.position_m) - origin_m,
                            .rotation = rotation_of(end.orientation_deg),
                            .velocity_m_s = vector_of(end.velocity_m_s)});
  return out;
}

TwinEnds find_twins(const EndsOfRole& transmitters, const EndsOfRole& receivers) {
  using PlaceKey = std::tuple<uint32_t, bool, double, double, double>;
  const auto place = [](const EndsOfRole& role, size_t i) {
    const bool stands = i < role.standing.size();
    if (stands) {
      const glm::dvec3& p = role.standing[i].position_m;
      return PlaceKey{no_vehicle, false, p.x, p.y, p.z};
    }
    const MountedEnd& end = role.mounted[i - role.standing.size()];
    return PlaceKey{end.track, end.above_ground, end.offset_m.x, end.offset_m.y, end.offset_m.z};
  };
  TwinEnds out{std::vector<uint32_t>(transmitters.ends.size(), no_end),
               std::vector<uint32_t>(receivers.ends.size(), no_end)};
  std::map<PlaceKey, uint32_t> at;
  for (uint32_t rx = 0; rx < receivers.ends.size(); ++rx) at.emplace(place(receivers, rx), rx);
  for (uint32_t tx = 0; tx < transmitters.ends.size(); ++tx) {
    const auto found = at.find(place(transmitters, tx));
    if (found == at.end() || out.transmitter_of_receiver[found->second] != no_end) continue;
    out.receiver_of_transmitter[tx] = found->second;
    out.transmitter_of_receiver[found->second] = tx;
  }
  return out;
}

}  // namespace wavetracer
