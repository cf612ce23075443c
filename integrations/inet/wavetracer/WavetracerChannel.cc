// SPDX-License-Identifier: Apache-2.0
#include "WavetracerChannel.h"

#include <cmath>
#include <exception>
#include <fstream>
#include <sstream>

#include "inet/common/ModuleAccess.h"
#include "inet/common/geometry/common/Quaternion.h"
#include "inet/mobility/contract/IMobility.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/IAntenna.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/IRadioMedium.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/ITransmission.h"

namespace wavetracer {

using inet::Coord;
using inet::physicallayer::IRadio;
using inet::physicallayer::IRadioMedium;
using inet::physicallayer::ITransmission;
using omnetpp::cModule;
using omnetpp::cRuntimeError;

namespace {

constexpr double most_off = 0.1;  // of the server's frequency: then the gain is off by less than 1 dB

LiveVector vector_of(const Coord& v) { return {v.x, v.y, v.z}; }

// "PATTERN=NAME PATTERN=NAME..."
std::vector<std::pair<std::string, std::string>> pairs_of(const char* text, const char* parameter) {
  std::vector<std::pair<std::string, std::string>> out;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == word.size())
      throw cRuntimeError("wavetracer: \"%s\" of the parameter %s is not PATTERN=NAME", word.c_str(), parameter);
    out.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return out;
}

// The name of the first pattern that the host's name matches, or null.
const std::string* name_for(const char* host, const std::vector<std::pair<std::string, std::string>>& patterns) {
  for (const auto& [pattern, name] : patterns)
    if (pattern == host || omnetpp::cPatternMatcher(pattern.c_str(), false, true, true).matches(host)) return &name;
  return nullptr;
}

std::string read_token(const std::string& path) {
  std::ifstream file(path);
  std::string token;
  if (!(file >> token))
    throw cRuntimeError("wavetracer: the token file \"%s\" cannot be read, or is empty", path.c_str());
  return token;
}

}  // namespace

WavetracerChannel::WavetracerChannel(cModule* owner) : owner_(owner), medium_(owner->getParentModule()) {
  if (!dynamic_cast<IRadioMedium*>(medium_))
    throw cRuntimeError(owner, "wavetracer: this module must be a submodule of a radio medium, such as its pathLoss");
  coordinates_.offset_m = {owner->par("offsetX"), owner->par("offsetY"), owner->par("offsetZ")};
  coordinates_.mirror_y = owner->par("mirrorY");
  coordinates_.is_front = owner->par("positionIsFront");
  stations_ = pairs_of(owner->par("stations").stringValue(), "stations");
  vehicles_ = pairs_of(owner->par("vehicles").stringValue(), "vehicles");
  for (const auto signal : {IRadioMedium::radioAddedSignal, IRadioMedium::radioRemovedSignal,
                            IRadioMedium::signalAddedSignal, IRadioMedium::signalRemovedSignal})
    medium_->subscribe(signal, this);
}

// The medium may be gone already: cListener unsubscribes itself.
WavetracerChannel::~WavetracerChannel() = default;

void WavetracerChannel::connect() {
  if (server_) return;
  LiveClientOptions options;
  options.server = owner_->par("server").stdstringValue();
  options.timeout_s = owner_->par("timeout");
  options.retries = static_cast<unsigned>(owner_->par("retries").intValue());
  const std::string token_file = owner_->par("tokenFile").stdstringValue();
  if (!token_file.empty()) options.token = read_token(token_file);
  try {
    server_ = std::make_unique<LiveNodes>(options);
  } catch (const std::exception& error) {
    throw cRuntimeError(owner_, "wavetracer: %s", error.what());
  }
  snapshots_ = std::make_unique<LiveSnapshots>(*server_, owner_->par("updatePeriod").doubleValue(),
                                               owner_->par("gain").stdstringValue());
}

