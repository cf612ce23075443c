// SPDX-License-Identifier: Apache-2.0
// The errors of wavetracer: each class knows the exit code that the program returns for it.
// A message says what is wrong, where (file, line, element) and what to do about it.
#pragma once
#include <stdexcept>
#include <string>

namespace wavetracer {

enum class ExitCode : int { ok = 0, runtime = 1, usage = 2, input = 3, device = 4, partial = 5, interrupted = 130 };

class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

// Bad command line or config file.
struct ConfigError : Error {
  explicit ConfigError(const std::string& message) : Error(ExitCode::usage, message) {}
};
// Bad scene, antenna or trajectory file.
struct InputError : Error {
  explicit InputError(const std::string& message) : Error(ExitCode::input, message) {}
};
// No device, no memory on it, a kernel that does not build.
struct DeviceError : Error {
  explicit DeviceError(const std::string& message) : Error(ExitCode::device, message) {}
};
// Anything else that stops a run: a full disk, an exceeded limit.
struct RuntimeError : Error {
  explicit RuntimeError(const std::string& message) : Error(ExitCode::runtime, message) {}
};

}  // namespace wavetracer
