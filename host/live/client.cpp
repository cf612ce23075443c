// SPDX-License-Identifier: Apache-2.0
// Buffers are bounded: the input by max_message_bytes and one read, the output by max_queue_bytes and one answer. If a
// client sends faster than it reads answers, the server stops reading from it, so that TCP itself slows it down.
#include "live/client.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "live/answer.hpp"

namespace wavetracer::live {
namespace {

constexpr size_t read_bytes = 65536;
constexpr std::chrono::seconds farewell{1};

Clock::duration duration_of(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

Client::Client(uint64_t number, Descriptor socket, const LiveConfig& limits, Clock::time_point now)
    : number_(number),
      socket_(std::move(socket)),
      limits_(limits),
      allowance_(std::max(limits.max_rate_hz, 1.0)),
      counted_(now),
      connected_(now),
      line_began_(now),
      spoke_(now),
      took_(now) {}

// A free-running client may always send a newer frame, which replaces the waiting one.
bool Client::may_speak() const {
  const bool free_running = hello && hello->free_running;
  const auto replaced = [](const Pending& p) { return !p.message.between; };
  const size_t waiting = pending.size() - (free_running && std::ranges::any_of(pending, replaced) ? 1 : 0);
  return !ending() && !leaving && !reading && has_room() && waiting < limits_.max_pending_frames;
}

std::optional<Clock::duration> Client::pause(Clock::time_point now) {
  const double rate = limits_.max_rate_hz;
  allowance_ += std::chrono::duration<double>(now - counted_).count() * rate;
  allowance_ = std::min(allowance_, std::max(rate, 1.0));
  counted_ = now;
  if (allowance_ >= 1 || ending()) return {};
  return duration_of((1 - allowance_) / rate);
}

short Client::events(Clock::time_point now) {
  const bool listens = !finished_ && (ending() || (may_speak() && !pause(now)));
  if (!listens || in_.empty()) line_began_ = now;  // waiting in our buffer is not the client's delay
  return static_cast<short>((listens ? POLLIN : 0) | (sent_ < out_.size() ? POLLOUT : 0));
}

void Client::receive() {
  std::array<char, read_bytes> bytes;
  const ssize_t count = recv(*socket_, bytes.data(), bytes.size(), 0);
  if (count > 0) {
    if (!ending()) in_.append(bytes.data(), static_cast<size_t>(count));
  } else if (count == 0) {
    finished_ = true;
  } else if (errno != EAGAIN && errno != EINTR) {
    gone_ = true;
  }
}

std::optional<std::string> Client::next_line(Clock::time_point now) {
  if (!may_speak() || pause(now)) return {};
  const size_t end = in_.find('\n', searched_);
  const size_t size = end == in_.npos ? in_.size() : end;
  const size_t most = std::min<size_t>(limits_.max_message_bytes, hello ? limits_.max_message_bytes : hello_bytes);
  if (size > most) {
    const char* when = hello ? "" : " before hello";
    this->end(error_line("too_long", fmt::format("a message has more than {} bytes{}", most, when), {}, true), now);
    return {};
  }
  if (end == in_.npos) {
    searched_ = in_.size();
    return {};
  }
  std::string line = in_.substr(0, end);
  if (line.ends_with('\r')) line.pop_back();
  in_.erase(0, end + 1);
  searched_ = 0;
  line_began_ = spoke_ = now;
  allowance_ -= 1;
  return line;
}

void Client::say(std::string_view line, Clock::time_point now) {
  if (ending() || gone_) return;
  if (sent_ == out_.size()) {
    out_.clear();
    sent_ = 0;
    took_ = now;
  }
  out_ += line;
  spoke_ = now;  // the client's time limit starts with its answer
  send(now);
}

void Client::end(std::string_view line, Clock::time_point now) {
  if (ending()) return;
  say(line, now);
  ends_at_ = now + farewell;
  in_.clear();
  pending.clear();
}

void Client::send(Clock::time_point now) {
  while (sent_ < out_.size() && !gone_) {
    const ssize_t count = ::send(*socket_, out_.data() + sent_, out_.size() - sent_, MSG_NOSIGNAL);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) break;
    if (count <= 0) gone_ = true;
    sent_ += static_cast<size_t>(std::max<ssize_t>(count, 0));
    took_ = now;
  }
  if (sent_ > read_bytes && sent_ > out_.size() / 2) {
    out_.erase(0, sent_);
    sent_ = 0;
  }
}

void Client::check_time(Clock::time_point now) {
  const bool unread = sent_ < out_.size();
  if (ending()) {
    // Closing a socket with unread bytes would reset the connection, and the last line might be lost.
    if (!unread && !shut_) shut_ = shutdown(*socket_, SHUT_WR) == 0;
    if (finished_ || now >= *ends_at_) gone_ = true;
    return;
  }
  const auto late = [&](Clock::time_point since, double limit_s) { return now - since > duration_of(limit_s); };
  const auto drop = [&](const std::string& text) { end(error_line("timeout", text, {}, true), now); };
  if (finished_ && has_answers() && !has_line() && !unread)
    gone_ = true;
  else if (unread && late(took_, limits_.send_timeout_s))
    gone_ = true;  // the client would not read the reason
  else if (!hello && !reading && late(connected_, limits_.hello_timeout_s))
    drop(fmt::format("the hello message did not arrive within {} s", limits_.hello_timeout_s));
  else if (!in_.empty() && late(line_began_, limits_.message_timeout_s))
    drop(fmt::format("a line was not complete within {} s", limits_.message_timeout_s));
  else if (limits_.idle_timeout_s && has_answers() && !unread && late(spoke_, *limits_.idle_timeout_s))
    drop(fmt::format("no message within {} s", *limits_.idle_timeout_s));
}

}  // namespace wavetracer::live
