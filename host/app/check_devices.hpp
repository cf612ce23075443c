// `wavetracer devices --check`: what each device computes, in words.
#pragma once
#include <string>

namespace wavetracer::app {

// Checks the device of this text (--device), or all if it is empty, and prints a line a check. False where a device
// computes wrong results or, if it was asked for, cannot be used. Throws DeviceError where there is no such device.
bool check_devices(const std::string& device_text);

}  // namespace wavetracer::app
