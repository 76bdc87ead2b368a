#include "hovercraft_sim/web/driver_seats.h"

namespace hovercraft_ros {

bool DriverSeats::take(std::size_t craft, ViewerId viewer, std::int64_t now_ns) {
  Seat& seat = seats_[craft];
  if (seat.driver) return seat.driver == viewer;
  seat.driver = viewer;
  seat.last_ns = now_ns;
  return true;
}

void DriverSeats::empty(Seat& seat) {
  seat.driver.reset();
  seat.is_left = true;
}

bool DriverSeats::leave(std::size_t craft, ViewerId viewer) {
  if (seats_[craft].driver != viewer) return false;
  empty(seats_[craft]);
  return true;
}

bool DriverSeats::leaveAll(ViewerId viewer) {
  bool had_one = false;
  for (std::size_t craft = 0; craft < seats_.size(); ++craft) {
    if (leave(craft, viewer)) had_one = true;
  }
  return had_one;
}

bool DriverSeats::drive(std::size_t craft, ViewerId viewer, std::int64_t now_ns) {
  Seat& seat = seats_[craft];
  if (seat.driver != viewer) return false;
  seat.last_ns = now_ns;
  seat.is_driven = true;
  seat.is_left = false;  // of the driver before: these levels replace his
  return true;
}

std::vector<std::size_t> DriverSeats::takeStops(std::int64_t now_ns) {
  std::vector<std::size_t> stops;
  for (std::size_t craft = 0; craft < seats_.size(); ++craft) {
    Seat& seat = seats_[craft];
    if (!seat.is_driven) continue;
    if (!seat.is_left && now_ns - seat.last_ns <= kDeadManNs) continue;
    seat.is_driven = false;
    stops.push_back(craft);
  }
  return stops;
}

bool DriverSeats::lapse(std::int64_t now_ns) {
  bool has_one_left = false;
  for (Seat& seat : seats_) {
    if (!seat.driver || now_ns - seat.last_ns <= kLapseNs) continue;
    empty(seat);
    has_one_left = true;
  }
  return has_one_left;
}

}  // namespace hovercraft_ros
