#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "scenario_text.h"

/// Every rule of a scenario file, broken once, with the whole message.

namespace hovercraft::testing {

struct BrokenRule {
  const char* name;
  const char* old_part;  // of validScenario()
  const char* new_part;
  const char* message;  // behind the source
};

inline void PrintTo(const BrokenRule& rule, std::ostream* stream) {  // NOLINT: gtest's name
  *stream << rule.new_part;
}

// ---- keys ---------------------------------------------------------------------------------------
inline const std::vector<BrokenRule> kBrokenKeys = {
    {"UnknownKey", "seed: 7", "sede: 7",
     "sede = 7: unknown key; known here: physics_version, software, step_size, integrator, "
     "orientation, model, gravity, wind, gusts, seed, vehicles, world, ground"},
    {"UnknownVehicleKey", "    mass: 5.5", "    weight: 5.5",
     "vehicles.alpha.weight = 5.5: unknown key; known here: mass, inertia, center_of_mass, parts, "
     "engines, actuators, drag, hull, material, visual, initial, cushion, sensors, tf"},
    {"UnknownEngine", "      left: {", "      port: {",
     "vehicles.alpha.engines.port = {position: [0.2, 0.15, 0.05], direction: [0, -1, 0], "
     "min_thrust: 0, max_thrust: ...: unknown key; known here: rear, left, right"},
    {"UnknownEngineKey", "timeout: 0.75", "time_out: 0.75",
     "vehicles.alpha.engines.rear.time_out = 0.75: unknown key; known here: position, direction, "
     "min_thrust, max_thrust, time_constant, timeout, command, thrust_table, type, topic, "
     "rotation, "
     "rotor_inertia, rotor_speed"},
    {"UnknownInertiaKey", "iyz: 0.03", "izy: 0.03",
     "vehicles.alpha.inertia.izy = 0.03: unknown key; known here: ixx, iyy, izz, ixy, ixz, iyz"},
    {"UnknownDragKey", "{linear: [0.8", "{lineal: [0.8",
     "vehicles.alpha.drag.lineal = [0.8, 1.2, 1.6]: unknown key; known here: linear, quadratic, "
     "angular_linear, angular_quadratic, polar"},
    {"UnknownInitialKey", "rpy: [0.1", "yaw: [0.1",
     "vehicles.alpha.initial.yaw = [0.1, 0.2, 0.3]: unknown key; known here: position, rpy, "
     "velocity, angular_velocity"},
    {"MissingStepSize", "step_size: 0.002\n", "", "step_size: the key is missing"},
    {"MissingMass", "    mass: 5.5\n", "", "vehicles.alpha.mass: the key is missing"},
    {"MissingMoment", "izz: 0.25, ", "", "vehicles.alpha.inertia.izz: the key is missing"},
    {"MissingLimit", ", max_thrust: 1.5}", "}",
     "vehicles.alpha.engines.left.max_thrust: the key is missing"},
    {"MissingDirection", "direction: [0, -1, 0], ", "",
     "vehicles.alpha.engines.left.direction: the key is missing"},
    {"EmptyValue", "mass: 5.5", "mass:", "vehicles.alpha.mass: the value is missing"},
    {"EmptyOptionalValue", "seed: 7", "seed:", "seed: the value is missing"},
    {"EmptyMap",
     "    drag: {linear: [0.8, 1.2, 1.6], quadratic: [0.4, 0.9, 1.1], angular_linear: [0.12, "
     "0.13, 0.14], angular_quadratic: [0.05, 0.06, 0.07]}",
     "    drag:", "vehicles.alpha.drag: the value is missing"},
    {"KeyTwice", "seed: 7", "seed: 7\nseed: 8", "seed: duplicate key, again in line 8"},
    {"KeyTwiceInside", "ixx: 0.1,", "ixx: 0.1, ixx: 0.1,",
     "vehicles.alpha.inertia.ixx: duplicate key, again in line 12"},
    {"VehicleTwice", "  alpha:\n", "  alpha: {mass: 1}\n  alpha:\n",
     "vehicles.alpha: duplicate key, again in line 10"},
};

// ---- numbers ------------------------------------------------------------------------------------
inline const std::vector<BrokenRule> kBrokenNumbers = {
    {"WordForNumber", "mass: 5.5", "mass: heavy", "vehicles.alpha.mass = heavy: must be a number"},
    {"TruthForNumber", "mass: 5.5", "mass: true", "vehicles.alpha.mass = true: must be a number"},
    {"NumberWithUnit", "mass: 5.5", "mass: 5.5 kg",
     "vehicles.alpha.mass = 5.5 kg: must be a number in decimal digits"},
    {"NumberWithComma", "mass: 5.5", "mass: 5,5",
     "vehicles.alpha.mass = 5,5: must be a number in decimal digits"},
    {"Hexadecimal", "mass: 5.5", "mass: 0x10",
     "vehicles.alpha.mass = 0x10: must be a number in decimal digits"},
    {"Octal", "mass: 5.5", "mass: 020",
     "vehicles.alpha.mass = 020: must be a number without leading zeros (YAML 1.1 would read it as "
     "octal)"},
    {"NoOctalDigit", "mass: 5.5", "mass: -08",
     "vehicles.alpha.mass = -08: must be a number without leading zeros (YAML 1.1 would read it as "
     "octal)"},
    {"Thousands", "mass: 5.5", "mass: 1_000",
     "vehicles.alpha.mass = 1_000: must be a number in decimal digits"},
    {"Sexagesimal", "mass: 5.5", "mass: 1:30",
     "vehicles.alpha.mass = 1:30: must be a number in decimal digits"},
    {"AngleOfRosparam", "mass: 5.5", "mass: deg(90)",
     "vehicles.alpha.mass = deg(90): must be a number in decimal digits"},
    {"Binary", "mass: 5.5", "mass: 0b11",
     "vehicles.alpha.mass = 0b11: must be a number in decimal digits"},
    {"NumberInQuotes", "mass: 5.5", "mass: '5.5'",
     "vehicles.alpha.mass = 5.5: must be a number, not a text in quotes"},
    {"SeedInQuotes", "seed: 7", "seed: '7'",
     "seed = 7: must be a whole number, not a text in quotes"},
    {"SeedWithLeadingZero", "seed: 7", "seed: 07",
     "seed = 07: must be a whole number without leading zeros"},
    {"SeedWithExponent", "seed: 7", "seed: 1e3",
     "seed = 1e3: must be a whole number of at most 64 bits"},
    {"ListForNumber", "mass: 5.5", "mass: [5.5]", "vehicles.alpha.mass = [5.5]: must be a number"},
    {"MapForNumber", "mass: 5.5", "mass: {kg: 5.5}",
     "vehicles.alpha.mass = {kg: 5.5}: must be a number"},
    {"NanOfYaml", "mass: 5.5", "mass: .nan", "vehicles.alpha.mass = .nan: must be finite"},
    {"NanOfPython", "mass: 5.5", "mass: nan", "vehicles.alpha.mass = nan: must be finite"},
    {"Infinity", "mass: 5.5", "mass: .inf", "vehicles.alpha.mass = .inf: must be finite"},
    {"MinusInfinity", "min_thrust: -1,", "min_thrust: -.INF,",
     "vehicles.alpha.engines.rear.min_thrust = -.INF: must be finite"},
    {"BeyondDouble", "mass: 5.5", "mass: 1e999", "vehicles.alpha.mass = 1e999: must be finite"},
    {"NanInVector", "gravity: [0, 0, -9.81]", "gravity: [0, .nan, -9.81]",
     "gravity = [0, .nan, -9.81]: must be finite"},
    {"WordInVector", "gravity: [0, 0, -9.81]", "gravity: [0, 0, down]",
     "gravity = [0, 0, down]: must be a number"},
    {"NumberForVector", "gravity: [0, 0, -9.81]", "gravity: -9.81",
     "gravity = -9.81: must be a list of three numbers"},
    {"TwoComponents", "gravity: [0, 0, -9.81]", "gravity: [0, -9.81]",
     "gravity = [0, -9.81]: must be a list of three numbers"},
    {"FourComponents", "wind: [1, -2, 0.5]", "wind: [1, -2, 0.5, 0]",
     "wind = [1, -2, 0.5, 0]: must be a list of three numbers"},
    {"NegativeMass", "mass: 5.5", "mass: -5.5",
     "vehicles.alpha.mass = -5.5: must be greater than 0"},
    {"NoMass", "mass: 5.5", "mass: 0", "vehicles.alpha.mass = 0: must be greater than 0"},
    {"MassBelowDouble", "mass: 5.5", "mass: 1e-999",
     "vehicles.alpha.mass = 1e-999: must be greater than 0"},
    {"PositiveMinThrust", "min_thrust: -1,", "min_thrust: 1,",
     "vehicles.alpha.engines.rear.min_thrust = 1: must be 0 or less"},
    {"NegativeMaxThrust", "max_thrust: 4.5", "max_thrust: -4.5",
     "vehicles.alpha.engines.rear.max_thrust = -4.5: must be 0 or greater"},
    {"NegativeTimeConstant", "time_constant: 0.1", "time_constant: -0.1",
     "vehicles.alpha.engines.rear.time_constant = -0.1: must be 0 or greater"},
    {"NegativeTimeout", "timeout: 0.75", "timeout: -0.75",
     "vehicles.alpha.engines.rear.timeout = -0.75: must be 0 or greater"},
    {"NegativeDrag", "quadratic: [0.4, 0.9, 1.1], ", "quadratic: [0.4, -0.9, 1.1], ",
     "vehicles.alpha.drag.quadratic = [0.4, -0.9, 1.1]: must be 0 or greater"},
    {"DirectionTooLong", "direction: [0, -1, 0]", "direction: [0, -2, 0]",
     "vehicles.alpha.engines.left.direction = [0, -2, 0]: must have length 1 (it has 2)"},
    {"DirectionIsNotNormalised", "direction: [0, -1, 0]", "direction: [0, -1, 0.01]",
     "vehicles.alpha.engines.left.direction = [0, -1, 0.01]: must have length 1 (it has 1.00005)"},
    {"NoDirection", "direction: [0, -1, 0]", "direction: [0, 0, 0]",
     "vehicles.alpha.engines.left.direction = [0, 0, 0]: must have length 1 (it has 0)"},
    {"FractionForSeed", "seed: 7", "seed: 7.5",
     "seed = 7.5: must be a whole number of at most 64 bits"},
    {"WordForSeed", "seed: 7", "seed: any",
     "seed = any: must be a whole number of at most 64 bits"},
    {"SeedBeyond64Bits", "seed: 7", "seed: 9223372036854775808",
     "seed = 9223372036854775808: must be a whole number of at most 64 bits"},
};

// ---- time ---------------------------------------------------------------------------------------
inline const std::vector<BrokenRule> kBrokenTimes = {
    {"NoStep", "step_size: 0.002", "step_size: 0", "step_size = 0: must be greater than 0"},
    {"NegativeStep", "step_size: 0.002", "step_size: -0.002",
     "step_size = -0.002: must be greater than 0"},
    {"StepBelowANanosecond", "step_size: 0.002", "step_size: 1e-10",
     "step_size = 1e-10: must be a whole number of nanoseconds"},
    {"StepBetweenNanoseconds", "step_size: 0.002", "step_size: 0.0020000005",
     "step_size = 0.0020000005: must be a whole number of nanoseconds"},
    {"ThirdOfASecond", "step_size: 0.002", "step_size: 0.3333333333333333",
     "step_size = 0.3333333333333333: must be a whole number of nanoseconds"},
    {"StepTooLong", "step_size: 0.002", "step_size: 1000000.1",
     "step_size = 1000000.1: must be at most 1000000 s"},
    {"TimeoutBetweenNanoseconds", "timeout: 0.75", "timeout: 0.7500000001",
     "vehicles.alpha.engines.rear.timeout = 0.7500000001: must be a whole number of nanoseconds"},
    {"TimeoutTooLong", "timeout: 0.75", "timeout: 1e300",
     "vehicles.alpha.engines.rear.timeout = 1e300: must be at most 1000000 s"},
};

}  // namespace hovercraft::testing
