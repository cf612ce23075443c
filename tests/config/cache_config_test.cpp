// SPDX-License-Identifier: Apache-2.0
// The ray cache, reception spheres and waypoints in config files: accepted and refused values, and the places of
// errors. Texts are written here by hand; lines and columns are counted in them, not computed by the parser.
#include <doctest/doctest.h>

#include <array>
#include <iterator>

#include "config/texts.hpp"

using namespace wavetracer;
using test::check_contains;
using test::ends;
using test::error_of;
using test::scene;

namespace {

// The message for one line about the cache; the line is the second of the file.
std::string of(const std::string& line) { return error_of(scene + line + "\n" + ends); }

}  // namespace

// The documented properties of each kind (docs/ray_caches.md, docs/design/ray_caches.md).
TEST_CASE("the questions about a cache, for each of its kinds") {
  struct Row {
    CacheKind kind;
    bool on, as_printed, linked, pooled, in_slots, in_buckets, evicts;
  };
  const Row rows[] = {
      {"none", false, false, false, false, false, false, false},
      {"chained", true, false, true, true, false, false, true},
      {"open", true, false, false, false, true, false, false},
      {"concurrent", true, false, false, false, false, true, true},
      {"thesis", true, true, false, false, true, false, false},
      {"thesis-chained", true, true, true, false, false, false, false},
  };
  REQUIRE(std::size(rows) == CacheKind::words.size());
  for (const Row& row : rows) {
    CAPTURE(row.kind.word());
    const CacheConfig cache{.kind = row.kind};
    CHECK(cache.on() == row.on);
    CHECK(cache.as_printed() == row.as_printed);
    CHECK(cache.linked() == row.linked);
    CHECK(cache.pooled() == row.pooled);
    CHECK(cache.in_slots() == row.in_slots);
    CHECK(cache.in_buckets() == row.in_buckets);
    CHECK(cache.evicts() == row.evicts);
  }
}

TEST_CASE("an exact key is purged by nothing, a quantised one by position or precision") {
  CHECK(CacheConfig{.key = "quantised", .purge = "position"}.by_position());
  CHECK(CacheConfig{.key = "quantised", .purge = "precision"}.by_precision());
  for (const CachePurging purge : std::to_array<CachePurging>({"position", "precision"})) {
    const CacheConfig exact{.key = "exact", .purge = purge};
    CHECK(exact.exact());
    CHECK(!exact.by_position());
    CHECK(!exact.by_precision());
    CHECK(CacheConfig{.purge = purge}.by_position() != CacheConfig{.purge = purge}.by_precision());
  }
}

TEST_CASE("every key of the cache is read, and the resolved config reads back the same") {
  const Config c = parse_config(scene + R"([cache]
kind = "open"
key = "quantised"
hash_method = 2
division = 2097151
buffer_size = 2147483648
load_factor = 1.5
locking = "mutex"
readers_number = 65535
purge = "precision"
position_step_m = 0.25
residual_value = 0.093
scope = "all"
hit_point = "cached"
first_depth = 2
innerframe = true
statistics = true
[output]
waypoints = 1e9
)" + ends,
                                "/data/a.toml");
  const auto check = [](const CacheConfig& cache) {
    CHECK(cache.kind.word() == "open");
    CHECK(cache.key.word() == "quantised");
    CHECK(cache.hash_method == 2);
    CHECK(cache.division == 2097151);
    CHECK(cache.buffer_size == 2147483648u);
    CHECK(cache.load_factor == 1.5);
    CHECK(cache.locking.word() == "mutex");
    CHECK(cache.readers_number == 65535);
    CHECK(cache.purge.word() == "precision");
    CHECK(cache.position_step_m == 0.25);
    CHECK(cache.residual_value == 0.093);
    CHECK(cache.scope.word() == "all");
    CHECK(cache.hit_point.word() == "cached");
    CHECK(cache.first_depth == 2);
    CHECK(cache.innerframe);
    CHECK(cache.statistics);
  };
  check(c.cache);
  check(parse_config(c.text, "/elsewhere/b.toml").cache);
  CHECK(c.output.waypoints == 1000000000);
}

