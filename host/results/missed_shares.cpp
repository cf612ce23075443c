// A line of links.csv is a row of /links, in the same order; another number of lines means another run.
// Assumes nothing of the file but that: fields that are no numbers are NaN.
#include "results/missed_shares.hpp"
#include <fmt/format.h>
#include <cmath>
#include <filesystem>
#include <fstream>
#include "base/input_file.hpp"
#include "results/csv_column.hpp"

namespace wavetracer {

MissedShares missed_shares(const SavedRun& run) {
  const std::filesystem::path file = run.file().parent_path() / "links.csv";
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  const auto without = [&](const std::string& problem) {
    return MissedShares{{}, fmt::format("{}: {}; what was missed on links is not shown", file.string(), problem)};
  };
  if (const std::string problem = input_file_problem(file, "the links.csv of a run"); !problem.empty())
    return without(problem);
  std::ifstream in(file, std::ios::binary);
  CsvColumn column("missed_power_share");
  std::vector<char> piece(1 << 20);
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0)
    column.read({piece.data(), static_cast<size_t>(in.gcount())});
  if (in.bad() || !in.eof()) return without("cannot be read to its end");
  if (!column.finish()) return {};
  if (column.values().size() != run.link_count())
    return without(fmt::format("has {} links and paths.h5 has {}, so they are not of one run", column.values().size(),
                               run.link_count()));
  return {column.values(), ""};
}

}  // namespace wavetracer
