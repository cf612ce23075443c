// SPDX-License-Identifier: Apache-2.0
// Makes completion scripts. They complete commands, options, the words that an option accepts, and after --set the keys
// of the configuration with the words that a key accepts. Where there are no such words, shells complete files.
#include <fmt/format.h>
#include <algorithm>
#include "app/command_text.hpp"
#include "config/reference.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::app {
namespace {

std::string joined(const std::vector<std::string>& words, const std::string& between = " ") {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::string shell_quoted(const std::string& text) { return "'" + replaced(text, "'", "'\\''") + "'"; }

// Returns the first sentence or part of it, which fits beside an option.
std::string brief(const std::string& doc) { return doc.substr(0, doc.find(';')); }

bool is_set(const OptionText& option) { return std::ranges::find(option.names, "--set") != option.names.end(); }

// Returns the keys that `wavetracer help` explains. They are too many for the man page.
std::vector<std::string> explained_keys() {
  std::vector<std::string> out;
  for (const auto& [key, choices] : config::settable_keys()) out.push_back(replaced(key, ".0.", "."));
  return out;
}

// Returns the words that complete a value of the option of this command.
std::vector<std::string> offered(const CommandText& command, const OptionText& option) {
  std::vector<std::string> out = option.choices;
  if (command.path != "help" || !option.positional()) return out;
  const std::vector<std::string> keys = explained_keys();
  out.insert(out.end(), keys.begin(), keys.end());
  return out;
}

// --- bash ---

// Returns one line of a `case` with the words to offer.
std::string bash_case(const std::string& pattern, const std::string& words) {
  return fmt::format("    {}) words={} ;;\n", pattern, shell_quoted(words));
}

// Returns the keys with their equals signs, as --set takes them.
std::string set_words() {
  std::vector<std::string> out;
  for (const auto& [key, choices] : config::settable_keys()) out.push_back(key + "=");
  return joined(out);
}

// Returns a line for each key that has words.
std::string bash_key_values() {
  std::string out;
  for (const auto& [key, choices] : config::settable_keys())
    if (!choices.empty()) out += bash_case("*" + shell_quoted(" " + key), joined(choices));
  return out;
}

std::string bash(const CommandText& program) {
  std::string commands, words, values, topics;
  for (const CommandText* command : all_commands(program)) {
    std::vector<std::string> offered;
    for (const CommandText& sub : command->commands) {
      offered.push_back(sub.name);
      commands += (commands.empty() ? "" : " | ") + shell_quoted(sub.path);
    }
    for (const OptionText& option : command->options) {
      if (option.positional()) offered.insert(offered.end(), option.choices.begin(), option.choices.end());
      for (const std::string& name : option.names) {
        offered.push_back(name);
        if (!option.value.empty() && !is_set(option))
          values += bash_case(shell_quoted(command->path + " " + name), joined(option.choices));
      }
    }
    if (command->path == "help")
      topics = joined(offered);
    else
      words += bash_case(shell_quoted(command->path), joined(offered));
  }
  return fmt::format(
      R"(# Completion of wavetracer for bash. Written by `wavetracer documentation --completion bash`: do not edit.
# If COMPREPLY stays empty, bash completes files.
_wavetracer() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} path= of= words= i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do  # the words before the cursor that name a command
    case "${{path:+$path }}${{COMP_WORDS[i]}}" in
      {}) path="${{path:+$path }}${{COMP_WORDS[i]}}" ;;
    esac
  done
  # The option or key whose value is being typed; bash takes NAME=VALUE for three words.
  if [[ $current == = ]]; then
    of=$previous current=
  elif [[ $previous == = ]]; then
    of=${{COMP_WORDS[COMP_CWORD - 2]}}
  elif [[ $previous == -* ]]; then
    of=$previous
  fi
  case "$path $of" in
    *' --set')
      words={}
      compopt -o nospace
      ;;
{}    *.*) ;;
    'help '*)
      words={}
      [[ $current == *.* ]] || words={}
      ;;
    *)
      case "$path" in
{}      esac
      ;;
  esac
  # Options where a dash is typed; else commands, or files where a command takes none.
  local unasked=()
  [[ $current == -* ]] || unasked=(-X '-*')
  mapfile -t COMPREPLY < <(compgen "${{unasked[@]}}" -W "$words" -- "$current")
}}
complete -o bashdefault -o default -F _wavetracer wavetracer
)",
      commands, shell_quoted(set_words()), values + bash_key_values(), shell_quoted(joined(explained_keys())),
      shell_quoted(topics), replaced("    " + words, "\n    ", "\n        "));
}

// --- zsh ---

std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : brief(text))
    out += c == '[' || c == ']' || c == ':' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return replaced(out, "'", "'\\''");
}

std::string zsh_function(const std::string& path) { return "_wavetracer_" + replaced(path, " ", "_"); }

