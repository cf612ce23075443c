// SPDX-License-Identifier: Apache-2.0
// The peer of the trace benchmark: nearest hits by Embree 3 on all cores, in the settings that a user would tune it to.
// Rays must be finite with unit directions; it is compiled only if CMake found Embree.
#pragma once
#include <embree3/rtcore.h>

#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "accel/triangles.hpp"
#include "segments.hpp"

namespace wavetracer::bench {

struct EmbreeConfig {
  std::string name;           // name in reports
  std::string device;         // the text for rtcNewDevice
  unsigned width = 1;         // rays per call: 1, 8 or 16
  bool coherent = false;      // tells Embree that neighbouring rays have similar directions
  bool robust = false;        // RTC_SCENE_FLAG_ROBUST: its watertight mode
  bool high_quality = false;  // RTC_BUILD_QUALITY_HIGH: spatial splits
};

// Returns every setting worth trying on this CPU: single rays (AVX2, bvh8.triangle4, which measured best for them) and
// packets of 8 and 16 at the widest instruction set, each fast and robust, with and without spatial splits.
std::vector<EmbreeConfig> embree_configs();

class EmbreePeer {
 public:
  // Builds Embree's tree. Throws RuntimeError with Embree's own message if that fails.
  EmbreePeer(std::span<const AccelTriangle> triangles, EmbreeConfig config);

  const EmbreeConfig& config() const { return config_; }
  // Finds nearest hits; hits has as many elements as rays. Returns the seconds of tracing alone: the rays are laid out
  // for packets beforehand, because a program built around Embree would store them like that.
  double trace(std::span<const Ray> rays, std::span<Hit> hits) const;

 private:
  template <auto Release, class Handle>
  struct Releaser {
    using pointer = Handle;
    void operator()(Handle handle) const { Release(handle); }
  };
  EmbreeConfig config_;
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, Releaser<rtcReleaseDevice, RTCDevice>> device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, Releaser<rtcReleaseScene, RTCScene>> scene_;
  std::vector<uint32_t> primitive_;  // for triangle i

  double trace_single(std::span<const Ray> rays, std::span<Hit> hits) const;
  template <unsigned Width, class Packet, auto Intersect>
  double trace_packets(std::span<const Ray> rays, std::span<Hit> hits) const;
};

}  // namespace wavetracer::bench
