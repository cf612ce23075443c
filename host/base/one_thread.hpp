// SPDX-License-Identifier: Apache-2.0
// A member of objects that only the thread which made them may use. Their functions call check() first.
#pragma once
#include <stdexcept>
#include <string>
#include <thread>

namespace wavetracer {

class OneThread {
 public:
  // Throws std::logic_error on any other thread. what: names the object.
  void check(const char* what) const {
    if (std::this_thread::get_id() != owner_)
      throw std::logic_error(std::string(what) + " used by a thread that did not make it");
  }

 private:
  std::thread::id owner_ = std::this_thread::get_id();
};

}  // namespace wavetracer
