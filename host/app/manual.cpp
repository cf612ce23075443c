// SPDX-License-Identifier: Apache-2.0
// wavetracer(1): every subcommand with its options, as CLI11 describes them, environment variables, files and exit
// codes. Footers of subcommands are laid out as they are shown.
#include <fmt/format.h>
#include <algorithm>
#include "app/command_text.hpp"
#include "config/reference.hpp"

namespace wavetracer::app {
namespace {

using config::roff;

std::string tag(const OptionText& option) {
  std::string out;
  for (const std::string& name : option.names) out += (out.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
  if (!option.value.empty()) out += (out.empty() ? "\\fI" : " \\fI") + roff(option.value) + "\\fR";
  return out;
}

std::string entry(const OptionText& option) {
  std::string doc = roff(option.doc.ends_with('.') ? option.doc.substr(0, option.doc.size() - 1) : option.doc);
  if (option.required) doc += " (required)";
  std::string choices;
  for (const std::string& choice : option.choices) choices += (choices.empty() ? "" : ", ") + roff(choice);
  if (!choices.empty()) doc += "; one of " + choices;
  if (!option.fallback.empty()) doc += "; default " + roff(option.fallback);
  return fmt::format(".TP\n{}\n{}.\n", tag(option), doc);
}

std::string synopsis(const CommandText& command) {
  std::string out = fmt::format(".B wavetracer{}\n", command.path.empty() ? "" : " " + command.path);
  for (const OptionText& option : command.options)
    if (option.required || option.positional()) out += option.required ? tag(option) + "\n" : "[" + tag(option) + "]\n";
  return out + (command.commands.empty() ? "[\\fIOPTION\\fR...]\n" : "\\fICOMMAND\\fR ...\n");
}

std::string section(const CommandText& command) {
  std::string out = fmt::format(".SS {}\n{}.\n.PP\n{}", command.path, roff(command.doc), synopsis(command));
  for (const OptionText& option : command.options)
    if (std::ranges::find(option.names, "--help") == option.names.end()) out += entry(option);
  if (!command.footer.empty()) out += ".PP\n.nf\n" + roff(command.footer) + "\n.fi\n";
  return out;
}

// Each item is a tag and its meaning.
std::string list(std::initializer_list<std::pair<const char*, const char*>> items) {
  std::string out;
  for (const auto& [name, meaning] : items) out += fmt::format(".TP\n.B {}\n{}\n", roff(name), roff(meaning));
  return out;
}

}  // namespace

std::string program_manual(const CommandText& program, const std::string& version) {
  std::string out = fmt::format(
      ".TH WAVETRACER 1 \"\" \"wavetracer {}\" \"User commands\"\n.SH NAME\nwavetracer \\- {}\n.SH SYNOPSIS\n{}"
      ".SH DESCRIPTION\nA city and the positions of antennas go in, in a configuration file; "
      "every propagation path between them comes out, with its geometry, delay, complex gain and angles. "
      "Results go to standard output or to files, messages and progress to standard error.\n",
      version, roff(program.doc), synopsis(program));
  for (const OptionText& option : program.options) out += entry(option);
  out += ".SH COMMANDS\n";
  for (const CommandText* command : all_commands(program))
    if (!command->path.empty()) out += section(*command);
  out += ".SH EXIT STATUS\n" +
         list({{"0", "Success."},
               {"1", "A limit of the machine was reached: memory or disk is full."},
               {"2", "The command line or the configuration is wrong; the message names file, line and key."},
               {"3", "A scene, antenna, trajectory or result file is wrong."},
               {"4", "No OpenCL device, no memory on it, or a kernel that does not build."},
               {"5", "A part of the request could not be done; the rest is written."},
               {"130", "Interrupted; the written files are complete."}});
  out += ".SH FILES\n" + list({{"paths.h5", "Every path of a run (HDF5); each dataset says its units and meaning."},
                               {"links.csv", "One line per link and frame: path gain, delay spread, line of sight."},
                               {"summary.json", "Device, counts, seconds of each stage, warnings."},
                               {"shards/", "Finished parts of a drive, from which run --resume goes on."},
                               {"$XDG_CACHE_HOME/wavetracer/programs", "Compiled kernels; may be removed at any time."},
                               {"$XDG_CACHE_HOME/pocl/kcache",
                                "Kernels that PoCL has compiled. PoCL aborts the program where one of them is damaged, "
                                "as a full disk leaves it: remove the folder then."}});
  out += ".SH ENVIRONMENT\n" +
         list({{"NO_COLOR", "No colours in messages."},
               {"OCL_ICD_VENDORS", "Folder of the OpenCL drivers, of the OpenCL loader."},
               {"POCL_CACHE_DIR",
                "Folder of PoCL's cache of kernels; without one PoCL offers no device. "
                "If it is not set and PoCL cannot write to its default folder, "
                "a folder within the folder for temporary files is used."},
               {"WAVETRACER_NO_CACHE", "1: kernels are compiled anew at every start."},
               {"WAVETRACER_KERNEL_DIR",
                "Folder of kernel sources, laid out like kernels/, to use instead of the built-in ones."},
               {"XDG_CACHE_HOME", "Folder of caches, instead of ~/.cache."}});
  return out + ".SH SEE ALSO\n.BR wavetracer.toml (5)\n";
}

}  // namespace wavetracer::app
