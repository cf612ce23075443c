// Fuzz target: a column of a CSV file. What it reads must not depend on where pieces end.
#include <cstdlib>
#include <cstring>
#include "fuzz/fuzz.hpp"
#include "results/csv_column.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  const std::string_view text = fuzz::text_of(data, size);
  CsvColumn whole("missed_power_share"), halves("missed_power_share");
  whole.read(text);
  halves.read(text.substr(0, size / 2));
  halves.read(text.substr(size / 2));
  if (whole.finish() != halves.finish() || whole.values().size() != halves.values().size()) std::abort();
  const size_t bytes = whole.values().size() * sizeof(double);
  if (bytes > 0 && std::memcmp(whole.values().data(), halves.values().data(), bytes) != 0) std::abort();
  return 0;
}
