// SPDX-License-Identifier: Apache-2.0
// All cores handle blocks of rows, which are then joined in order: memory holds two numbers per row and a sum per pair,
// and the result does not depend on the number of cores. Columns are found by their names.
#include "jobs/link_statistics.hpp"
#include <fmt/format.h>
#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <string_view>
#include <unordered_map>
#include "base/stage_fault.hpp"
#include "jobs/csv_records.hpp"
#include "simulation/receiver_grid.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// A row of the file.
struct LinkFields {
  std::string_view tx, rx;
  double paths, gain_db, delay_spread_s;
  bool los;
};

// Sums of a pair of ends; tx and rx are those of its first row.
struct Sum {
  std::string tx, rx;
  bool forwards = false, backwards = false;
  double power = 0, delay_spread_s = 0;
  uint64_t rows = 0, los_rows = 0;

  void add(const Sum& other) {
    if (tx.empty()) tx = other.tx, rx = other.rx;
    const bool turned = tx != other.tx;
    forwards |= turned ? other.backwards : other.forwards;
    backwards |= turned ? other.forwards : other.backwards;
    power += other.power;
    delay_spread_s += other.delay_spread_s;
    rows += other.rows;
    los_rows += other.los_rows;
  }
};

using GridOf = std::unordered_map<std::string, size_t>;  // for each receiver of a grid, the number of the grid

// Sums over some rows.
struct LinkSums {
  uint64_t asked = 0, with_path = 0, los = 0;
  std::vector<double> gains_db, delay_spreads_s;
  std::unordered_map<std::string, Sum> pairs;       // keys are those of pair_name()
  std::unordered_map<std::string, double> best_db;  // for each receiver of a grid

  // Makes a name of both ends, the smaller one first.
  static void pair_name(std::string_view a, std::string_view b, std::string& name) {
    name.assign(std::min(a, b)) += '\0';
    name += std::max(a, b);
  }

  // names: a buffer for names.
  void add(const LinkFields& row, const GridOf& grid_of, std::string& names) {
    ++asked;
    names.assign(row.rx);
    Sum* sum = nullptr;
    double* best = nullptr;
    if (grid_of.contains(names)) {
      best = &best_db.try_emplace(names, -INFINITY).first->second;
    } else {
      pair_name(row.tx, row.rx, names);
      sum = &pairs[names];
      if (sum->tx.empty()) sum->tx = row.tx, sum->rx = row.rx;
      (sum->tx == row.tx ? sum->forwards : sum->backwards) = true;
    }
    if (row.paths == 0) return;
    ++with_path;
    los += row.los;
    if (!std::isfinite(row.gain_db)) return;
    gains_db.push_back(row.gain_db);
    if (std::isfinite(row.delay_spread_s)) delay_spreads_s.push_back(row.delay_spread_s);
    if (best) *best = std::max(*best, row.gain_db);
    if (!sum) return;
    sum->power += std::pow(10, row.gain_db / 10);
    sum->delay_spread_s += row.delay_spread_s;
    ++sum->rows;
    sum->los_rows += row.los;
  }

  // Adds the sums of the rows that follow.
  void add(const LinkSums& other) {
    asked += other.asked;
    with_path += other.with_path;
    los += other.los;
    gains_db.insert(gains_db.end(), other.gains_db.begin(), other.gains_db.end());
    delay_spreads_s.insert(delay_spreads_s.end(), other.delay_spreads_s.begin(), other.delay_spreads_s.end());
    for (const auto& [name, sum] : other.pairs) pairs[name].add(sum);
    for (const auto& [name, db] : other.best_db) {
      double& best = best_db.try_emplace(name, -INFINITY).first->second;
      best = std::max(best, db);
    }
  }
};

class Reader {
 public:
  Reader(const std::filesystem::path& path, const Config& config) : path_(path), config_(config) {
    for (const RadioEnd& end : config.receivers)
      for (size_t g = 0; g < config.receiver_grids.size(); ++g)
        if (grid_cell(config.receiver_grids[g].name, end.name)) grid_of_[end.name] = g;
  }

