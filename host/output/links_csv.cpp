// Writes the figures of radio/links.hpp as comma-separated text, sorted by frame, transmitter, receiver.
// Assumes that link_figures() answers for every pair of ends.
#include "output/links_csv.hpp"
#include <fmt/format.h>
#include <iterator>
#include "radio/links.hpp"

namespace wavetracer {
namespace {

// A field as RFC 4180, section 2, wants it: quoted where it holds a comma, a quote or a line end.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::vector<std::string> labels(const std::vector<RadioEnd>& ends) {
  std::vector<std::string> result;
  for (const RadioEnd& end : ends)
    result.push_back(end.name.empty() ? std::to_string(result.size()) : quoted(end.name));
  return result;
}

}  // namespace

std::string encode_links_csv(const RunData& run) {
  const auto tx = labels(run.config.transmitters), rx = labels(run.config.receivers);
  std::string text = "time_s,tx,rx,paths,path_gain_db,mean_delay_s,rms_delay_spread_s,doppler_spread_hz,los\n";
  for (uint32_t i = 0; i < run.frames.size(); ++i)
    for (const LinkFigures& link : link_figures(run.frames[i].paths, run.first_frame + i,
                                                static_cast<uint32_t>(tx.size()), static_cast<uint32_t>(rx.size())))
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{:d}\n", run.time_s(i), tx[link.tx],
                     rx[link.rx], link.paths, link.path_gain_db, link.mean_delay_s, link.rms_delay_spread_s,
                     link.doppler_spread_hz, link.los);
  return text;
}

}  // namespace wavetracer
