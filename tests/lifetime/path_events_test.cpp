// SPDX-License-Identifier: Apache-2.0
// The search for births and deaths in drives that are known: paths that exist from one time to another.
#include "jobs/path_events.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace wavetracer;

namespace {

// A path that exists from its birth to its death, in a drive in which everything moves by 10 m in each second.
struct Life {
  Link link;
  uint32_t number;
  double birth_s, death_s;
};
constexpr double speed_m_s = 10;

struct KnownDrive {
  std::vector<Life> lives;
  double share = 0.8;  // lifetimes are this share of the truth; 0: nothing is known
  uint64_t link_instants = 0;

  EventDrive drive() {
    const auto paths = [this](double time_s, const std::vector<Link>* only) {
      LinksAtTime out;
      for (const Life& life : lives) {
        if (only && !std::ranges::binary_search(*only, life.link)) continue;
        ++link_instants;
        if (time_s < life.birth_s || time_s >= life.death_s) continue;
        const double left_s = std::min(time_s - life.birth_s, life.death_s - time_s);
        out[life.link].emplace(Touched{{reflection, life.number, no_instance}}, share * speed_m_s * left_s);
      }
      return out;
    };
    return {paths, [](double from_s, double to_s) { return speed_m_s * std::abs(to_s - from_s); }};
  }
};

bool has(const EventList& list, const Life& life, bool birth, double time_s, double precision_s) {
  return std::ranges::any_of(list.events, [&](const PathEvent& event) {
    return event.link == life.link && event.birth == birth && event.path.at(0).thing == life.number &&
           std::abs(event.time_s - time_s) <= precision_s / 2;
  });
}

const std::vector<double> steps{0, 1, 2, 3};

}  // namespace

TEST_CASE("births and deaths have their times to the precision, and each is there once") {
  std::mt19937 engine(1);
  const auto between = [&](double low, double high) { return low + (high - low) * 0x1p-32 * double(engine()); };
  KnownDrive known;
  for (uint32_t k = 0; k < 60; ++k) {
    const double birth_s = between(-0.5, 2.5);
    known.lives.push_back({{k % 3, k % 7}, k, birth_s, birth_s + between(1.01, 2)});  // longer than a step
  }
  const EventList list = find_events(known.drive(), steps, {.precision = 1e-3});
  size_t expected = 0;
  for (const Life& life : known.lives)
    for (const bool birth : {true, false}) {
      const double time_s = birth ? life.birth_s : life.death_s;
      if (time_s <= 0 || time_s > 3) continue;
      CAPTURE(life.number);
      CHECK(has(list, life, birth, time_s, 1e-3));
      ++expected;
    }
  CHECK(list.events.size() == expected);
  CHECK(std::ranges::is_sorted(list.events, {}, &PathEvent::time_s));
}

TEST_CASE("a path that dies and comes back within a step is seen to, as its lifetimes do not cover the step") {
  KnownDrive known{{{{0, 0}, 7, -1, 0.40}, {{0, 0}, 7, 0.55, 2.9}}};
  const EventList list = find_events(known.drive(), steps, {});
  CHECK(has(list, known.lives[0], false, 0.40, 1e-3));
  CHECK(has(list, known.lives[1], true, 0.55, 1e-3));
  CHECK(list.events.size() == 3);
}

TEST_CASE("a gap that is shorter than the finest piece is counted, not lost in silence") {
  KnownDrive known{{{{0, 0}, 7, -1, 0.401}, {{0, 0}, 7, 0.402, 5}}};
  const EventList coarse = find_events(known.drive(), steps, {.finest = 0.25});
  CHECK(coarse.events.empty());
  CHECK(coarse.unsure > 0);
  const EventList fine = find_events(known.drive(), steps, {.precision = 1e-4, .finest = 5e-4});
  CHECK(fine.events.size() == 2);
}

TEST_CASE("a path that lives for less than a step is found where the step has parts") {
  KnownDrive known{{{{0, 0}, 1, 1.30, 1.43}}};
  CHECK(find_events(known.drive(), steps, {}).events.empty());
  const EventList list = find_events(known.drive(), steps, {.parts = 8});
  CHECK(list.events.size() == 2);
  CHECK(has(list, known.lives[0], true, 1.30, 1e-3));
  CHECK(has(list, known.lives[0], false, 1.43, 1e-3));
}

TEST_CASE("links whose lifetimes cover the steps are computed at the frames alone") {
  KnownDrive known{{{{0, 0}, 1, -100, 100}, {{0, 1}, 1, -100, 1.5}}};
  const EventList list = find_events(known.drive(), steps, {});
  CHECK(list.events.size() == 1);
  CHECK(list.unsure == 0);
  CHECK(known.link_instants < 2 * 4 + 60);
  // Without lifetimes nothing is cut for them, and it is said.
  KnownDrive unknown{{{{0, 0}, 1, -100, 100}}, 0};
  const EventList blind = find_events(unknown.drive(), steps, {});
  CHECK(blind.instants == 4);
  CHECK(blind.unbounded == 3);
  CHECK(find_events(unknown.drive(), {}, {}).events.empty());
}
