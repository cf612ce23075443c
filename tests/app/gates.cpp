// SPDX-License-Identifier: Apache-2.0
// Both sides communicate through files in a folder.
#include <doctest/doctest.h>
#include <charconv>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>
#include "gate.hpp"

namespace fs = std::filesystem;

void wait_until(const char* what, const std::function<bool()>& holds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::minutes(1);
  bool held = holds();
  for (; !held && Clock::now() < end; held = holds()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  CAPTURE(std::string(what));
  REQUIRE(held);  // it asks once: if LLVM compiled a kernel, it restores our handler and sends the signal again
}

void wait_until_interrupted(pid_t process) {
  wait_until("the signal was handled", [process] {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("SigCgt:")) return (std::stoull(line.substr(7), nullptr, 16) & (1u << (SIGINT - 1))) == 0;
    return true;  // it has ended
  });
}

std::vector<std::string> Gate::with(std::vector<std::string> settings) const {
  settings.push_back("LD_PRELOAD=" WAVETRACER_GATE);
  settings.push_back("GATE=" + folder_.path());
  return settings;
}

std::vector<std::string> Gate::at_name(const std::string& at, const std::string& but) const {
  return with({"GATE_AT=" + at, "GATE_NOT=" + but});
}

std::vector<std::string> Gate::at_sync() const { return with({"GATE_SYNC=1"}); }

std::vector<std::string> Gate::at_launches() const { return with({"GATE_LAUNCHES=1"}); }

std::vector<std::string> Gate::at_buffers(size_t bytes) const {
  return with({"GATE_LARGEST=" + std::to_string(bytes)});
}

std::vector<pid_t> Gate::waiting() const {
  std::vector<pid_t> out;
  for (const auto& entry : fs::directory_iterator(folder_.path()))
    if (const std::string name = entry.path().filename().string(); name.starts_with("waits."))
      out.push_back(std::stoi(name.substr(6)));
  return out;
}

std::vector<pid_t> Gate::wait_for(size_t processes) const {
  wait_until("processes wait at the gate", [&] { return waiting().size() >= processes; });
  return waiting();
}

void Gate::open() const { folder_.file("open", ""); }

void Gate::let_launch(long more, const Program& program) {
  launches_ += more;
  folder_.file("launches.new", std::to_string(launches_));
  for (const pid_t process : waiting()) fs::remove(folder_.path("waits." + std::to_string(process)));
  fs::rename(folder_.path("launches.new"), folder_.path("launches"));
  wait_until("launches that were allowed are done", [&] { return !waiting().empty() || program.ended(); });
}