std::string zsh_option(const CommandText& command, const OptionText& option) {
  const std::string action = is_set(option)           ? "_wavetracer_set"
                             : option.choices.empty() ? "_files"
                                                      : "(" + joined(offered(command, option)) + ")";
  const std::string value = option.value.empty() ? "" : ":" + zsh_text(option.value) + ":" + action;
  if (option.positional()) return fmt::format("'{}{}'", option.repeats ? "*" : "", value);
  const std::string names = option.names.size() > 1 ? "{" + joined(option.names, ",") + "}" : option.names.front();
  const std::string exclusive = is_set(option) ? "'*'" : "'(" + joined(option.names) + ")'";
  return fmt::format("{}{}'[{}]{}'", exclusive, names, zsh_text(option.doc), value);
}

std::string zsh(const CommandText& program) {
  std::string keys, functions;
  for (const auto& [key, choices] : config::settable_keys())
    keys += fmt::format("  {}{}\n", shell_quoted(key), choices.empty() ? " ''" : " " + shell_quoted(joined(choices)));
  for (const CommandText* command : all_commands(program)) {
    std::string arguments, cases;
    for (const OptionText& option : command->options) arguments += " \\\n    " + zsh_option(*command, option);
    for (const CommandText& sub : command->commands)
      cases += fmt::format("    {}) {} ;;\n", sub.name, zsh_function(sub.path));
    if (!command->commands.empty()) {
      std::string names;
      for (const CommandText& sub : command->commands)
        names += fmt::format("{}\\:\"{}\" ", sub.name, replaced(zsh_text(sub.doc), "\"", ""));
      arguments += fmt::format(" \\\n    '1:command:(({}))' '*:: :->words'", names);
    }
    functions += fmt::format("{}() {{\n  _arguments -C{}\n", zsh_function(command->path), arguments);
    if (!cases.empty()) functions += fmt::format("  [[ $state == words ]] && case $line[1] in\n{}  esac\n", cases);
    functions += "}\n\n";
  }
  return fmt::format(R"(#compdef wavetracer
# Completion of wavetracer for zsh. Written by `wavetracer documentation --completion zsh`: do not edit.
typeset -gA _wavetracer_keys=(
{})

_wavetracer_set() {{
  if compset -P 1 '*='; then
    compadd -- ${{=_wavetracer_keys[${{IPREFIX%=}}]}}
  else
    compadd -S = -- ${{(k)_wavetracer_keys}}
  fi
}}

{}local state line
{}
)",
                     keys, functions, zsh_function(""));
}

// --- fish ---

std::string fish_text(const std::string& text) {
  return "'" + replaced(replaced(brief(text), "\\", "\\\\"), "'", "\\'") + "'";
}

// True if the words of the path have been typed, and no other command below this one.
std::string fish_condition(const CommandText& command) {
  std::string out;
  for (size_t start = 0; start < command.path.size();) {
    const size_t end = std::min(command.path.find(' ', start), command.path.size());
    out += (out.empty() ? "" : "; and ") + ("__fish_seen_subcommand_from " + command.path.substr(start, end - start));
    start = end + 1;
  }
  std::string others;
  for (const CommandText& sub : command.commands) others += " " + sub.name;
  if (!others.empty()) out += (out.empty() ? "" : "; and ") + ("not __fish_seen_subcommand_from" + others);
  return out;
}

std::string fish(const CommandText& program) {
  std::vector<std::string> sets;
  for (const auto& [key, choices] : config::settable_keys()) {
    if (choices.empty()) sets.push_back(key + "=");
    for (const std::string& choice : choices) sets.push_back(key + "=" + choice);
  }
  std::string out = fmt::format(
      "# Completion of wavetracer for fish. Written by `wavetracer documentation --completion fish`: do not edit.\n"
      "set -g __wavetracer_sets {}\n",
      joined(sets));
  for (const CommandText* command : all_commands(program)) {
    const std::string line = "complete -c wavetracer -n " + shell_quoted(fish_condition(*command));
    for (const CommandText& sub : command->commands)
      out += fmt::format("{} -f -a {} -d {}\n", line, sub.name, fish_text(sub.doc));
    for (const OptionText& option : command->options) {
      std::string names, value;
      for (const std::string& name : option.names)
        names += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (is_set(option))
        value = " -x -a '$__wavetracer_sets'";
      else if (!option.choices.empty())
        value = " -x -a " + shell_quoted(joined(offered(*command, option)));
      else if (!option.value.empty() && !option.positional())
        value = " -r";
      if (!option.positional() || !option.choices.empty())
        out += fmt::format("{}{}{} -d {}\n", line, names, value, fish_text(option.doc));
    }
  }
  return out;
}

}  // namespace

std::string completion(const CommandText& program, const std::string& shell) {
  if (shell == "bash") return bash(program);
  if (shell == "zsh") return zsh(program);
  if (shell == "fish") return fish(program);
  throw ConfigError("--completion " + shell + ": there are bash, zsh and fish");
}

}  // namespace wavetracer::app
