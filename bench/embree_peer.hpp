// The peer of the trace benchmark: nearest hits by Embree 3 on all cores, in the settings a user would tune it to.
// Assumes finite rays with unit directions; compiled only where CMake found Embree.
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
  std::string name;           // how reports call it
  std::string device;         // the text for rtcNewDevice
  unsigned width = 1;         // rays a call: 1, 8 or 16
  bool coherent = false;      // tell Embree that neighbouring rays take the same way
  bool robust = false;        // RTC_SCENE_FLAG_ROBUST: its watertight mode
  bool high_quality = false;  // RTC_BUILD_QUALITY_HIGH: spatial splits
};

// Every setting worth trying on this CPU: single rays (AVX2, bvh8.triangle4, as measured best for them) and packets of
// 8 and 16 at the widest instruction set, each fast and robust, with and without spatial splits.
std::vector<EmbreeConfig> embree_configs();

class EmbreePeer {
 public:
  // Builds Embree's tree. Throws RuntimeError with Embree's own message where it refuses.
  EmbreePeer(std::span<const AccelTriangle> triangles, EmbreeConfig config);

  const EmbreeConfig& config() const { return config_; }
  // Nearest hits; hits has as many elements as rays. Returns the seconds of the tracing alone: the rays are laid out as
  // packets want them beforehand, because a program made around Embree would keep them so.
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
  std::vector<uint32_t> primitive_;  // of triangle i

  double trace_single(std::span<const Ray> rays, std::span<Hit> hits) const;
  template <unsigned Width, class Packet, auto Intersect>
  double trace_packets(std::span<const Ray> rays, std::span<Hit> hits) const;
};

}  // namespace wavetracer::bench
