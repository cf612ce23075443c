// SPDX-License-Identifier: Apache-2.0
// Words that options accept but CLI11 does not list: other commands list them, and they would fill the screen in
// --help.
#include <algorithm>
#include "app/command_text.hpp"
#include "config/field_table.hpp"
#include "convert/convert.hpp"
#include "coverage/chance_map.hpp"
#include "coverage/coverage_map.hpp"
#include "coverage/write_map.hpp"
#include "plots/plots.hpp"
#include "scene/materials.hpp"
#include "study/experiment.hpp"

namespace wavetracer::app {
namespace {

std::vector<std::string> experiment_names() {
  std::vector<std::string> out{"all"};
  for (const study::Experiment& experiment : study::experiments()) out.emplace_back(experiment.name);
  return out;
}

std::vector<std::string> material_names() {
  std::vector<std::string> out;
  for (const Material& material : itu_materials())
    if (std::ranges::find(out, material.name) == out.end()) out.push_back(material.name);
  return out;
}

std::vector<std::string> help_topics(const CLI::App& program) {
  std::vector<std::string> out{"config"};
  for (const CLI::App* sub : program.get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); }))
    out.push_back(sub->get_name());
  for (const config::Table& table : config::tables())
    if (std::ranges::find(out, table.name) == out.end()) out.push_back(table.name);
  return out;
}

}  // namespace

std::vector<std::string> known_values(const CLI::App& program, const std::string& path, const CLI::Option& option) {
  const std::string name = option.get_lnames().empty() ? option.get_name(true) : option.get_lnames().front();
  if (path == "thesis" && name == "experiment") return experiment_names();
  if (path == "convert" && name == "to") return exporter_names();
  if (path == "plot" && name == "what") return {plots::plot_names.begin(), plots::plot_names.end()};
  if (path == "accuracy" && name == "threshold") {
    std::vector<std::string> out;
    for (const std::string& tested : coverage::tested_names()) out.push_back(tested + "=");
    return out;
  }
  if ((path == "coverage" || path == "accuracy") && name == "format")
    return {coverage::format_names.begin(), coverage::format_names.end()};
  if ((path == "coverage" && name == "layers") || (path == "plot" && name == "layer")) return coverage::layer_names();
  if (path == "help" && name == "topic") return help_topics(program);
  if (name.ends_with("-material") || (path == "scene city" && name == "ground")) return material_names();
  return {};
}

}  // namespace wavetracer::app
