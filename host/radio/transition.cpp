// SPDX-License-Identifier: Apache-2.0
// The same code as on devices: wavetracer/device/transition.h.
#include "radio/transition.hpp"

#include "wavetracer/device/transition.h"

namespace wavetracer {

std::complex<double> transition_over_root(double s) {
  const glm::dvec2 g = device::wt_transition_over_root(s);
  return {g.x, g.y};
}

}  // namespace wavetracer
