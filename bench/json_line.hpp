// SPDX-License-Identifier: Apache-2.0
// The output of a benchmark: one JSON object per line on standard output, with the same keys in every benchmark. All
// other output goes to standard error.
#pragma once
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "wavetracer/error.hpp"

namespace wavetracer::bench {

enum class Better { higher, lower };

struct Result {
  std::string bench;   // the program's name without bench_
  std::string name;    // the case
  std::string device;  // the device that it ran on
  double value = 0;
  std::string unit;
  Better better = Better::higher;
  std::string baseline;                  // the baseline that it is compared with; empty if there is none
  std::optional<double> baseline_value;  // in the same unit
  // The price of the speed, as the benchmark's documentation defines it; 0 if exact, NaN if it was not measured.
  double error = 0;
  std::string detail;                                               // a short remark for the table; may be empty
  nlohmann::ordered_json extra = nlohmann::ordered_json::object();  // fields of this benchmark alone
  bool exact = false;  // error counts wrong results, and a result with errors is refused
};

// Returns the command as a user would repeat it: the program without its folder, and its arguments.
inline std::string command_line(int argc, const char* const* argv) {
  std::string command = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; i++) command += std::string(" ") + argv[i];
  return command;
}

// ratio says how many times better the value is than the baseline's, whether a larger or a smaller value is better.
// If a result must be exact and is not, it throws RuntimeError, so that the benchmark fails.
inline void print(const Result& result, const std::string& command) {
  if (result.exact && result.error != 0)
    throw RuntimeError(result.name + ": " + std::to_string(static_cast<uint64_t>(result.error)) +
                       " elements are wrong, so its speed is not published");
  nlohmann::ordered_json line;
  line["bench"] = result.bench;
  line["case"] = result.name;
  line["device"] = result.device;
  line["value"] = result.value;
  line["unit"] = result.unit;
  line["baseline"] =
      result.baseline.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(result.baseline);
  line["baseline_value"] = nullptr;
  line["ratio"] = nullptr;
  if (result.baseline_value && *result.baseline_value > 0 && result.value > 0) {
    const double ratio = result.value / *result.baseline_value;
    line["baseline_value"] = *result.baseline_value;
    line["ratio"] = result.better == Better::higher ? ratio : 1 / ratio;
  }
  line["error"] = result.error;
  line["detail"] = result.detail;
  line.update(result.extra);
  line["command"] = command;
  const std::time_t now = std::time(nullptr);
  char date[32];
  std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  line["date"] = date;
  std::puts(line.dump().c_str());
  std::fflush(stdout);
}

}  // namespace wavetracer::bench
