// SPDX-License-Identifier: Apache-2.0
// Beams: DFT codebooks by their directions, codebook files by their content.
#include "radio/beams.hpp"

#include "contains.hpp"
#include "radio/array_world.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

// Broadside of a panel is +x; beam 1 of four columns half a wavelength apart is at asin(1 / (4 / 2)) = 30 degrees.
TEST_CASE("beams of a DFT codebook are orthogonal, and each has the gain of all elements in its own direction") {
  const Codebook book = dft_codebook(2, 4);
  REQUIRE(book.beams == 8);
  REQUIRE(book.weights.size() == 64);
  for (uint32_t a = 0; a < 8; ++a)
    for (uint32_t b = 0; b < 8; ++b) {
      Complex product = 0;
      for (uint32_t e = 0; e < 8; ++e) product += book.weights[8 * a + e] * std::conj(book.weights[8 * b + e]);
      CHECK(std::abs(product - Complex(a == b)) < 1e-14);
    }
  for (const double side : {-1.0, 1.0}) {
    ArrayWorld world(panel(1, 4), panel(1, 4), {0, 0, 0}, {1e4 * std::cos(30 * radians), side * 5e3, 0}, {0, 0, 0},
                     {180, 0, 0});
    world.config.arrays[0].codebook = world.config.arrays[1].codebook = "dft";
    world.add_path(0, 0, {}, {}, {});
    const FrameResult frame = world.frame();
    const BeamRows rows = Beams(world.config).gains(ElementModel(world.config, world.scene), frame);
    REQUIRE(rows.size() == 16);
    for (size_t i = 0; i < 16; ++i) {
      // The receiver faces the transmitter, and so sees it on its other side: beams 1 and 3 are at +30 and -30 degrees.
      const bool best = rows.tx_beam[i] == (side > 0 ? 1u : 3u) && rows.rx_beam[i] == (side > 0 ? 1u : 3u);
      CAPTURE(i);
      if (best)
        CHECK(rows.gain_db[i] == doctest::Approx(frame.paths.gain_db[0] + 10 * std::log10(16.0)).epsilon(1e-6));
      else
        CHECK(rows.gain_db[i] < frame.paths.gain_db[0] - 20);
    }
  }
}

TEST_CASE("a codebook file: weights of unit power, and errors that name the line") {
  const TemporaryFolder folder;
  const auto file = [&](const std::string& text) { return folder.write("book.csv", text).string(); };
  const Codebook book =
      load_codebook(file("beam,element,re,im\r\n# a comment\n\n1,0, 3,0\n1,2,0,-4\n0,1,1e-200,0\n"), 3);
  REQUIRE(book.beams == 2);
  CHECK(load_codebook(file("\xEF\xBB\xBF"
                           "beam,element,re,im\n1,0, 3,0\n1,2,0,-4\n0,1,1e-200,0\n"),
                      3)
            .weights == book.weights);  // with a byte order mark
  const std::vector<Complex> wanted{0, 1, 0, 0.6, 0, Complex(0, -0.8)};
  for (size_t i = 0; i < 6; ++i) CHECK(std::abs(book.weights[i] - wanted[i]) < 1e-15);
  const auto error = [&](const std::string& text) -> std::string {
    try {
      load_codebook(file(text), 3);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  const std::string head = "beam,element,re,im\n";
  CHECK(contains(error(""), "the codebook"));
  CHECK(contains(error("beam,re\n"), "book.csv:1: a codebook begins with the header beam,element,re,im"));
  CHECK(contains(error(head + "0,3,1,0\n"), "book.csv:2: element 3 is not there: the array has 3"));
  CHECK(contains(error(head + "0,1,1,0\n0,1,1,0\n"), "book.csv:3: element 1 of beam 0 has a weight already"));
  CHECK(contains(error(head + "0,1,1\n"), "a row needs four values"));
  CHECK(contains(error(head + "-1,1,1,0\n"), "\"-1\" in column beam is not the number of a beam"));
  CHECK(contains(error(head + "0,1,nan,0\n"), "\"nan\" in column re is not a finite number"));
  CHECK(contains(error(head + "1,1,1,0\n"), "beam 0 has no weight but 0"));
  CHECK(contains(error(head + "65536,1,1,0\n"), "beam 65536 is one too many"));
  CHECK(contains(error(head), "the codebook has no rows"));
}
