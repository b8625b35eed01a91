#pragma once

#include "saker/autonomy/plant.h"

namespace saker::autonomy {

/// A plant whose time is made by its caller.
class SteppedPlant : public Plant {
 public:
  [[nodiscard]] virtual Time now() const = 0;
  virtual void step_to(Time time) = 0;
};

/// A collision checker on the same time.
class SteppedChecker : public CollisionCheckerLink {
 public:
  virtual void step_to(Time time) = 0;
};

}  // namespace saker::autonomy
