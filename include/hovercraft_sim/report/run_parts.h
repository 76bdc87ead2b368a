#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hovercraft_sim/report/recorded_topics.h"
#include "hovercraft_sim/report/run_data.h"

/// The parts of which run_reader makes a run.
namespace hovercraft_ros {

/// The topics that tell of one body; nullptr where there is none.
struct BodyTopics {
  std::string name;
  const TopicSamples* state = nullptr;
  const TopicSamples* odom = nullptr;
  const TopicSamples* pose = nullptr;
  const TopicSamples* twist = nullptr;
  const TopicSamples* engines = nullptr;
  const TopicSamples* wind = nullptr;
};

/// The bodies of a bag: those of the scenario, if there is one; else every namespace with a state,
/// odom or pose; and every other topic of poses, by its own name. @param scenario may be nullptr.
std::vector<BodyTopics> bodiesIn(const RecordedTopics& recorded,
                                 const hovercraft::Scenario* scenario);

/// Where base_link was: from pose, else odom, else state. Samples that are not
/// finite, or farther away than kFarthestDrawn, are left out.
/// @param p_HB centre of mass in base_link, m. @param zero_ns ROS time of time 0.
RunMotion motionOf(const BodyTopics& topics, const hovercraft::Vector3& p_HB, std::int64_t zero_ns);

/// From twist, odom or state; else from the poses, as the quotients of their differences.
[[nodiscard]] std::optional<RunVelocity> velocityOf(const BodyTopics& topics,
                                                    const RunMotion& motion,
                                                    const hovercraft::Vector3& p_HB,
                                                    std::int64_t zero_ns);

/// Panels of one body: velocity, rates, thrusts, attitude, height, energy.
std::vector<RunPanel> mainPanels(const RunBody& body, const BodyTopics& topics,
                                 std::int64_t zero_ns);

/// Panels of any other topic with numbers. What does not change is no curve.
std::vector<RunPanel> panelsOfTopic(const TopicSamples& samples, std::int64_t zero_ns);

/// The manoeuvres that a topic of Manoeuvre tells of; none where the message lacks a field. What
/// has no sensible duration is left out.
std::vector<RunManoeuvre> manoeuvresOf(const std::string& topic, const TopicSamples& samples,
                                       std::int64_t zero_ns);

/// Solids of a craft or a loose body, a craft's skirt among them; the equivalent box of a craft
/// that is described by numbers.
std::vector<RunShape> shapesOf(const hovercraft::VehicleScenario& vehicle, bool is_craft);
std::vector<RunEngine> enginesOf(const hovercraft::VehicleScenario& vehicle);
std::vector<RunObstacle> obstaclesOf(const hovercraft::Scenario& scenario);
/// The ground of a scenario that has one; of a large height map every n-th pixel.
[[nodiscard]] std::optional<RunGround> groundOf(const hovercraft::Scenario& scenario);

/// From the states of a craft, by the trapezoidal rule over them; nothing if there are fewer than
/// two. The wind is that of the topic `wind` where it was recorded with each state. @param
/// mean_wind m/s, else. @param contacts_ns times of the contacts of the craft, in order.
[[nodiscard]] std::optional<EnergyLedger> ledgerOf(const BodyTopics& topics,
                                                   const hovercraft::VehicleScenario& vehicle,
                                                   const hovercraft::Vector3& mean_wind,
                                                   std::int64_t zero_ns,
                                                   const std::vector<std::int64_t>& contacts_ns);

}  // namespace hovercraft_ros
