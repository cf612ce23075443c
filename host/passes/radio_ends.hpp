// Transmitters and receivers on the device: double4 positions, and receivers as float planes for the conservative
// rejection. Positions are recentred metres.
#pragma once
#include <algorithm>
#include <glm/vec3.hpp>
#include <vector>

#include "gpu/gpu.hpp"

namespace wavetracer {

struct RadioEnds {
  gpu::Buffer<double> transmitters, receivers;  // four doubles each
  gpu::Buffer<float> receiver_planes;           // three planes of receiver_capacity
  uint32_t transmitter_count = 0, receiver_count = 0, receiver_capacity = 0;
};

inline RadioEnds make_radio_ends(gpu::Context& context, const std::vector<glm::dvec3>& transmitters,
                                 const std::vector<glm::dvec3>& receivers) {
  const auto quadruples = [](const std::vector<glm::dvec3>& points) {
    std::vector<double> out;
    for (const glm::dvec3& p : points) out.insert(out.end(), {p.x, p.y, p.z, 0.0});
    return out;
  };
  RadioEnds ends;
  ends.transmitter_count = static_cast<uint32_t>(transmitters.size());
  ends.receiver_count = static_cast<uint32_t>(receivers.size());
  ends.receiver_capacity = (ends.receiver_count + 15) / 16 * 16;
  std::vector<float> planes;
  for (int axis = 0; axis < 3; ++axis)
    for (uint32_t i = 0; i < ends.receiver_capacity; ++i)
      planes.push_back(static_cast<float>(receivers[std::min(i, ends.receiver_count - 1)][axis]));
  ends.transmitters = context.buffer(quadruples(transmitters), "transmitters");
  ends.receivers = context.buffer(quadruples(receivers), "receivers");
  ends.receiver_planes = context.buffer(planes, "receiver planes");
  return ends;
}

}  // namespace wavetracer
