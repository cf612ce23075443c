// SPDX-License-Identifier: Apache-2.0
// The hash covers all text before the comma of the key.
#include "jobs/checked_text.hpp"
#include <fmt/format.h>
#include <span>
#include "base/hash.hpp"

namespace wavetracer {
namespace {

std::string ending_of(std::string_view text) {
  ContentHash hash;
  hash.add(std::as_bytes(std::span(text)));
  return fmt::format(",\"check\":\"{:016x}\"}}", hash.value());
}

}  // namespace

std::string with_check(std::string object) {
  object.pop_back();
  const std::string ending = ending_of(object);
  return object + ending;
}

bool check_fits(std::string_view text) {
  text = text.substr(0, text.find_last_not_of(" \r\n") + 1);
  const size_t length = ending_of("").size();
  if (text.size() < length) return false;
  const std::string_view object = text.substr(0, text.size() - length);
  return text.substr(object.size()) == ending_of(object);
}

}  // namespace wavetracer
