#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/velocity_parameters.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/sensors/noise_process.h"
#include "hovercraft_sim/sensors/sensor_suite.h"
#include "hovercraft_sim/sim/state_hash.h"

#include "../support/same_bits.h"

// As test_foreign_environment.cpp, of air, sensors and the velocity law.

namespace hovercraft {
namespace {

using testing::expectSameBits;

TEST(ForeignEnvironment, AWindThatIsChangedAndGustsAreTheSame) {
  const Scenario scenario = loadScenario("config/gusts.yaml");
  expectSameBits("gusts", [&scenario] {
    Simulation simulation(scenario);
    for (int i = 0; i < 100; ++i) simulation.step();
    simulation.setWind({0.1, 1.0 / 3.0, 0.0});
    for (int i = 0; i < 100; ++i) simulation.step();
    Simulation restored(scenario);
    restored.restore(simulation.state());
    restored.step();
    return restored.hash();
  });
}

// What a program may set up by itself, without a scenario.
TEST(ForeignEnvironment, NoiseSensorsAndVelocityLawAreTheSame) {
  NoiseParameters noise;
  noise.noise_density = 0.1;
  noise.random_walk = 0.03;
  noise.bias_correlation_time = 7.0;
  noise.turn_on_bias_sigma = 0.3;
  noise.scale = 0.01;
  expectSameBits("noise", [&noise] {
    const NoiseProcess process(noise, 0.005, "a/b/c");
    const NoiseProcess::Memory memory = process.start(3);
    StateHash hash;
    hash.add(process.white());
    hash.add(process.variance());
    hash.add(memory.bias);
    hash.add(memory.turn_on);
    return hash.value();
  });
  SensorParameters imu;
  imu.name = "imu";
  imu.model = ImuParameters{noise, noise, Vector3(0.0, 0.0, -9.80665)};
  imu.rpy = {0.1, 0.2, 0.3};
  imu.p_HS = {0.1, 0.7, 0.3};
  imu.period = 3;
  const Simulation still(loadScenario("config/mvwt.yaml"));
  expectSameBits("sensors", [&] {
    const Mobility mobility = modelOf(still.scenario(), still.scenario().vehicles[0]).mobility;
    SensorSuite suite({{"craft", mobility, Vector3(0.1, 0.0, 0.0), {imu}}}, {}, 1000000);
    auto states = suite.start(5, 0, still.state().bodies);
    suite.sample(5, 3, still.state().bodies, states);
    StateHash hash;
    for (const SensorState& state : states) hash.add(state);
    return hash.value();
  });
  const VelocityParameters craft =
      velocityParametersOf(loadScenario("config/vectored_fans.yaml").vehicles[0]);
  expectSameBits("law", [&craft] {
    VelocityLaw law(craft.plant, craft.gains);
    StateHash hash;
    hash.add(law.topSpeed(1.0));
    hash.add(law.topYawRate(-1.0));
    for (const double speed : {0.0, 0.01, 0.02, 0.03, 0.04}) {
      for (const double level : law.levels({0.3, 0.1, 0.7}, {speed, 0.0, 0.1}, 0.01)) {
        hash.add(level);
      }
    }
    return hash.value();
  });
}

}  // namespace
}  // namespace hovercraft
