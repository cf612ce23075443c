// SPDX-License-Identifier: Apache-2.0
// The command line as data, read from CLI11's own description of it, for man pages and completions. Hidden subcommands
// have an empty group.
#pragma once
#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace wavetracer::app {

struct OptionText {
  std::vector<std::string> names;  // names with their dashes; a positional argument has none
  std::string value;               // name of the value: FILE, TEXT, INT; empty for a flag
  std::string doc, fallback;       // fallback: its default, empty if there is none
  std::vector<std::string> choices;
  bool required = false, repeats = false;
  bool positional() const { return names.empty(); }
};

struct CommandText {
  std::string path;  // such as "", "run", "scene info"
  std::string name, doc;
  std::string footer;  // empty if it is that of the whole program
  std::vector<OptionText> options;
  std::vector<CommandText> commands;
};

// Returns words that complete the value of an option of the command `path`, besides the choices that --help lists;
// empty if any value is possible.
std::vector<std::string> known_values(const CLI::App& program, const std::string& path, const CLI::Option& option);

CommandText describe(const CLI::App& program);

// Returns this command and all below it, parents before children.
std::vector<const CommandText*> all_commands(const CommandText& command);

// Returns the man page wavetracer.1.
std::string program_manual(const CommandText& program, const std::string& version);

// Returns the script for "bash", "zsh" or "fish".
std::string completion(const CommandText& program, const std::string& shell);

}  // namespace wavetracer::app
