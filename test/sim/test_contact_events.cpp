#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/run_observer.h"
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

// Both fall 0.1 m: they hit after sqrt(2 0.1/9.81) = 0.14278 s, within step 71, at 1.40071 m/s, and
// rest from then on. What comes at one time is told in the order in which it came.
TEST(ContactEvents, TellWhoMetWhenAndHowHard) {
  Simulation simulation(testing::parsed(kFalling));
  std::vector<ContactEvent> events;
  RunCallbacks told;
  simulation.observe(&told);
  told.on_contact = [&](const ContactEvent& event) {
    events.push_back(event);
    EXPECT_EQ(event.tick, simulation.tick());
  };
  while (simulation.tick() < 72) simulation.step();
  const double fall = std::sqrt(2.0 * 0.1 / 9.81);
  const double speed = 9.81 * fall;
  ASSERT_EQ(events.size(), 4U);
  for (std::size_t i = 0; i < 4; i += 2) {
    const ContactEvent& hit = events[i];
    const bool is_left = hit.a == "left";
    EXPECT_TRUE(is_left || hit.a == "right");
    EXPECT_EQ(hit.b, "floor");
    EXPECT_EQ(hit.kind, ContactKind::kStick);
    EXPECT_EQ(hit.tick, 72);
    EXPECT_NEAR(hit.time, fall, 1e-5);
    EXPECT_EQ(hit.time_ns, std::llround(hit.time * 1e9));
    EXPECT_LT(norm(hit.nhat_AB_W - Vector3(0.0, 0.0, -1.0)), 1e-12);
    EXPECT_LT(norm(hit.p_WC - Vector3(0.0, is_left ? 1.0 : -1.0, 0.0)), 1e-2);
    // On the floor: m v of 1 kg or 3.
    const Vector3 momentum(0.0, 0.0, is_left ? -speed : -3.0 * speed);
    EXPECT_LT(norm(hit.impulse_B_W - momentum), 1e-4);
    const ContactEvent& rest = events[i + 1];
    EXPECT_EQ(rest.kind, ContactKind::kRest);
    EXPECT_EQ(rest.a, hit.a);
    EXPECT_EQ(rest.b, hit.b);
    EXPECT_EQ(rest.time, hit.time);
  }
  EXPECT_NE(events[0].a, events[2].a);
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
