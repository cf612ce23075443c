// SPDX-License-Identifier: Apache-2.0
// Unknown words are reported before missing options, since the one is often the reason for the other. CLI11 keeps words
// that a command could not use as its remaining words.
#include "app/usage.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include "app/commands.hpp"
#include "base/spelling.hpp"
#include "config/field_table.hpp"
#include "config/reference.hpp"
#include "wavetracer/config_file.hpp"

namespace wavetracer::app {
namespace {

constexpr const char* config_topic = "config";

struct Command {
  const CLI::App* app;
  std::string path;  // such as "", "run", "scene info"
};

// Returns the innermost command that was named.
Command named(const CLI::App& program) {
  Command at{&program, ""};
  while (!at.app->get_subcommands().empty()) {
    at.app = at.app->get_subcommands().back();
    at.path += (at.path.empty() ? "" : " ") + at.app->get_name();
  }
  return at;
}

std::vector<std::string> command_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* sub : command.get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); }))
    names.push_back(sub->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

// Returns a hint for a word that is no command: the one that took its place, or the nearest of `names`.
std::string command_hint(const std::string& word, const std::vector<std::string>& names) {
  if (word == "bench") return "; the experiments of the thesis are run by `wavetracer thesis`";
  return spelling_hint(word, names);
}

std::string unknown_word(const CLI::App& command, const std::string& word) {
  if (word.starts_with('-')) {
    const std::string name = word.substr(0, word.find('='));
    return fmt::format("there is no option {}{}", name, spelling_hint(name, option_names(command)));
  }
  if (const std::vector<std::string> names = command_names(command); !names.empty())
    return fmt::format("there is no command \"{}\"{}", word, command_hint(word, names));
  const bool config = word.ends_with(".toml") && command.get_option_no_throw("--config") != nullptr;
  return fmt::format("\"{}\" is not expected here{}", word, config ? ", a configuration comes after -c" : "");
}

// Handles CLI11's "--format: svh not in {svg,png,pdf}".
std::string choice_hint(const std::string& message) {
  const size_t colon = message.find(": "), list = message.find(" not in {");
  if (colon == std::string::npos || list == std::string::npos || list < colon + 2) return "";
  std::vector<std::string> choices;
  for (size_t start = list + 9; start < message.size();) {
    const size_t end = std::min(message.find_first_of(",}", start), message.size());
    choices.push_back(message.substr(start, end - start));
    start = end + 1;
  }
  return spelling_hint(message.substr(colon + 2, list - colon - 2), choices);
}

// Handles CLI11's "Could not convert: --frame = x": says what the option takes. Returns an empty text for others.
std::string conversion_problem(const CLI::App& command, const std::string& message) {
  constexpr std::string_view begin = "Could not convert: ";
  const size_t equals = message.find(" = ");
  if (!message.starts_with(begin) || equals == std::string::npos) return "";
  const std::string name = message.substr(begin.size(), equals - begin.size());
  const CLI::Option* const option = command.get_option_no_throw(name);
  const std::string type = option ? option->get_type_name() : "";
  return fmt::format("{}: {} is not a {}", name, message.substr(equals + 3),
                     type.starts_with("UINT")  ? "whole number of 0 or more"
                     : type.starts_with("INT") ? "whole number"
                                               : "number");
}

std::string problem(const CLI::App& command, const CLI::ParseError& error) {
  if (const std::vector<std::string> unplaced = command.remaining(); !unplaced.empty())
    return unknown_word(command, unplaced.front());
  const std::string what = error.what();
  const std::vector<std::string> names = command_names(command);
  if (error.get_name() == "RequiredError" && !names.empty() && !names.front().empty())
    return fmt::format("name one of them: {}", fmt::join(names, " or "));
  // Handles CLI11's "--config: 1 required TEXT missing".
  if (const size_t missing = what.find(": 1 required "); missing != std::string::npos && what.ends_with(" missing"))
    return what.substr(0, missing) + " needs a value";
  if (what == "--config is required") return what + ": -c FILE (`wavetracer init --minimal` prints a first one)";
  if (const std::string conversion = conversion_problem(command, what); !conversion.empty()) return conversion;
  return what + choice_hint(what);
}

std::vector<std::string> key_names() {
  std::vector<std::string> names;
  for (const config::Table& table : config::tables())
    for (const config::Field& field : table.fields) names.push_back(table.name + "." + field.name);
  return names;
}

// Names the keys that begin with the word, or else the one that is spelled nearly alike.
std::string key_hint(const std::string& word) {
  std::vector<std::string> beginning;
  for (const std::string& key : key_names())
    if (key.starts_with(word)) beginning.push_back(key);
  if (beginning.empty()) return spelling_hint(word, key_names());
  if (beginning.size() == 1) return fmt::format("; did you mean \"{}\"?", beginning.front());
  return fmt::format("; these keys begin so: {}", fmt::join(beginning, ", "));
}

const CLI::App& find_command(const CLI::App& program, const std::vector<std::string>& path) {
  const CLI::App* at = &program;
  for (const std::string& word : path) {
    const auto found = at->get_subcommands([&word](const CLI::App* sub) { return sub->get_name() == word; });
    if (found.empty()) {
      std::vector<std::string> known = command_names(*at);
      if (at == &program) {
        known.push_back(config_topic);
        if (const std::string hint = key_hint(word); word.find('.') != word.npos && !hint.empty())
          throw ConfigError(fmt::format("help: there is no key \"{}\"{}", word, hint));
      }
      throw ConfigError(
          fmt::format("help: there is nothing about \"{}\"{}; there is help about {}", word, command_hint(word, known),
                      known.empty() ? at->get_name() + " as a whole" : fmt::format("{}", fmt::join(known, ", "))));
    }
    at = found.front();
  }
  return *at;
}

bool is_command(const CLI::App& program, const std::string& word) {
  return std::ranges::count(command_names(program), word) > 0;
}

void help(const CLI::App& program, const std::vector<std::string>& topic) {
  if (topic.size() == 1 && topic.front() == config_topic) {
    std::cout << "Keys of the config file (TOML):\n\n" << field_help();
    return;
  }
  const std::string keys = topic.size() == 1 ? field_help(topic.front()) : "";
  const bool command_too = !topic.empty() && is_command(program, topic.front());
  if (!keys.empty() && !command_too) {
    std::cout << keys;
    return;
  }
  const CLI::App& command = find_command(program, topic);
  std::string path = program.get_name();
  for (const std::string& word : topic) path += " " + word;
  std::cout << program.get_formatter()->make_help(&command, path, CLI::AppFormatMode::Normal);
  if (!keys.empty()) std::cout << "\nIn configuration files:\n\n" << keys;
}

}  // namespace

