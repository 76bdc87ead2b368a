#pragma once

#include <hovercraft_sim/RunEvent.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/sim/run_observer.h"

namespace hovercraft_ros {

/// Who is told of a run that is replayed, or recorded anew: states where the recording holds one.
class HOVERCRAFT_PUBLIC RecordingObserver : public hovercraft::RunObserver {
 public:
  /// An event, after it was applied.
  virtual void event(const hovercraft_sim::RunEvent& /*event*/,
                     const hovercraft::Simulation& /*simulation*/) {}
};

}  // namespace hovercraft_ros
