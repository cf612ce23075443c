// SPDX-License-Identifier: Apache-2.0
// Statistics of links from a links.csv that is written by hand.
#include "jobs/link_statistics.hpp"
#include <doctest/doctest.h>
#include <cmath>
#include <fstream>
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using test::TemporaryFolder;
using namespace wavetracer;

namespace {

const std::string header = "time_s,tx,rx,paths,path_gain_db,narrowband_gain_db,mean_delay_s,rms_delay_spread_s,los\n";

LinkStatistics read(const std::string& text, const Config& config = {}) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "links.csv") << text;
  return link_statistics(folder.path() / "links.csv", config);
}

}  // namespace

TEST_CASE("quantiles are those of numpy.quantile") {
  CHECK(quantiles({}).median == 0);
  CHECK(quantiles({7}).low == 7);
  const Quantiles q = quantiles({4, 1, 3, 2});  // numpy.quantile([1, 2, 3, 4], [.1, .5, .9])
  CHECK(q.low == doctest::Approx(1.3));
  CHECK(q.median == doctest::Approx(2.5));
  CHECK(q.high == doctest::Approx(3.7));
}

TEST_CASE("links are counted, and each pair is there once, by its mean power") {
  const LinkStatistics s = read(header +
                                "0,a,\"b, c\",2,-80,-81,1e-6,2e-8,1\n"
                                "0,\"b, c\",a,2,-80,-81,1e-6,2e-8,1\n"
                                "0,rsu,a,0,-inf,-inf,nan,nan,0\n"
                                "1,rsu,a,1,-100,-100,1e-6,0,0\n"
                                "1,rsu,x,0,-inf,-inf,nan,nan,0\n"
                                "1,a,\"b, c\",1,-90,-90,1e-6,0,0\n");
  CHECK(s.asked == 6);
  CHECK(s.with_path == 4);
  CHECK(s.los == 2);
  CHECK(s.gain_db.median == doctest::Approx(-85));
  CHECK(s.delay_spread_s.median == doctest::Approx(1e-8));
  REQUIRE(s.pairs.size() == 2);  // rsu -> x has none
  CHECK(s.pairs[0].name == "a <-> b, c");
  CHECK(s.pairs[0].rows == 3);
  CHECK(s.pairs[0].los_rows == 2);
  CHECK(s.pairs[0].mean_gain_db == doctest::Approx(10 * std::log10((2e-8 + 1e-9) / 3)));
  CHECK(s.pairs[1].name == "rsu -> a");
  CHECK(s.pairs[1].mean_gain_db == doctest::Approx(-100));
}

TEST_CASE("a file of many blocks has the statistics of its rows, with line ends in names") {
  // Lines have 40 to 44 bytes: three blocks of 4 MiB and a bit. Every third row has a name with quotes and a line end.
  std::string text = header;
  constexpr uint64_t rows = 330'000;
  for (uint64_t i = 0; i < rows; ++i)
    text +=
        i % 3 == 0 ? "0,a,\"b \"\"\n,\",1,-80,-80,1e-6,2e-8,1\n" : "0,a,some name of a link,1,-90,-90,1e-6,4e-8,0\n";
  REQUIRE(text.size() > (12 << 20));
  const LinkStatistics s = read(text);
  CHECK(s.asked == rows);
  CHECK(s.los == rows / 3);
  CHECK(s.gain_db.high == -80);
  CHECK(s.gain_db.median == -90);
  REQUIRE(s.pairs.size() == 2);
  CHECK(s.pairs[0].name == "a -> b \"\n,");
  CHECK(s.pairs[0].rows == rows / 3);
  CHECK(s.pairs[0].mean_gain_db == doctest::Approx(-80));
  CHECK(s.pairs[1].mean_delay_spread_s == doctest::Approx(4e-8));
}

TEST_CASE("cells of a grid count once, with their best transmitter, and are no pairs") {
  Config config;
  config.receiver_grids.emplace_back();
  config.receiver_grids[0].name = "street";
  for (const char* name : {"street/0,0", "street/1,0", "street/2,0", "car"}) {
    config.receivers.emplace_back();
    config.receivers.back().name = name;
  }
  const LinkStatistics s = read(header +
                                    "0,a,\"street/0,0\",1,-70,-70,0,0,1\n0,a,\"street/1,0\",0,-inf,-inf,nan,nan,0\n"
                                    "0,a,\"street/2,0\",0,-inf,-inf,nan,nan,0\n0,a,car,1,-60,-60,0,0,1\n"
                                    "0,b,\"street/0,0\",1,-65,-65,0,0,1\n0,b,\"street/1,0\",1,-95,-95,0,0,1\n"
                                    "0,b,\"street/2,0\",0,-inf,-inf,nan,nan,0\n",
                                config);
  REQUIRE(s.grids.size() == 1);
  CHECK(s.grids[0].cells == 3);
  CHECK(s.grids[0].covered == 2);
  CHECK(s.grids[0].gain_db.median == doctest::Approx(-80));
  REQUIRE(s.pairs.size() == 1);
  CHECK(s.pairs[0].name == "a -> car");
}

TEST_CASE("a file that no run wrote is an error that names it and what is wrong") {
  const auto fails = [](const std::string& text, const char* message) {
    CHECK_THROWS_WITH_AS(read(text), doctest::Contains(message), RuntimeError);
  };
  fails("", "links.csv: it is empty");
  fails("time_s,tx\n", "it has no column rx");
  fails(header + "0,a,b\n", "rows differ in length");
  fails(header + "0,a,b,x,-80,-80,0,0,1\n", "\"x\" is not a number");
}