std::string usage_problem(const CLI::App& program, const CLI::ParseError& error) {
  const Command command = named(program);
  const std::string what = problem(*command.app, error);
  return fmt::format("{}{}{} `wavetracer help{}`", command.path.empty() ? "" : command.path + ": ", what,
                     what.ends_with('?') ? " See" : "; see", command.path.empty() ? "" : " " + command.path);
}

void refuse_bad_values(CLI::App& program) {
  for (CLI::Option* const option : program.get_options()) {
    if (option->get_items_expected_max() > 0)
      option->check([](const std::string& text) { return text.empty() ? std::string("the value is empty") : ""; });
    if (!option->get_type_name().starts_with("FLOAT")) continue;
    option->check([](const std::string& text) {
      double value = 0;
      const bool number = CLI::detail::lexical_cast(text, value);
      return !number || std::isfinite(value) ? std::string() : fmt::format("{} is not a finite number", text);
    });
  }
  for (CLI::App* const command : program.get_subcommands({})) refuse_bad_values(*command);
}

void add_help(CLI::App& program) {
  CLI::App* command = program.add_subcommand("help", "Explain a command, or the keys of configuration files");
  const auto topic = std::make_shared<std::vector<std::string>>();
  command->add_option("topic", *topic,
                      "A command; or config for all keys of configuration files; "
                      "or one key or table such as trace.rays, rays or trace. If not given, all commands are listed");
  command->callback([topic, &program] { help(program, *topic); });
}

}  // namespace wavetracer::app
