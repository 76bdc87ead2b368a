#pragma once

#include <vector>

#include "broken_rules.h"

/// The rest of broken_rules.h: structure, inertia, parts.

namespace hovercraft::testing {

// ---- choices, names, structure ------------------------------------------------------------------
inline const std::vector<BrokenRule> kBrokenStructures = {
    {"UnknownIntegrator", "integrator: rk4", "integrator: rk5",
     "integrator = rk5: must be one of: euler, semi_implicit_euler, heun, rk4, lie4"},
    {"UnknownOrientation", "orientation: matrix", "orientation: euler_angles",
     "orientation = euler_angles: must be one of: quaternion, matrix"},
    {"UnknownModel", "model: spatial", "model: Planar",
     "model = Planar: must be one of: planar, spatial"},
    {"EmptyModel", "model: spatial", "model: ''", "model: must be a text"},
    {"ListForModel", "model: spatial", "model: [spatial]", "model = [spatial]: must be a text"},
    {"VehicleNameWithDash", "  alpha:\n", "  al-pha:\n",
     "vehicles.al-pha = {mass: 5.5, center_of_mass: [0.01, 0.02, 0.03], inertia: {ixx: 0.1, iyy: "
     "0.2, iz...: the name of a vehicle is a ROS name: a letter, then letters, digits and _"},
    {"NoVehicleMap", "  alpha:\n", "  alpha: 5\n  beta:\n",
     "vehicles.alpha = 5: must be a map of keys"},
    {"EnginesAreAList",
     "      rear: {position: [-0.25, 0, 0.05], direction: [1, 0, 0], min_thrust: -1, max_thrust: "
     "4.5, time_constant: 0.1, timeout: 0.75}",
     "      rear: [1, 2]", "vehicles.alpha.engines.rear = [1, 2]: must be a map of keys"},
    {"PlanarWithRoll", "model: spatial", "model: planar",
     "vehicles.alpha.initial.rpy = [0.1, 0.2, 0.3]: does not fit model: planar, which moves in x, "
     "y and yaw only"},
    {"ValueOfSeveralLines", "mass: 5.5", "mass: |\n      5\n      5",
     "vehicles.alpha.mass = 5 5 : must be a number in decimal digits"},
};

// ---- inertia ------------------------------------------------------------------------------------
inline constexpr const char* kInertia =
    "{ixx: 0.1, iyy: 0.2, izz: 0.25, ixy: 0.01, ixz: -0.02, iyz: 0.03}";
inline const std::vector<BrokenRule> kBrokenInertias = {
    // Largest moment 0.75 > 0.25 + 0.25: no distribution of mass has it.
    {"TriangleInequality", kInertia, "{ixx: 0.25, iyy: 0.25, izz: 0.75}",
     "vehicles.alpha.inertia = {ixx: 0.25, iyy: 0.25, izz: 0.75}: its largest principal moment is "
     "0.75 kg m^2: must be at most 0.5 kg m^2, the sum of the other two"},
    {"NegativeMoment", kInertia, "{ixx: 0.25, iyy: -0.5, izz: 0.25}",
     "vehicles.alpha.inertia = {ixx: 0.25, iyy: -0.5, izz: 0.25}: must be positive definite: its "
     "smallest principal moment is -0.5 kg m^2"},
    // Every diagonal entry is positive, and yet [1 1 0; 1 1 0; 0 0 1] · 0.25 is singular; here the
    // product is larger still: eigenvalues 0.25 ± 0.5.
    {"LargeProduct", kInertia, "{ixx: 0.25, iyy: 0.25, izz: 0.25, ixy: 0.5}",
     "vehicles.alpha.inertia = {ixx: 0.25, iyy: 0.25, izz: 0.25, ixy: 0.5}: must be positive "
     "definite: its smallest principal moment is -0.25 kg m^2"},
};

// ---- parts --------------------------------------------------------------------------------------
inline const std::vector<BrokenRule> kBrokenParts = {
    {"PartsBesideMass", "    mass: 5.5\n",
     "    mass: 5.5\n    parts: [{sphere: {radius: 0.1}, mass: 1}]\n",
     "vehicles.alpha.mass = 5.5: must not stand beside parts, which determine it"},
    {"NoParts", kMassByNumbers, "    parts: []\n",
     "vehicles.alpha.parts = []: must be a list, not empty"},
    {"PartsAreAMap", kMassByNumbers, "    parts: {sphere: {radius: 0.1}, mass: 1}\n",
     "vehicles.alpha.parts = {sphere: {radius: 0.1}, mass: 1}: must be a list, not empty"},
    {"TwoShapes", kMassByNumbers,
     "    parts: [{sphere: {radius: 0.1}, box: {size: [1, 1, 1]}, mass: 1}]\n",
     "vehicles.alpha.parts[0] = {sphere: {radius: 0.1}, box: {size: [1, 1, 1]}, mass: 1}: must "
     "have one of box, cylinder, cone, sphere, mesh"},
    {"NoShape", kMassByNumbers, "    parts: [{sphere: {radius: 0.1}, mass: 1}, {mass: 2}]\n",
     "vehicles.alpha.parts[1] = {mass: 2}: must have one of box, cylinder, cone, sphere, mesh"},
    {"MassAndDensity", kMassByNumbers,
     "    parts: [{sphere: {radius: 0.1}, mass: 1, density: 1000}]\n",
     "vehicles.alpha.parts[0] = {sphere: {radius: 0.1}, mass: 1, density: 1000}: must have either "
     "mass or density"},
    {"NeitherMassNorDensity", kMassByNumbers, "    parts: [{sphere: {radius: 0.1}}]\n",
     "vehicles.alpha.parts[0] = {sphere: {radius: 0.1}}: must have either mass or density"},
    {"UnknownPartKey", kMassByNumbers, "    parts: [{sphere: {radius: 0.1}, mass: 1, at: 3}]\n",
     "vehicles.alpha.parts[0].at = 3: unknown key; known here: box, cylinder, cone, sphere, mesh, "
     "mass, density, position, rpy"},
    {"UnknownShapeKey", kMassByNumbers, "    parts: [{sphere: {diameter: 0.1}, mass: 1}]\n",
     "vehicles.alpha.parts[0].sphere.diameter = 0.1: unknown key; known here: radius"},
    {"NegativeRadius", kMassByNumbers, "    parts: [{sphere: {radius: -0.1}, mass: 1}]\n",
     "vehicles.alpha.parts[0].sphere.radius = -0.1: must be greater than 0"},
    {"FlatBox", kMassByNumbers, "    parts: [{box: {size: [1, 0, 1]}, mass: 1}]\n",
     "vehicles.alpha.parts[0].box.size = [1, 0, 1]: must be greater than 0"},
    {"NoLengthOfCylinder", kMassByNumbers, "    parts: [{cylinder: {radius: 0.1}, mass: 1}]\n",
     "vehicles.alpha.parts[0].cylinder.length: the key is missing"},
    {"NegativeLengthOfCone", kMassByNumbers,
     "    parts: [{cone: {radius: 0.1, length: -1}, mass: 1}]\n",
     "vehicles.alpha.parts[0].cone.length = -1: must be greater than 0"},
    {"NegativeDensity", kMassByNumbers, "    parts: [{sphere: {radius: 0.1}, density: -3}]\n",
     "vehicles.alpha.parts[0].density = -3: must be greater than 0"},
    {"DensityMakesTheMassInfinite", kMassByNumbers,
     "    parts: [{sphere: {radius: 1e30}, density: 1e300}]\n",
     "vehicles.alpha.parts[0].density = 1e300: makes a mass that is not positive and finite"},
    {"PartWithoutVolume", kMassByNumbers,
     "    parts: [{box: {size: [1e-200, 1e-200, 1]}, mass: 1}]\n",
     "vehicles.alpha.parts[0].box = {size: [1e-200, 1e-200, 1]}: has a volume that is not positive "
     "and finite"},
    {"MeshIsMissing", kMassByNumbers, "    parts: [{mesh: {file: nowhere.obj}, mass: 1}]\n",
     "vehicles.alpha.parts[0].mesh.file = nowhere.obj: mesh file 'test/data/nowhere.obj': does not "
     "exist or cannot be read"},
    {"PackageIsMissing", kMassByNumbers,
     "    parts: [{mesh: {file: 'package://nowhere/hull.obj'}, mass: 1}]\n",
     "vehicles.alpha.parts[0].mesh.file = package://nowhere/hull.obj: there is no ROS package "
     "nowhere"},
    {"PackageWithoutPath", kMassByNumbers,
     "    parts: [{mesh: {file: 'package://nowhere'}, mass: 1}]\n",
     "vehicles.alpha.parts[0].mesh.file = package://nowhere: must be package://PACKAGE/PATH"},
};

}  // namespace hovercraft::testing
