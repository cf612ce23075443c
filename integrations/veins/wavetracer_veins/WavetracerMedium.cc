// SPDX-License-Identifier: Apache-2.0
#include "WavetracerMedium.h"

namespace wavetracer {

Define_Module(WavetracerMedium);

}  // namespace wavetracer
