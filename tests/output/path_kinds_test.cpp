// SPDX-License-Identifier: Apache-2.0
// Paths by their most special interaction: every mixture, and sums over the shards of a drive.
#include "output/path_kinds.hpp"
#include <doctest/doctest.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include "jobs/shards.hpp"
#include "output/reader.hpp"
#include "output/sample_run.hpp"
#include "temporary_folder.hpp"

using namespace wavetracer;
using test::slurp;
using test::TemporaryFolder;
using Json = nlohmann::json;

namespace {

std::string kind_of(const std::vector<uint8_t>& interactions) {
  Paths paths;
  paths.delay_s = {0};
  paths.vertex_interaction = interactions;
  paths.vertex_offset = {0, interactions.size()};
  return std::string(path_kinds[path_kind(paths, 0)].word);
}

// A drive whose even frames diffract at every vertex, and whose odd ones scatter.
std::vector<FrameResult> mixed_drive(const SampleRun& sample, uint32_t first, uint32_t count) {
  std::vector<FrameResult> frames = sample.drive(first, count);
  for (FrameResult& frame : frames) {
    Paths& paths = frame.paths;
    for (size_t i = 0; i < paths.size(); ++i)
      for (size_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
        paths.vertex_interaction[k] = frame.frame % 2 == 0 ? diffraction : scattering;
  }
  return frames;
}

}  // namespace

TEST_CASE("a path counts by its most special interaction, wherever in the path that is") {
  CHECK(kind_of({}) == "line_of_sight");
  CHECK(kind_of({reflection, reflection}) == "reflected");
  CHECK(kind_of({transmission}) == "transmitted");
  CHECK(kind_of({reflection, transmission, reflection}) == "transmitted");
  CHECK(kind_of({diffraction}) == "diffracted");
  CHECK(kind_of({transmission, reflection, diffraction}) == "diffracted");
  CHECK(kind_of({diffraction, transmission}) == "diffracted");
  CHECK(kind_of({scattering}) == "scattered");
  CHECK(kind_of({diffraction, scattering, transmission}) == "scattered");
}

TEST_CASE("paths by kind add up over frames, whether written at once, in shards or resumed") {
  const SampleRun sample;
  const std::vector<FrameResult> all = mixed_drive(sample, 3, 10);
  PathKindCounts expected{};
  const auto number = [](std::string_view word) {
    return static_cast<size_t>(std::ranges::find(path_kinds, word, &PathKind::word) - path_kinds.begin());
  };
  const size_t diffracted = number("diffracted"), scattered = number("scattered");
  uint64_t paths = 0;
  for (const FrameResult& frame : all) {
    const Paths& p = frame.paths;
    for (size_t i = 0; i < p.size(); ++i)
      ++expected[p.depth[i] == 0 ? 0 : frame.frame % 2 == 0 ? diffracted : scattered];
    paths += p.size();
  }
  REQUIRE((expected[0] > 0 && expected[diffracted] > 0 && expected[scattered] > 0));

  const TemporaryFolder folder;
  const RunIdentity identity = sample_identity(12);
  Shards(folder.path() / "drive", identity).write(sample.run(), mixed_drive(sample, 3, 4));
  Shards again(folder.path() / "drive", identity);
  REQUIRE(again.resume() == 1);
  again.write(sample.run(), mixed_drive(sample, 7, 3));
  const auto drive = merge_interrupted(again, sample.run(), mixed_drive(sample, 10, 3));
  const auto whole = write_outputs(folder.path() / "whole", sample.run(), all);
  for (const auto& written : {drive, whole}) {
    const Json summary = Json::parse(slurp(written[2]));
    for (size_t i = 0; i < path_kinds.size(); ++i) {
      CAPTURE(path_kinds[i].word);
      CHECK(summary["paths_by_kind"][std::string(path_kinds[i].word)] == expected[i]);
    }
    CHECK(summary["counts"]["paths"] == paths);
  }
}
