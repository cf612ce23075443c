// SPDX-License-Identifier: Apache-2.0
// CLI11 gives a value's type and its choices in one text, `TEXT:{a,b}`, as --help shows them.
// Choices are read from it, so shells complete everything that --help lists.
#include "app/command_text.hpp"
#include <algorithm>

namespace wavetracer::app {
namespace {

std::vector<std::string> choices_of(const std::string& type) {
  std::vector<std::string> out;
  const size_t open = type.find('{'), close = type.find('}', open == std::string::npos ? 0 : open);
  if (open == std::string::npos || close == std::string::npos) return out;
  for (size_t start = open + 1; start <= close;) {
    const size_t end = std::min(type.find(',', start), close);
    out.push_back(type.substr(start, end - start));
    start = end + 1;
  }
  return out;
}

OptionText option_text(const CLI::Option& option) {
  OptionText out;
  for (const std::string& name : option.get_snames()) out.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) out.names.push_back("--" + name);
  const std::string type = option.get_type_name();
  const bool flag = option.get_items_expected_max() == 0;
  if (!flag) out.value = out.positional() ? option.get_name(true) : type.substr(0, type.find_first_of(":{ "));
  if (!flag && out.value.empty()) out.value = "VALUE";
  out.doc = option.get_description();
  out.fallback = option.get_default_str();
  out.choices = choices_of(type);
  out.required = option.get_required();
  out.repeats = option.get_items_expected_max() > 1;
  return out;
}

CommandText command_text(const CLI::App& program, const CLI::App& command, const std::string& path) {
  const std::string common_footer = program.get_footer();
  CommandText out{.path = path,
                  .name = command.get_name(),
                  .doc = command.get_description(),
                  .footer = {},
                  .options = {},
                  .commands = {}};
  if (const std::string footer = command.get_footer(); footer != common_footer) out.footer = footer;
  for (const CLI::Option* option : command.get_options()) {
    out.options.push_back(option_text(*option));
    if (out.options.back().choices.empty()) out.options.back().choices = known_values(program, path, *option);
  }
  for (const CLI::App* sub : command.get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); }))
    out.commands.push_back(command_text(program, *sub, path.empty() ? sub->get_name() : path + " " + sub->get_name()));
  return out;
}

}  // namespace

CommandText describe(const CLI::App& program) { return command_text(program, program, ""); }

std::vector<const CommandText*> all_commands(const CommandText& command) {
  std::vector<const CommandText*> out{&command};
  for (const CommandText& sub : command.commands)
    for (const CommandText* each : all_commands(sub)) out.push_back(each);
  return out;
}

}  // namespace wavetracer::app
