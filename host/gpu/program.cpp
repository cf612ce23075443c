// SPDX-License-Identifier: Apache-2.0
// Programs: built once per context, from the disk cache or from source, and the kernels in them.
// A cached program that the driver refuses is rebuilt from source; only source that does not build is an error.
#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include "gpu/one_kernel.hpp"
#include "gpu/source.hpp"
#include "gpu/state.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::gpu {

namespace {

// No specification says how OpenCL drivers split their option string, so blanks and quotes are refused.
std::string definition_options(const std::string& program, const Definitions& definitions) {
  std::string options;
  for (const auto& [name, value] : definitions) {
    if (name.empty() || (name + value).find_first_of(" \t\n\"'\\=") != std::string::npos) {
      throw std::logic_error(
          fmt::format("program {}: definition {}={} has a blank, quote, backslash or second =", program, name, value));
    }
    options += fmt::format(" {}{}={}", name.starts_with("-cl-") ? "" : "-D", name, value);
  }
  return options;
}

// Calls the compiler of a program. If it runs out of memory, it throws through PoCL, which then keeps its locks:
// releasing a program would wait for ever. So this program is kept, and *locked says that all others must be kept too.
template <class Call>
auto compiling(cl::Program& program, bool& locked, const Call& call) {
  try {
    return call();
  } catch (const cl::Error&) {
    throw;
  } catch (...) {
    locked = true;
    static_cast<void>(new cl::Program(std::move(program)));
    throw;
  }
}

std::optional<cl::Program> build_from_binary(const cl::Context& context, const cl::Device& device,
                                             const std::string& options, const std::string& compiled, bool& locked) {
  try {
    const std::vector<cl::Device> devices{device};
    cl::Program program(context, devices, {std::vector<unsigned char>(compiled.begin(), compiled.end())});
    compiling(program, locked, [&] { return program.build(devices, options.c_str()); });
    return program;
  } catch (const cl::Error&) {
    return std::nullopt;  // the driver's answer counts more than our key
  }
}

// Returns the bytes of a value argument of one of OpenCL C's own types ("uint", "float4"); 0 for any other.
size_t size_of_type(std::string_view type) {
  struct Scalar {
    std::string_view name;
    size_t bytes;
  };
  static constexpr Scalar scalars[] = {{"char", 1}, {"uchar", 1}, {"short", 2}, {"ushort", 2}, {"int", 4},
                                       {"uint", 4}, {"long", 8},  {"ulong", 8}, {"float", 4},  {"double", 8}};
  for (const Scalar& scalar : scalars) {
    if (!type.starts_with(scalar.name)) continue;
    const std::string_view width = type.substr(scalar.name.size());
    if (width.empty()) return scalar.bytes;
    if (width == "2") return 2 * scalar.bytes;
    if (width == "3" || width == "4") return 4 * scalar.bytes;  // a vector of three has the size of four
    if (width == "8") return 8 * scalar.bytes;
    if (width == "16") return 16 * scalar.bytes;
  }
  return 0;
}

std::vector<Argument> arguments_of(const cl::Kernel& kernel, cl_uint count) {
  std::vector<Argument> arguments(count);
  try {
    for (cl_uint i = 0; i < count; ++i) {
      Argument& argument = arguments[i];
      argument.name = kernel.getArgInfo<CL_KERNEL_ARG_NAME>(i);
      argument.type = kernel.getArgInfo<CL_KERNEL_ARG_TYPE_NAME>(i);
      switch (kernel.getArgInfo<CL_KERNEL_ARG_ADDRESS_QUALIFIER>(i)) {
        case CL_KERNEL_ARG_ADDRESS_GLOBAL:
        case CL_KERNEL_ARG_ADDRESS_CONSTANT:
          argument.kind = Argument::Kind::memory;
          break;
        case CL_KERNEL_ARG_ADDRESS_LOCAL:
          argument.kind = Argument::Kind::local;
          break;
        default:
          argument.kind = Argument::Kind::value;
          argument.bytes = size_of_type(argument.type);
      }
    }
  } catch (const cl::Error&) {
    return {};  // programs from binaries need not tell (CL_KERNEL_ARG_INFO_NOT_AVAILABLE on NVIDIA)
  }
  return arguments;
}

std::string first_binary(const cl::Program& program) {
  const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
  if (binaries.empty()) return {};
  return std::string(binaries[0].begin(), binaries[0].end());
}

}  // namespace

cl::Program Context::State::build_from_source(const std::string& name, const std::string& kernel,
                                              const std::string& options, const std::string& source) {
  cl::Program built(context, source);
  try {
    compiling(built, locked, [&] { return built.build({device}, options.c_str()); });
  } catch (const cl::Error& error) {
    throw CallError(fmt::format("{}: kernel program \"{}\" does not build ({}) with options {}\n{}", info.name, name,
                                error_name(error.err()), options,
                                with_places(built.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device), source)),
                    error.err(), name + "/" + kernel);
  }
  ++builds_from_source;
  return built;
}

const cl::Program& Context::State::program(const std::string& name, const std::string& kernel,
                                           const std::string& options) {
  const std::string id = fmt::format("{} {} {}", info.cpu ? kernel : "", name, options);
  if (const auto known = programs.find(id); known != programs.end()) return known->second;
  const auto start = std::chrono::steady_clock::now();
  const std::string whole = program_source(name);
  const ProgramKey key{info.cpu ? with_one_kernel(whole, kernel) : whole,
                       options,
                       info.platform,
                       info.platform_version,
                       info.name,
                       info.driver};
  std::optional<cl::Program> built;
  if (const auto compiled = cache.load(key)) built = build_from_binary(context, device, options, *compiled, locked);
  if (!built) {
    built = build_from_source(name, kernel, options, key.source);
    const std::string compiled = compiling(*built, locked, [&] { return first_binary(*built); });
    if (const std::string note = cache.store(key, compiled); !note.empty()) cache_note = note;
  }
  build_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return programs.emplace(id, *built).first->second;
}

std::optional<std::string> Context::recall(const std::string& subject) const {
  const DeviceInfo& d = state_->info;
  return state_->cache.load({subject, "", d.platform, d.platform_version, d.name, d.driver});
}

void Context::keep(const std::string& subject, const std::string& text) {
  const DeviceInfo& d = state_->info;
  state_->cache.store({subject, "", d.platform, d.platform_version, d.name, d.driver}, text);
}

Kernel Context::kernel(const std::string& program, const std::string& kernel, const Definitions& definitions) {
  State& s = *state_;
  const std::string options = s.device_options + definition_options(program, definitions);
  std::shared_ptr<Kernel::State>& known = s.kernels[kernel + " " + program + " " + options];
  if (!known)
    known =
        std::make_shared<Kernel::State>(Kernel::State{&s, program, options, kernel, program + "/" + kernel, {}, 0, {}});
  if (!s.info.cpu) known->make();
  Kernel out;
  out.state_ = known;
  return out;
}

void Kernel::State::make() {
  if (kernel()) return;
  try {
    cl::Kernel made(context->program(program, name, options), name.c_str());
    argument_count = made.getInfo<CL_KERNEL_NUM_ARGS>();
    arguments = arguments_of(made, static_cast<cl_uint>(argument_count));
    kernel = made;
  } catch (const cl::Error& error) {
    context->fail(error.err(), fmt::format("making kernel \"{}\" of program \"{}\" ({})", name, program, error.what()),
                  profile_name);
  }
}

}  // namespace wavetracer::gpu
