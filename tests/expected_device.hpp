// The driver that tests are meant to run on, where somebody has said so.
#pragma once
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "gpu/gpu.hpp"

namespace wavetracer::test {

// Throws std::runtime_error where WAVETRACER_TEST_PLATFORM names another platform than the device's: `./dev drivers`
// tries one driver at a time, and tests that ran on another one would prove nothing.
inline void require_expected_platform(const gpu::DeviceInfo& device) {
  const char* expected = std::getenv("WAVETRACER_TEST_PLATFORM");
  if (expected && device.platform != expected)
    throw std::runtime_error("tests are to run on " + std::string(expected) + ", not on " + device.name + " (" +
                             device.platform + ")");
}

}  // namespace wavetracer::test
