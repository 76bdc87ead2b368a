#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// Counts viewers from 1 on.
using ViewerId = std::uint64_t;

/// Who drives which craft: one viewer at a time, and one that goes on saying so. Times are readings
/// of a steady clock, ns.
class HOVERCRAFT_PUBLIC DriverSeats {
 public:
  /// What a driver said last holds for so long: then the craft is stopped.
  static constexpr std::int64_t kDeadManNs = 250000000;
  /// A driver who says nothing for so long has left.
  static constexpr std::int64_t kLapseNs = 10000000000;

  explicit DriverSeats(std::size_t craft_count) : seats_(craft_count) {}

  /// The viewer becomes the driver if nobody else is. @returns whether he is the driver now.
  bool take(std::size_t craft, ViewerId viewer, std::int64_t now_ns);
  /// @returns whether he was the driver. The craft is to be stopped (takeStops()).
  bool leave(std::size_t craft, ViewerId viewer);
  /// He leaves every seat: his connection is gone. @returns whether he had one.
  bool leaveAll(ViewerId viewer);
  /// The driver gives levels. @returns whether he is the driver.
  bool drive(std::size_t craft, ViewerId viewer, std::int64_t now_ns);

  /// The craft that are to be stopped now, each of which is named once: of a driver who has left,
  /// or has said nothing for longer than kDeadManNs.
  std::vector<std::size_t> takeStops(std::int64_t now_ns);
  /// Drivers who have said nothing for longer than kLapseNs leave. @returns whether one did.
  bool lapse(std::int64_t now_ns);

  [[nodiscard]] std::optional<ViewerId> driver(std::size_t craft) const {
    return seats_[craft].driver;
  }
  std::size_t size() const { return seats_.size(); }

 private:
  struct Seat {
    std::optional<ViewerId> driver;
    std::int64_t last_ns = 0;  // when he took it, or said something
    bool is_driven = false;    // levels hold that are to be stopped
    bool is_left = false;      // their driver has left
  };
  void empty(Seat& seat);

  std::vector<Seat> seats_;
};

}  // namespace hovercraft_ros
