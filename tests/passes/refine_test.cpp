// SPDX-License-Identifier: Apache-2.0
// refine: ends counted, rare samples marked and cells split, against plain code; and cells that four finer ones tile.
// Ends are invented; no ray is traced.
#include "passes/refine.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "passes/host_launch.hpp"
#include "passes/launch_directions.hpp"
#include "passes/on_device.hpp"
#include "passes/triangles.hpp"
#include "wavetracer/device/directions.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint32_t slots = 512;

struct Samples {
  std::vector<uint32_t> cells, launchers, ends;
};

// The samples have two launchers; a third one ends in roots, and some sequences end far more samples than others.
Samples random_samples(size_t count, uint32_t level, uint32_t seed) {
  Random random(seed);
  Samples out;
  for (size_t i = 0; i < count; ++i) {
    out.cells.push_back(random.below(sample_faces << (2 * level)));
    out.launchers.push_back(random.below(2));
    const double u = random();
    out.ends.push_back(random() < 0.3 ? WT_ROOT | out.launchers.back() : static_cast<uint32_t>(u * u * u * slots));
  }
  return out;
}

SampleList upload(const Samples& samples, uint32_t level) {
  SampleList list = make_sample_list(context(), samples.cells.size());
  list.samples.write(samples.cells);
  list.samples.write(samples.launchers, list.capacity);
  list.ends.write(samples.ends);
  list.count = static_cast<uint32_t>(samples.cells.size());
  list.level = level;
  return list;
}

gpu::Buffer<uint32_t> no_hits() { return context().buffer(std::vector<uint32_t>(slots, 0), "hits"); }

}  // namespace

TEST_CASE("ends are counted over all levels, roots left out") {
  Refine refine(context());
  gpu::Buffer<uint32_t> hits = no_hits();
  std::vector<uint32_t> expected(slots, 0);
  for (const uint32_t count : {1u, 63u, 64u, 700u}) {
    CAPTURE(count);
    const Samples samples = random_samples(count, 4, count);
    refine.count_ends(upload(samples, 4), hits);
    for (const uint32_t end : samples.ends)
      if (!(end & WT_ROOT)) ++expected[end];
    CHECK(hits.read() == expected);
    const MetSequences met = refine.met(hits);
    CHECK(met.once == std::count(expected.begin(), expected.end(), 1u));
    CHECK(met.all == std::count_if(expected.begin(), expected.end(), [](uint32_t n) { return n > 0; }));
  }
  const MetSequences none = refine.met(no_hits());
  CHECK(none.once == 0);
  CHECK(none.all == 0);
}

TEST_CASE("samples whose end is rare are marked, and those that hit nothing never") {
  Refine refine(context());
  const Samples samples = random_samples(900, 4, 5);
  const SampleList level = upload(samples, 4);
  gpu::Buffer<uint32_t> hits = no_hits();
  refine.count_ends(level, hits);
  std::map<uint32_t, uint32_t> count;
  for (const uint32_t end : samples.ends) ++count[end];
  for (const uint32_t rare : {1u, 2u, 8u}) {
    gpu::Buffer<float> marks = context().buffer<float>(level.count, "marks");
    refine.mark(level, hits, rare, marks);
    const std::vector<float> got = marks.read();
    size_t wrong = 0, marked = 0;
    for (uint32_t i = 0; i < level.count; ++i) {
      const bool wanted = !(samples.ends[i] & WT_ROOT) && count[samples.ends[i]] <= rare;
      wrong += std::bit_cast<uint32_t>(got[i]) != (wanted ? i : WT_NONE);
      marked += wanted;
    }
    CAPTURE(rare);
    CHECK(wrong == 0);
    CHECK(marked > 20);
    CHECK(marked < 600);
  }
}

TEST_CASE("listed samples become four each, a level further down, for the same launcher") {
  Refine refine(context());
  const Samples samples = random_samples(500, 6, 7);
  const SampleList level = upload(samples, 6);
  std::vector<uint32_t> listed;
  for (uint32_t i = 2; i < 500; i += 3) listed.push_back(i);
  const auto count = static_cast<uint32_t>(listed.size());
  SampleList next = make_sample_list(context(), 4 * count);
  refine.split(level, context().buffer(listed, "listed"), count, next);
  CHECK(next.count == 4 * count);
  CHECK(next.level == 7);
  const std::vector<uint32_t> cells = next.samples.read(0, next.count);
  const std::vector<uint32_t> launchers = next.samples.read(next.capacity, next.count);
  size_t wrong = 0;
  for (uint32_t k = 0; k < next.count; ++k)
    wrong += cells[k] != 4 * samples.cells[listed[k / 4]] + k % 4 || launchers[k] != samples.launchers[listed[k / 4]];
  CHECK(wrong == 0);
}

TEST_CASE("the four cells of a cell tile it") {
  // The cell of the lattice of equal areas of `of_level` in which the direction of a cell of `level` lies.
  const auto map_of = [](uint32_t level) { return HostLaunch("hilbert", uint64_t{sample_faces} << (2 * level), 0); };
  const auto place = [&](uint32_t cell, uint32_t level, uint32_t of_level) {
    const HostLaunch map = map_of(level), lattice = map_of(of_level);
    const device::wt_direction d = map.direction(cell);
    const double turn = std::atan2(double{d.y}, double{d.x}) / (2 * std::numbers::pi);
    const double size = std::ldexp(1, static_cast<int>(lattice.level));
    return std::pair{static_cast<int>((turn < 0 ? turn + 1 : turn) * lattice.faces * size),
                     static_cast<int>((1 - double{d.z}) / 2 * size)};
  };
  Random random(9);
  for (const uint32_t level : {1u, 6u, 9u}) {
    size_t outside = 0, shared = 0;
    for (int i = 0; i < 200; ++i) {
      const uint32_t cell = random.below(sample_faces << (2 * level));
      std::set<std::pair<int, int>> fine;
      for (uint32_t k = 0; k < 4; ++k) {
        outside += place(4 * cell + k, level + 1, level) != place(cell, level, level);
        fine.insert(place(4 * cell + k, level + 1, level + 1));
      }
      shared += 4 - fine.size();
    }
    CAPTURE(level);
    CHECK(outside == 0);
    CHECK(shared == 0);
  }
}
