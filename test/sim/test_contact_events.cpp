#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/simulation.h"

#include "../support/scenario_text.h"

namespace hovercraft {
namespace {

/// Two crates of 1 and 3 kg whose undersides are 0.1 m above the floor, and a craft far above.
const char* const kFalling = R"(step_size: 0.002
integrator: heun
model: spatial
gravity: [0, 0, -9.81]
vehicles:
  craft:
    parts: [{box: {size: [0.6, 0.4, 0.12]}, mass: 5}]
    engines:
      rear: {position: [-0.25, 0, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 4.5}
      left: {position: [0.2, 0.15, 0], direction: [0, -1, 0], min_thrust: 0, max_thrust: 1.5}
      right: {position: [0.2, -0.15, 0], direction: [0, 1, 0], min_thrust: 0, max_thrust: 1.5}
    initial: {position: [0, 0, 50]}
world:
  materials: {default: {restitution: 0, friction: 0.3}}
  obstacles: {floor: {box: {size: [8, 8, 1]}, position: [0, 0, -0.5]}}
  bodies:
    left: {parts: [{box: {size: [0.5, 0.5, 0.5]}, mass: 1}], initial: {position: [0, 1, 0.35]}}
    right: {parts: [{box: {size: [0.5, 0.5, 0.5]}, mass: 3}], initial: {position: [0, -1, 0.35]}}
)";

// Both fall 0.1 m: they hit after sqrt(2 0.1/9.81) = 0.14278 s, within step 71, at 1.40071 m/s. What
// comes at one time is told in the order of the pairs.
TEST(ContactEvents, TellWhoMetWhenAndHowHard) {
  Simulation simulation(testing::parsed(kFalling));
  std::vector<ContactEvent> events;
  simulation.on_contact = [&](const ContactEvent& event) {
    events.push_back(event);
    EXPECT_EQ(event.tick, simulation.tick());
  };
  while (simulation.tick() < 72) simulation.step();
  ASSERT_GE(events.size(), 2U);
  const double fall = std::sqrt(2.0 * 0.1 / 9.81);
  const double speed = 9.81 * fall;
  const std::string names[] = {"left", "right"};
  const double masses[] = {1.0, 3.0};
  for (std::size_t i = 0; i < 2; ++i) {
    const ContactEvent& event = events[i];
    EXPECT_EQ(event.a, names[i]);
    EXPECT_EQ(event.b, "floor");
    EXPECT_EQ(event.kind, ContactKind::kStick);
    EXPECT_EQ(event.tick, 72);
    EXPECT_NEAR(event.time, fall, 1e-5);
    EXPECT_EQ(event.time_ns, std::llround(event.time * 1e9));
    EXPECT_LT(norm(event.nhat_AB_W - Vector3(0.0, 0.0, -1.0)), 1e-12);
    EXPECT_NEAR(event.p_WC.z(), 0.0, 1e-5);
    EXPECT_NEAR(event.p_WC.y(), i == 0 ? 1.0 : -1.0, 1e-9);
    // On B, the floor.
    EXPECT_LT(norm(event.impulse_B_W - Vector3(0.0, 0.0, -masses[i] * speed)), 1e-4 * speed);
  }
  EXPECT_EQ(events[0].time, events[1].time);
}

// Of each loose body by its number: where it is, and its energy m g z at rest.
TEST(ContactEvents, LooseBodiesAreKnownByTheirNumbers) {
  const Simulation simulation(testing::parsed(kFalling));
  EXPECT_EQ(simulation.bodyMotion(0).p_WB, Vector3(0.0, 1.0, 0.35));
  EXPECT_EQ(simulation.bodyMotion(1).p_WB, Vector3(0.0, -1.0, 0.35));
  EXPECT_NEAR(simulation.bodyMotion(0).energy, 1.0 * 9.81 * 0.35, 1e-14);
  EXPECT_NEAR(simulation.bodyMotion(1).energy, 3.0 * 9.81 * 0.35, 1e-14);
}

}  // namespace
}  // namespace hovercraft
