// SPDX-License-Identifier: Apache-2.0
// Affinity is the only mechanism: TBB sizes its pool by it, and PoCL is also told the number of cores.
// This is for Linux only.
#include "jobs/devices_option.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

bool same_kind(const gpu::DeviceInfo& a, const gpu::DeviceInfo& b) { return a.gpu == b.gpu && a.cpu == b.cpu; }

// Returns the indices of a list, or none if the text is one of the words. Throws ConfigError for other text.
std::vector<size_t> listed(const std::string& text) {
  std::vector<size_t> out;
  if (text.empty() || text == "all" || text == "gpu" || text == "cpu") return out;
  for (size_t at = 0; at <= text.size();) {
    const std::string item = text.substr(at, text.find(',', at) - at);
    at += item.size() + 1;
    size_t index = 0;
    const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), index);
    if (item.empty() || error != std::errc() || end != item.data() + item.size())
      throw ConfigError(
          fmt::format("--devices {}: give all, gpu, cpu, or indices such as 0,1,2 (`wavetracer devices` lists "
                      "them); for several processes on one device use --processes N",
                      text));
    if (std::ranges::find(out, index) != out.end())
      throw ConfigError(fmt::format(
          "--devices {}: {} is named twice; for several processes on one device use --processes N", text, index));
    out.push_back(index);
  }
  return out;
}

void check_listed(const std::vector<gpu::DeviceInfo>& there, const std::string& text, const std::vector<size_t>& list) {
  // Throws and names the existing ones.
  for (const size_t index : list) gpu::choose_device(there, std::to_string(index));
  for (const size_t index : list)
    if (!same_kind(there[index], there[list.front()]))
      throw ConfigError(fmt::format("--devices {}: {} and {} are of different kinds; name only CPUs or only GPUs", text,
                                    there[list.front()].name, there[index].name));
}

template <typename Which>
std::vector<size_t> indices(const std::vector<gpu::DeviceInfo>& there, const Which& which) {
  std::vector<size_t> out;
  for (const gpu::DeviceInfo& device : there)
    if (which(device)) out.push_back(device.index);
  return out;
}

// Returns the indices, or the code and the words of an error, as text from a child to its parent.
std::string answer_of(const std::string& devices, const std::string& device) {
  try {
    const std::vector<gpu::DeviceInfo> there = gpu::list_devices();
    const std::vector<size_t> chosen =
        devices.empty() ? std::vector{gpu::choose_device(there, device)} : choose_devices(there, devices, device);
    return fmt::format("0 {}", fmt::join(chosen, " "));
  } catch (const Error& error) {
    return fmt::format("{} {}", static_cast<int>(error.code()), error.what());
  } catch (const std::exception& error) {
    return fmt::format("{} {}", static_cast<int>(ExitCode::device), error.what());
  }
}

std::string read_all(int descriptor) {
  std::string text;
  char block[4096];
  for (ssize_t bytes; (bytes = read(descriptor, block, sizeof block)) != 0;) {
    if (bytes > 0)
      text.append(block, static_cast<size_t>(bytes));
    else if (errno != EINTR)
      break;
  }
  return text;
}

bool is_index(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

// A child process chooses, so that no driver is loaded into this process: NVIDIA's finds no device in children of a
// process that has loaded it (580.159). This takes a second if there are several GPUs.
std::vector<size_t> ask_apart(const std::string& devices, const std::string& device) {
  int ends[2];
  if (pipe(ends) != 0) throw RuntimeError(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  const pid_t child = fork();
  if (child < 0) throw RuntimeError(fmt::format("cannot start a process: {}", std::strerror(errno)));
  if (child == 0) {
    const std::string answer = answer_of(devices, device);
    const bool told = write(ends[1], answer.data(), answer.size()) == static_cast<ssize_t>(answer.size());
    _exit(told ? 0 : 1);
  }
  close(ends[1]);
  std::istringstream answer(read_all(ends[0]));
  close(ends[0]);
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  int code = static_cast<int>(ExitCode::device);
  if (!(answer >> code)) throw DeviceError("the OpenCL drivers end the process that asks them for devices");
  if (code != 0) {
    std::string words;
    std::getline(answer >> std::ws, words, '\0');
    throw Error(static_cast<ExitCode>(code), words);
  }
  std::vector<size_t> out;
  for (size_t index; answer >> index;) out.push_back(index);
  return out;
}

}  // namespace

std::vector<size_t> devices_to_start_on(const std::string& devices, const std::string& device) {
  const std::vector<size_t> list = listed(devices.empty() && is_index(device) ? device : devices);
  return list.empty() ? ask_apart(devices, device) : list;
}

std::vector<size_t> choose_devices(const std::vector<gpu::DeviceInfo>& there, const std::string& devices,
                                   const std::string& device) {
  if (devices == "gpu" || devices == "cpu") {
    const auto out = indices(there, [&](const gpu::DeviceInfo& d) { return devices == "gpu" ? d.gpu : d.cpu; });
    if (out.empty())
      throw DeviceError(fmt::format(
          "--devices {}: this machine has no such device; `wavetracer devices` lists the devices that it has",
          devices));
    return out;
  }
  if (const std::vector<size_t> list = listed(devices); !list.empty()) {
    check_listed(there, devices, list);
    return list;
  }
  const gpu::DeviceInfo& chosen = there[gpu::choose_device(there, device)];
  if (device == std::to_string(chosen.index)) return {chosen.index};
  return indices(there,
                 [&](const gpu::DeviceInfo& d) { return same_kind(d, chosen) && d.platform == chosen.platform; });
}

void take_share_of_cores(const Ranks& ranks) {
  cpu_set_t all;
  if (ranks.local_size < 2 || sched_getaffinity(0, sizeof all, &all) != 0) return;
  std::vector<int> cores;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(core, &all)) cores.push_back(core);
  if (!ranks.started && static_cast<long>(cores.size()) < sysconf(_SC_NPROCESSORS_ONLN)) return;
  const size_t n = cores.size(), parts = ranks.local_size, part = ranks.local_rank;
  const size_t first = n >= parts ? n * part / parts : part % n;
  const size_t end = n >= parts ? n * (part + 1) / parts : first + 1;
  cpu_set_t own;
  CPU_ZERO(&own);
  for (size_t i = first; i < end; ++i) CPU_SET(cores[i], &own);
  if (sched_setaffinity(0, sizeof own, &own) != 0) return;
  unsetenv("POCL_AFFINITY");  // with it, PoCL binds its threads to the first cores and ignores the mask
  // These are the names of the variable before and since PoCL 6.
  for (const char* variable : {"POCL_MAX_PTHREAD_COUNT", "POCL_CPU_MAX_CU_COUNT"})
    setenv(variable, std::to_string(end - first).c_str(), 0);
}

}  // namespace wavetracer