TEST_CASE("every kind, key, lock, purge, scope and hit point is available") {
  for (const std::string kind : {"none", "chained", "open", "concurrent"})
    CHECK(of("cache.kind = \"" + kind + "\"") == "no error");
  const std::string open = "cache.kind = \"open\"\n";
  for (const std::string line :
       {"key = \"exact\"", "key = \"quantised\"", "locking = \"mutex\"", "locking = \"readers\"",
        "purge = \"position\"", "purge = \"precision\"", "scope = \"static\"", "scope = \"all\"", "hit_point = \"own\"",
        "hit_point = \"cached\"", "statistics = true", "buffer_size = 1000003"})
    CHECK(of(open + "cache." + line) == "no error");
  // These keys have no effect, as their doc says, but are no error.
  CHECK(of(open + "cache.key = \"exact\"\ncache.purge = \"precision\"\ncache.division = 7\n"
                  "cache.hit_point = \"cached\"") == "no error");
  CHECK(of(open + "cache.scope = \"all\"\ncache.hit_point = \"cached\"") == "no error");
}

TEST_CASE("numbers of the cache outside their range: value and limit are named, the ends are allowed") {
  struct Limit {
    std::string key, below, lower, upper, above, accepted;
  };
  const std::vector<Limit> limits = {
      {"hash_method", "0", "1", "3", "4", "an integer from 1 to 3"},
      {"division", "0", "1", "2097151", "2097152", "an integer from 1 to 2097151 (cells per direction component)"},
      {"buffer_size", "15", "16", "2147483648", "2147483649", "an integer from 16 to 2147483648 (entries)"},
      {"load_factor", "0.99", "1", "64", "64.5", "a number from 1 to 64 (entries per bucket)"},
      {"readers_number", "0", "1", "65535", "65536", "an integer from 1 to 65535 (reads)"},
      {"position_step_m", "0.0009", "0.001", "1000", "1001.0", "a number from 0.001 to 1000 (m)"},
      {"residual_value", "-0.1", "0", "1000000", "1e+300",
       "a number from 0 to 1000000 (L1 norm of metres and direction components)"},
      {"first_depth", "0", "1", "64", "65", "an integer from 1 to 64 (segments of a ray, counted from 1)"},
  };
  for (const Limit& limit : limits) {
    for (const std::string& value : {limit.below, limit.above}) {
      const size_t column = std::string("cache. = ").size() + limit.key.size() + 1;
      CHECK(of("cache." + limit.key + " = " + value) == "a.toml:2:" + std::to_string(column) + ": cache." + limit.key +
                                                            " = " + value + " is out of range: it must be " +
                                                            limit.accepted);
    }
    for (const std::string& value : {limit.lower, limit.upper})
      CHECK(of("cache." + limit.key + " = " + value) == "no error");
  }
  for (const std::string value : {"0", "1"})
    CHECK(of("cache.buffer_size = " + value) == "a.toml:2:21: cache.buffer_size = " + value +
                                                    " is out of range: it must be an integer from 16 to 2147483648 "
                                                    "(entries)");
  check_contains(of("cache.residual_value = nan"), "cache.residual_value = nan is out of range");
  check_contains(of("cache.position_step_m = inf"), "cache.position_step_m = inf is out of range");
  check_contains(of("cache.division = 1.5"),
                 "cache.division must be an integer from 1 to 2097151 (cells per direction");
  check_contains(of("cache.statistics = 1"), "cache.statistics must be true or false, not an integer");
  check_contains(of("output.waypoints = -1"), "output.waypoints = -1 is out of range: it must be an integer from 0");
  check_contains(of("output.waypoints = 1000000001"), "from 0 to 1000000000 (samples per transmitter)");
}

TEST_CASE("misspelt keys and words of the cache are hinted") {
  CHECK(of("cache.hitpoint = \"own\"") ==
        "a.toml:2:7: unknown key \"cache.hitpoint\"; did you mean \"cache.hit_point\"?");
  check_contains(of("cache.position_step = 1"), "did you mean \"cache.position_step_m\"?");
  check_contains(of("cache.reader_number = 1"), "did you mean \"cache.readers_number\"?");
  check_contains(of("output.waypoint = 1"), "did you mean \"output.waypoints\"?");
  CHECK(of("cache.key = \"quantized\"") ==
        "a.toml:2:13: cache.key = \"quantized\" is not a known value: it must be one of \"quantised\", \"exact\"; "
        "did you mean \"quantised\"?");
  check_contains(of("cache.kind = \"concurent\""), "did you mean \"concurrent\"?");
  check_contains(of("cache.locking = \"reader\""), "did you mean \"readers\"?");
  check_contains(of("cache.purge = \"presicion\""), "did you mean \"precision\"?");
  check_contains(of("cache.scope = \"statics\""), "did you mean \"static\"?");
  check_contains(of("cache.hit_point = \"chached\""), "did you mean \"cached\"?");
  check_contains(of("trace.reception = \"spere\""), "did you mean \"sphere\"?");
}

