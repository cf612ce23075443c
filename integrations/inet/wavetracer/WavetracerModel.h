// SPDX-License-Identifier: Apache-2.0
// The common part of the models of this package: a submodule of a radio medium that has a channel.
#ifndef WAVETRACER_INET_MODEL_H
#define WAVETRACER_INET_MODEL_H

#include <memory>
#include <ostream>

#include "WavetracerChannel.h"
#include "inet/common/InitStages.h"
#include "inet/common/Module.h"

namespace wavetracer {

// Interface: IPathLoss or IObstacleLoss.
template <class Interface>
class WavetracerModel : public inet::Module, public Interface {
 public:
  std::ostream& printToStream(std::ostream& stream, int, int = 0) const override { return stream << getNedTypeName(); }

 protected:
  void initialize(int stage) override {
    inet::Module::initialize(stage);
    if (stage == inet::INITSTAGE_LOCAL) channel_ = std::make_unique<WavetracerChannel>(this);
  }
  void finish() override { recordScalar("questions to wavetracer", channel_->questions()); }

  WavetracerChannel& channel() const { return *channel_; }

 private:
  std::unique_ptr<WavetracerChannel> channel_;
};

}  // namespace wavetracer

#endif
