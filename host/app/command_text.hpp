// The command line as data, read from CLI11's own description of it: what man pages and completions are made of.
// Assumes that hidden subcommands have an empty group.
#pragma once
#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace wavetracer::app {

struct OptionText {
  std::vector<std::string> names;  // with their dashes; none of a positional
  std::string value;               // name of the value: FILE, TEXT, INT; empty of a flag
  std::string doc, fallback;       // fallback: its default, empty where there is none
  std::vector<std::string> choices;
  bool required = false, repeats = false;
  bool positional() const { return names.empty(); }
};

struct CommandText {
  std::string path;  // "", "run", "scene info"
  std::string name, doc;
  std::string footer;  // empty where it is that of the whole program
  std::vector<OptionText> options;
  std::vector<CommandText> commands;
};

// What completes the value of an option of the command `path` besides the choices that --help lists; empty: anything.
std::vector<std::string> known_values(const CLI::App& program, const std::string& path, const CLI::Option& option);

CommandText describe(const CLI::App& program);

// This command and all below it, each before its own.
std::vector<const CommandText*> all_commands(const CommandText& command);

// wavetracer.1
std::string program_manual(const CommandText& program, const std::string& version);

// The script for "bash", "zsh" or "fish".
std::string completion(const CommandText& program, const std::string& shell);

}  // namespace wavetracer::app
