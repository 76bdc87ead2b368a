#include "driven_craft.h"

namespace hovercraft::bench {

Scenario drivenCraft(Integrator integrator, OrientationKind orientation, BodyModel model) {
  VehicleScenario craft;
  craft.name = "hovercraft";
  craft.mass_properties.mass = 5.0;
  craft.mass_properties.I_BBo_B << 0.0726667, 0.001, -0.002,  //
      0.001, 0.156, 0.003,                                    //
      -0.002, 0.003, 0.2166667;
  craft.engines[0] = {{-0.25, 0.0, 0.05}, {0.96, 0.0, 0.28}, 0.0, 4.5, 0.1, 500000000};
  craft.engines[1] = {{0.2, 0.15, 0.05}, {0.0, -1.0, 0.0}, 0.0, 1.5, 0.1, 500000000};
  craft.engines[2] = {{0.2, -0.15, 0.05}, {0.0, 1.0, 0.0}, 0.0, 1.5, 0.1, 500000000};
  craft.drag = {{0.8, 1.2, 1.5}, {0.4, 0.9, 1.1}, {0.1, 0.11, 0.12}, {0.04, 0.05, 0.06}};
  craft.initial_v_WB = {1.0, 0.2, 0.1};
  craft.initial_w_WB = {0.3, 0.2, 0.5};

  Scenario scenario;
  scenario.step_ns = 1000000;
  scenario.integrator = integrator;
  scenario.orientation = orientation;
  scenario.model = model;
  scenario.wind = {0.5, -0.3, 0.1};
  scenario.vehicles.push_back(craft);
  return scenario;
}

Vector3 demandedThrusts() {
  return {5.0, 0.3, 1.2};
}

}  // namespace hovercraft::bench