TEST_CASE("an exact key does not go with a cache that decides for what moves") {
  const std::string exact = "cache.key = \"exact\"\n", all = "cache.scope = \"all\"\n";
  CHECK(of("cache.kind = \"open\"\n" + exact + all) ==
        "a.toml:4:15: cache.key = \"exact\" gives the same paths as no cache, "
        "but with cache.scope = \"all\" moving vehicles would change them: remove cache.scope, "
        "or use cache.key = \"quantised\"");
  check_contains(of(all + "cache.kind = \"open\"\n" + exact),
                 "a.toml:4:13: cache.key = \"exact\" gives the same paths as no cache");
  CHECK(of(exact + all) == "no error");  // no cache
  for (const std::string kind : {"thesis", "thesis-chained"}) {
    check_contains(of("cache.kind = \"" + kind + "\"\n" + exact),
                   "cache.key = \"exact\" with cache.kind = \"" + kind + "\": the tables as the thesis prints them");
    CHECK(of("cache.kind = \"" + kind + "\"\n" + all) == "no error");
  }
}

TEST_CASE("a cache that would never be asked is refused") {
  const std::string kind = "cache.kind = \"concurrent\"\n";
  CHECK(of(kind + "trace.max_depth = 3\ncache.first_depth = 4") ==
        "a.toml:4:21: cache.first_depth = 4 is larger than trace.max_depth = 3, so the cache would never be used: "
        "lower the first, raise the second, or use cache.kind = \"none\"");
  CHECK(of(kind + "trace.max_depth = 3\ncache.first_depth = 3") == "no error");
  check_contains(of(kind + "trace.max_depth = 0"),
                 "a.toml:3:19: cache.first_depth = 1 is larger than trace.max_depth = 0");
  CHECK(of("trace.max_depth = 3\ncache.first_depth = 4") == "no error");  // no cache
  check_contains(error_of(scene + "trace.max_depth = 3\ncache.first_depth = 4\n" + ends, {"cache.kind=open"}),
                 "--set cache.kind=open: cache.first_depth = 4 is larger than");
}

TEST_CASE("reception spheres take whole rays that are spread evenly") {
  const std::string sphere = "trace.reception = \"sphere\"\n";
  const Config c = parse_config(scene + sphere + "trace.sphere_radius_m = 0.5\n" + ends, "a.toml");
  CHECK(c.trace.reception.word() == "sphere");
  CHECK(c.trace.sphere_radius_m == 0.5);
  CHECK(of(sphere + "trace.reuse = true") == "no error");
  CHECK(of("trace.rays = \"auto\"\ntrace.reception = \"exact\"") == "no error");
  CHECK(of(sphere + "trace.rays = \"auto\"") ==
        "a.toml:3:14: trace.reception = \"sphere\" needs rays that are spread evenly, "
        "but trace.rays = \"auto\" launches more rays where few sequences were found: give trace.rays a number, "
        "or use trace.reception = \"exact\"");
  check_contains(of("trace.sphere_radius_m = 0"), "it must be a number above 0 up to 10000 (m)");
}

TEST_CASE("entries of a cache are those of a cache that counts") {
  CHECK(of("output.cache_entries = true\ncache.kind = \"open\"\ncache.statistics = true") == "no error");
  CHECK(of("output.cache_entries = true") ==
        "a.toml:2:24: output.cache_entries = true writes what the ray cache counted for each entry, "
        "but cache.kind = \"none\": choose a kind of cache with cache.statistics = true, "
        "or remove output.cache_entries");
  CHECK(of("output.cache_entries = true\ncache.kind = \"open\"") ==
        "a.toml:2:24: output.cache_entries = true writes what the ray cache counted for each entry, "
        "but cache.statistics = false: set it to true, or remove output.cache_entries");
}

TEST_CASE("waypoints are those of a known number of rays") {
  CHECK(of("output.waypoints = 100") == "no error");
  CHECK(of("output.waypoints = 100\ntrace.rays = \"auto\"") ==
        "a.toml:3:14: output.waypoints = 100 selects rays evenly from a known number of rays, "
        "but with trace.rays = \"auto\" that number is not known: give trace.rays a number, "
        "or remove output.waypoints");
  CHECK(of("output.waypoints = 0\ntrace.rays = \"auto\"") == "no error");
}
