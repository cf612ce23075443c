// SPDX-License-Identifier: Apache-2.0
// The forked process of fuzz targets tells how each input ended, and whether that was in the library.
#include "fuzz/worker.hpp"
#include <doctest/doctest.h>
#include <hdf5.h>
#include <atomic>
#include <stdexcept>
#include <vector>

namespace wavetracer::fuzz {
namespace {

herr_t crash_in_library(hid_t, void*) {
  std::raise(SIGSEGV);
  return 0;
}

bool try_one(std::string_view input) {
  if (input == "fault") std::raise(SIGSEGV);
  if (input == "abort") std::abort();
  if (input == "refused") throw InputError("no");
  if (input == "exception") throw std::out_of_range("no");
  if (input == "forever")
    for (std::atomic<uint64_t> count = 0;;) ++count;
  if (input == "library") {
    // The library calls this function when it finds an error.
    H5Eset_auto2(H5E_DEFAULT, crash_in_library, nullptr);
    H5Fopen("/no/such/file", H5F_ACC_RDONLY, H5P_DEFAULT);
  }
  return input != "remains";
}

struct Ended {
  End end;
  size_t tried;
};

Ended run(const void* library, const std::vector<std::string>& inputs) {
  Worker worker(library, try_one);
  const End end = worker.run(inputs);
  return {end, worker.tried()};
}

TEST_CASE("a forked process tries inputs up to the first that ends it, and says how") {
  const void* const library = reinterpret_cast<const void*>(&H5open);
  const struct {
    std::string input;
    End end;
  } cases[] = {{"good", End::answer},         {"refused", End::answer},  {"remains", End::remains},
               {"exception", End::exception}, {"fault", End::elsewhere}, {"abort", End::elsewhere},
               {"forever", End::elsewhere},   {"library", End::library}};
  for (const auto& [input, end] : cases) {
    CAPTURE(input);
    const Ended found = run(library, {"good", "refused", input, "good"});
    CHECK(found.end == end);
    CHECK(found.tried == (end == End::answer ? 4 : 3));
  }
  CHECK(run(nullptr, {"library"}).end == End::elsewhere);
}

TEST_CASE("a process that a fault has ended does not harm the next one") {
  Worker worker(nullptr, try_one);
  CHECK(worker.run("fault") == End::elsewhere);
  CHECK(worker.run("good") == End::answer);
  CHECK(worker.tried() == 1);
}

}  // namespace
}  // namespace wavetracer::fuzz
