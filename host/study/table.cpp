// A list of columns, each a name and how to write its cell.
// Six digits a number: more than a clock is good for.
#include "study/table.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <functional>
#include <stdexcept>

namespace wavetracer::study {
namespace {

struct Column {
  std::string name;
  std::function<std::string(const Row&)> cell;
};

std::string number(double value) { return fmt::format("{:.6g}", value); }

const std::vector<Column>& columns() {
  static const std::vector<Column> all = {
      {"rays", [](const Row& r) { return std::to_string(r.rays); }},
      {"method", [](const Row& r) { return r.series.method; }},
      {"mnemonic", [](const Row& r) { return r.series.mnemonic; }},
      {"shape", [](const Row& r) { return r.series.shape; }},
      {"each_depth", [](const Row& r) { return std::string(r.series.each_depth ? "true" : "false"); }},
      {"trace_s", [](const Row& r) { return number(r.times.trace_s); }},
      {"order_s", [](const Row& r) { return number(r.times.order_s); }},
      {"unpaid_s", [](const Row& r) { return number(r.times.unpaid_s); }},
      {"paid_s", [](const Row& r) { return number(r.times.paid_s()); }},
      {"frame_s", [](const Row& r) { return number(r.times.frame_s); }},
      {"paths", [](const Row& r) { return std::to_string(r.paths); }},
      {"sequences", [](const Row& r) { return std::to_string(r.sequences); }},
      {"gain_unpaid", [](const Row& r) { return number(r.gain_unpaid); }},
      {"gain_paid", [](const Row& r) { return number(r.gain_paid); }},
  };
  return all;
}

const std::vector<Column>& columns_of_averages() {
  static const std::vector<Column> all = {
      {"frames", [](const Row& r) { return std::to_string(r.frames); }},
      {"reduction_unpaid_percent", [](const Row& r) { return number(reduction_percent(r.gain_unpaid)); }},
      {"reduction_paid_percent", [](const Row& r) { return number(reduction_percent(r.gain_paid)); }},
  };
  return all;
}

}  // namespace

std::string encode_table(const std::vector<Row>& rows) {
  std::vector<Column> used = columns();
  if (std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.frames > 1; }))
    used.insert(used.end(), columns_of_averages().begin(), columns_of_averages().end());
  std::string text;
  for (size_t i = 0; i < used.size(); ++i) text += (i == 0 ? "" : ",") + used[i].name;
  text += "\n";
  for (const Row& row : rows) {
    for (size_t i = 0; i < used.size(); ++i) text += (i == 0 ? "" : ",") + used[i].cell(row);
    text += "\n";
  }
  return text;
}

size_t column_number(const std::string& name) {
  for (size_t i = 0; i < columns().size(); ++i)
    if (columns()[i].name == name) return i + 1;
  throw std::logic_error("no column is called " + name);
}

double reduction_percent(double gain) { return 100 * (1 - 1 / gain); }

}  // namespace wavetracer::study
