// SPDX-License-Identifier: Apache-2.0
#include "live_recall.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace wavetracer::bench {
namespace {

using DelaysAndPowers = std::vector<std::pair<double, double>>;

std::map<std::string, DelaysAndPowers> rows_of(const nlohmann::json& answer) {
  std::map<std::string, DelaysAndPowers> out;
  for (const nlohmann::json& link : answer.at("links")) {
    DelaysAndPowers& to = out[link.at("tx").get<std::string>() + ">" + link.at("rx").get<std::string>()];
    for (size_t i = 0; i < link.at("delay_s").size(); ++i) {
      double power = 0;
      for (const char* part : {"a_re", "a_im"})
        for (const double value : link.at(part)[i]) power += value * value;
      to.emplace_back(link.at("delay_s")[i], power);
    }
  }
  return out;
}

}  // namespace

void LiveRecall::add(const nlohmann::json& from, const nlohmann::json& mine) {
  auto candidates_of = rows_of(mine);
  for (const auto& [link, all] : rows_of(from))
    for (const auto& [delay_s, path_power] : all) {
      DelaysAndPowers& candidates = candidates_of[link];
      const auto match = std::ranges::find_if(
          candidates, [&, delay = delay_s](const auto& row) { return std::abs(row.first - delay) <= 1e-12; });
      reference++;
      power += path_power;
      if (match == candidates.end()) continue;
      found++;
      found_power += path_power;
      candidates.erase(match);
    }
}

}  // namespace wavetracer::bench
