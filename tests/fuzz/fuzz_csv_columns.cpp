// SPDX-License-Identifier: Apache-2.0
// Fuzz target: columns of a CSV file. The result must not depend on where pieces end.
#include <cstdlib>
#include <cstring>
#include "fuzz/fuzz.hpp"
#include "results/csv_columns.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  const std::string_view text = fuzz::text_of(data, size);
  const std::vector<std::string> names{"missed_power_share", "los"};
  CsvColumns whole(names), halves(names);
  whole.read(text);
  halves.read(text.substr(0, size / 2));
  halves.read(text.substr(size / 2));
  whole.finish();
  halves.finish();
  for (size_t i = 0; i < names.size(); ++i) {
    const std::vector<double>&a = whole.values(i), &b = halves.values(i);
    if (whole.has(i) != halves.has(i) || a.size() != b.size()) std::abort();
    if (!a.empty() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) != 0) std::abort();
    if (whole.has(0) && whole.has(i) && a.size() != whole.values(0).size()) std::abort();
  }
  return 0;
}
