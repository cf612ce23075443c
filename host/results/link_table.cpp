// SPDX-License-Identifier: Apache-2.0
// A line of links.csv is a row of /links, in the same order; another number of lines means another run.
// Fields that are no numbers become NaN.
#include "results/link_table.hpp"
#include <fmt/format.h>
#include <filesystem>
#include <fstream>
#include "base/input_file.hpp"
#include "results/csv_columns.hpp"

namespace wavetracer {
namespace {

struct NamedColumn {
  const char* name;
  std::vector<double> LinkTable::*values;
};

constexpr NamedColumn named_columns[] = {
    {"paths", &LinkTable::paths},
    {"path_gain_db", &LinkTable::path_gain_db},
    {"narrowband_gain_db", &LinkTable::narrowband_gain_db},
    {"rms_delay_spread_s", &LinkTable::rms_delay_spread_s},
    {"los", &LinkTable::los},
    {"missed_power_share", &LinkTable::missed_power_share},
    {"left_out_power_share", &LinkTable::left_out_power_share},
    {"tx_beam", &LinkTable::tx_beam},
    {"rx_beam", &LinkTable::rx_beam},
    {"beam_gain_db", &LinkTable::beam_gain_db},
    {"k_factor_db", &LinkTable::k_factor_db},
};

}  // namespace

LinkTable link_table(const SavedRun& run) {
  const std::filesystem::path file = run.file().parent_path() / "links.csv";
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  const auto without = [&](const std::string& problem) {
    LinkTable none;
    none.warning = fmt::format(
        "{}: {}; figures of links are those of the paths in paths.h5, and what was missed on links is not shown",
        file.string(), problem);
    return none;
  };
  if (const std::string problem = input_file_problem(file, "the links.csv of a run"); !problem.empty())
    return without(problem);
  std::vector<std::string> names;
  for (const NamedColumn& column : named_columns) names.emplace_back(column.name);
  std::ifstream in(file, std::ios::binary);
  CsvColumns columns(names);
  std::vector<char> piece(1 << 20);
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0)
    columns.read({piece.data(), static_cast<size_t>(in.gcount())});
  if (in.bad() || !in.eof()) return without("cannot be read to its end");
  columns.finish();
  LinkTable out;
  for (size_t i = 0; i < names.size(); ++i) {
    if (!columns.has(i)) continue;
    if (columns.values(i).size() != run.link_count())
      return without(fmt::format("has {} links and paths.h5 has {}, so they are not of one run",
                                 columns.values(i).size(), run.link_count()));
    out.*named_columns[i].values = columns.values(i);
  }
  return out;
}

}  // namespace wavetracer
