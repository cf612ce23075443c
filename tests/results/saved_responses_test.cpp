// SPDX-License-Identifier: Apache-2.0
// SavedResponses reads what [response] has written; damaged files are refused with a message, never trusted.
#include "results/saved_responses.hpp"
#include <doctest/doctest.h>
#include "contains.hpp"
#include "output/sample_elements.hpp"
#include "results/damage.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::overwrite;
using test::remove_member;

TEST_CASE("responses are read back frame by frame, and what is damaged is refused with words") {
  const test::TemporaryFolder folder;
  SampleElements sample;
  const std::vector<FrameResult>& frames = sample.filled;
  const auto written = [&](const char* name) {
    return write_outputs(folder.path() / name, sample.run(), frames)[0].parent_path() / "responses.h5";
  };
  const fs::path whole = written("whole");
  const SavedResponses responses(whole);
  CHECK(responses.times_s() == std::vector<double>{0, 1e-3});
  CHECK(responses.frequencies_hz() == response_frequencies_hz(sample.config));
  CHECK(responses.frame(99).empty());
  for (const FrameResult& frame : frames) {
    const std::vector<SavedResponse> links = responses.frame(frame.frame);
    REQUIRE(links.size() == frame.world.links.size());
    for (size_t i = 0; i < links.size(); ++i) {
      CHECK(links[i].link == frame.world.links[i]);
      REQUIRE(links[i].h.size() == 4 * sample_rows(sample.config, links[i].link));
      const uint64_t first = 4 * frame.responses.row_offset[i];
      for (size_t k = 0; k < links[i].h.size(); ++k)
        CHECK(links[i].h[k] == std::complex<double>(frame.responses.h[first + k]));
    }
  }
  CHECK(saved_responses(SavedRun(whole.parent_path())).has_value());
  fs::remove(whole);
  CHECK_FALSE(saved_responses(SavedRun(whole.parent_path())).has_value());

  const auto message = [](const fs::path& file) -> std::string {
    try {
      SavedResponses(file).frame(7);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  const fs::path offset = written("offset"), end = written("end"), order = written("order"), gone = written("gone"),
                 ports = written("ports");
  overwrite(offset, "/links/row_offset", 2, uint64_t{7});
  CHECK(contains(message(offset),
                 offset.string() + ": cannot be read as the responses.h5 of a run: row 1 of /links has"));
  overwrite(end, "/links/tx", 3, uint32_t{2});
  CHECK(contains(message(end), "row 3 of /links names an end that is not there"));
  overwrite(order, "/links/frame", 0, uint32_t{9});
  CHECK(contains(message(order), "/links/frame is not sorted"));
  remove_member(gone, "/responses/h_im");
  CHECK(contains(message(gone), "/responses/h_im"));
  overwrite(ports, "/receivers/ports", 0, uint32_t{3});
  CHECK(contains(message(ports), "/receivers has an end of no, or too many, elements or ports"));
  CHECK(contains(message(gone.parent_path() / "paths.h5"), "its format is not \"wavetracer responses\""));
}
