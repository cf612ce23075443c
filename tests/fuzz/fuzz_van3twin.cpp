// SPDX-License-Identifier: Apache-2.0
// Fuzz target: datagrams of VaN3Twin's protocol, one a line, and the vehicles that they place. An answer has at most 99
// bytes, and there are never more vehicles than places.
#include <cstdlib>

#include "fuzz/fuzz.hpp"
#include "live/van3twin_message.hpp"
#include "live/van3twin_traffic.hpp"
#include "wavetracer/config.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer::live::van3twin;
  static const std::vector<wavetracer::LiveType> types{{"car", 4, 2, 1.5, 0, 3, {}}, {"bus", 12, 2.5, 3, 3, 1, {}}};
  static const wavetracer::LiveBounds bounds{{-100, -100, -1}, {100, 100, 10}};
  Traffic traffic(types, bounds, {});
  std::string_view text = wavetracer::fuzz::text_of(data, size);
  while (!text.empty()) {
    const size_t end = text.find('\n');
    const auto message = parse(text.substr(0, end));
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    if (!message) continue;
    if (const auto* update = std::get_if<LocationUpdate>(&*message)) {
      traffic.update(*update);
      if (confirmation(*update).size() > 99) std::abort();
    } else if (const auto* question = std::get_if<Question>(&*message)) {
      if (answer(*question, Link{}).size() > 99 || traffic.poses().size() != traffic.size()) std::abort();
    }
    if (traffic.size() > 4) std::abort();
  }
  return 0;
}
