// SPDX-License-Identifier: Apache-2.0
// The transition function of one edge together with its derivative, from one pass over the rows of its polynomial.
#pragma once
#include "wavetracer/device/transition.h"

namespace wavetracer {

struct SlopedTransition {
  device::wt_double2 value, slope;  // value: that of wt_transition_over_root, bit for bit
};
SlopedTransition sloped_transition(double s);

}  // namespace wavetracer
