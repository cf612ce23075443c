// SPDX-License-Identifier: Apache-2.0
// `wavetracer devices --check`: reports the check of what each device computes.
#pragma once
#include <string>

namespace wavetracer::app {

// Checks the device of this text (--device), or all if it is empty, and prints a line per check. Returns false if a
// device computes wrong results or, if it was asked for, cannot be used. Throws DeviceError if there is no such device.
bool check_devices(const std::string& device_text);

}  // namespace wavetracer::app