  LinkStatistics read() {
    using Block = std::shared_ptr<std::string>;
    using Sums = std::shared_ptr<LinkSums>;
    CsvBlocks blocks(path_);
    LinkSums all;
    StageFault fault;
    const auto next = tbb::make_filter<void, Block>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) {
      const auto block = std::make_shared<std::string>();
      bool more = false;
      fault.run([&] {
        more = blocks.next(*block);
        if (header_.empty()) take_header(*block);
      });
      if (!more || fault.failed()) flow.stop();
      return block;
    });
    const auto sum = tbb::make_filter<Block, Sums>(tbb::filter_mode::parallel, [&](const Block& block) {
      const auto sums = std::make_shared<LinkSums>();
      fault.run([&] { add_rows(*block, *sums); });
      return sums;
    });
    const auto add = tbb::make_filter<Sums, void>(tbb::filter_mode::serial_in_order,
                                                  [&](const Sums& sums) { fault.run([&] { all.add(*sums); }); });
    tbb::parallel_pipeline(2 * static_cast<size_t>(tbb::info::default_concurrency()), next & sum & add);
    fault.rethrow();
    return statistics(std::move(all));
  }

 private:
  const std::filesystem::path& path_;
  const Config& config_;
  GridOf grid_of_;
  std::vector<std::string> header_;
  struct {
    size_t tx, rx, paths, gain, spread, los;
  } at_{};

  [[noreturn]] void fail(const std::string& why) const {
    throw RuntimeError(
        fmt::format("{}: {}, so the report cannot be made; was it changed by another program?", path_.string(), why));
  }
  size_t column(std::string_view name) const {
    const auto found = std::ranges::find(header_, name);
    if (found == header_.end()) fail(fmt::format("it has no column {}", name));
    return static_cast<size_t>(found - header_.begin());
  }
  double number(const std::string& text) const {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) fail("\"" + text + "\" is not a number");
    return value;
  }

  // Removes the header from the first block.
  void take_header(std::string& block) {
    std::string_view text = block;
    if (!take_record(text, header_)) fail("it is empty");
    at_ = {column("tx"), column("rx"), column("paths"), column("path_gain_db"), column("rms_delay_spread_s"),
           column("los")};
    block.erase(0, block.size() - text.size());
  }

  void add_rows(std::string_view block, LinkSums& sums) const {
    std::vector<std::string> fields;
    std::string names;
    while (take_record(block, fields)) {
      if (fields.size() != header_.size()) fail("its rows differ in length");
      sums.add({fields[at_.tx], fields[at_.rx], number(fields[at_.paths]), number(fields[at_.gain]),
                number(fields[at_.spread]), number(fields[at_.los]) > 0},
               grid_of_, names);
    }
  }

  LinkStatistics statistics(LinkSums sums) const {
    LinkStatistics out;
    out.asked = sums.asked;
    out.with_path = sums.with_path;
    out.los = sums.los;
    out.gain_db = quantiles(std::move(sums.gains_db));
    out.delay_spread_s = quantiles(std::move(sums.delay_spreads_s));
    std::vector<const std::pair<const std::string, Sum>*> pairs;
    for (const auto& pair : sums.pairs)
      if (pair.second.rows > 0) pairs.push_back(&pair);
    std::ranges::sort(pairs, {}, [](const auto* pair) { return std::string_view(pair->first); });
    for (const auto* pair : pairs) {
      const Sum& sum = pair->second;
      const auto rows = static_cast<double>(sum.rows);
      const char* const arrow = sum.forwards && sum.backwards ? "<->" : "->";
      out.pairs.push_back({fmt::format("{} {} {}", sum.tx, arrow, sum.rx), 10 * std::log10(sum.power / rows),
                           sum.delay_spread_s / rows, sum.rows, sum.los_rows});
    }
    std::ranges::stable_sort(out.pairs, std::ranges::greater(), &PairSummary::mean_gain_db);
    for (const ReceiverGridConfig& grid : config_.receiver_grids) out.grids.push_back({grid.name, 0, 0, {}});
    std::vector<std::vector<double>> covered(out.grids.size());
    for (const auto& [receiver, grid] : grid_of_) {
      ++out.grids[grid].cells;
      const auto best = sums.best_db.find(receiver);
      if (best != sums.best_db.end() && std::isfinite(best->second)) covered[grid].push_back(best->second);
    }
    for (size_t g = 0; g < covered.size(); ++g) {
      out.grids[g].covered = covered[g].size();
      out.grids[g].gain_db = quantiles(std::move(covered[g]));
    }
    return out;
  }
};

}  // namespace

Quantiles quantiles(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<size_t>(place);
    const double next = values[std::min(below + 1, values.size() - 1)];
    return values[below] + (place - static_cast<double>(below)) * (next - values[below]);
  };
  return {at(0.1), at(0.5), at(0.9)};
}

LinkStatistics link_statistics(const std::filesystem::path& links_csv, const Config& config) {
  return Reader(links_csv, config).read();
}

}  // namespace wavetracer