void WavetracerChannel::receiveSignal(omnetpp::cComponent*, omnetpp::simsignal_t signal, omnetpp::cObject* value,
                                      omnetpp::cObject*) {
  if (signal == IRadioMedium::radioAddedSignal) {
    add(omnetpp::check_and_cast<cModule*>(value));
  } else if (signal == IRadioMedium::radioRemovedSignal) {
    remove(omnetpp::check_and_cast<cModule*>(value));
  } else if (signal == IRadioMedium::signalAddedSignal) {
    begins_.insert(dynamic_cast<const ITransmission&>(*value).getStartTime());
    take();
  } else if (signal == IRadioMedium::signalRemovedSignal) {
    const auto found = begins_.find(dynamic_cast<const ITransmission&>(*value).getStartTime());
    if (found != begins_.end()) begins_.erase(found);
    if (snapshots_) snapshots_->forget_before((begins_.empty() ? omnetpp::simTime() : *begins_.begin()).dbl());
  }
}

void WavetracerChannel::add(cModule* radio) {
  connect();
  cModule* const host = inet::getContainingNode(radio);
  radios_[radio->getId()] = {omnetpp::check_and_cast<const IRadio*>(radio), host->getId()};
  if (hosts_.count(host->getId()) == 0) hosts_[host->getId()] = make(host);
  if (!begins_.empty()) take();  // signals in the air arrive at it, too
}

void WavetracerChannel::remove(cModule* radio) {
  const auto found = radios_.find(radio->getId());
  if (found == radios_.end()) return;
  const int host = found->second.host;
  radios_.erase(found);
  for (const auto& [id, each] : radios_)
    if (each.host == host) return;
  hosts_.erase(host);
}

WavetracerChannel::Host WavetracerChannel::make(cModule* host) const {
  try {
    if (const std::string* station = name_for(host->getFullName(), stations_)) return {server_->station(*station), 0};
    const std::string* named = name_for(host->getFullName(), vehicles_);
    const std::string type_and_mount = named ? *named : server_->first_type();
    const size_t slash = type_and_mount.find('/');
    const std::string type = type_and_mount.substr(0, slash);
    const std::string mount = slash == std::string::npos ? "" : type_and_mount.substr(slash + 1);
    return {server_->vehicle("node" + std::to_string(host->getId()), type, mount), server_->length_m(type)};
  } catch (const std::exception& error) {
    throw cRuntimeError(owner_, "wavetracer: host %s: %s", host->getFullPath().c_str(), error.what());
  }
}

// A host with several radios is one vehicle, at the position of its first radio's antenna.
void WavetracerChannel::take() {
  const double now_s = omnetpp::simTime().dbl();
  LiveSnapshot out{now_s, now_s, {}, {}, {}};
  std::set<int> seen;
  for (const auto& [id, each] : radios_) {
    if (!seen.insert(each.host).second) continue;
    const Host& host = hosts_.at(each.host);
    inet::IMobility* const mobility = each.radio->getAntenna()->getMobility();
    const Coord at = mobility->getCurrentPosition();
    out.nodes.push_back(host.node);
    out.points.push_back(vector_of(at));
    out.places.push_back(
        host.node.is_vehicle()
            ? coordinates_.place(vector_of(at), vector_of(mobility->getCurrentVelocity()),
                                 vector_of(mobility->getCurrentAngularPosition().rotate(Coord::X_AXIS)), host.length_m)
            : LivePlace());
  }
  connect();
  snapshots_->take(std::move(out));
}

double WavetracerChannel::gain(const Coord& from, const Coord& to, inet::units::values::Hz frequency,
                               omnetpp::simtime_t at) {
  connect();
  const double ours = server_->frequency_hz();
  if (std::abs(frequency.get() - ours) > most_off * ours)
    throw cRuntimeError(owner_,
                        "wavetracer: a signal has %g Hz, but the server computes channels at %g Hz: set "
                        "radio.frequency_hz in the configuration of the server",
                        frequency.get(), ours);
  try {
    const auto time_s = at < 0 ? std::nullopt : std::optional<double>(at.dbl());
    return std::pow(10.0, snapshots_->gain_db(vector_of(from), vector_of(to), time_s) / 10);
  } catch (const std::exception& error) {
    throw cRuntimeError(owner_, "wavetracer: %s", error.what());
  }
}

}  // namespace wavetracer
