// SPDX-License-Identifier: Apache-2.0
// The driver that tests must run on, if the environment names one.
#pragma once
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "gpu/gpu.hpp"

namespace wavetracer::test {

// Throws std::runtime_error if WAVETRACER_TEST_PLATFORM names another platform than the device's: `./dev drivers` tests
// one driver at a time, and tests that ran on another one would prove nothing.
inline void require_expected_platform(const gpu::DeviceInfo& device) {
  const char* expected = std::getenv("WAVETRACER_TEST_PLATFORM");
  if (expected && device.platform != expected)
    throw std::runtime_error("tests are to run on " + std::string(expected) + ", not on " + device.name + " (" +
                             device.platform + ")");
}

}  // namespace wavetracer::test
